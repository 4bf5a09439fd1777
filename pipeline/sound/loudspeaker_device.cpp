#include "pipeline/sound/loudspeaker_device.h"

#include "pipeline/sound/speaker_mixer.h"

#include <atomic>
#include <chrono>
#include <fmt/format.h>
#include <mutex>
#include <thread>
#include <vector>

namespace stadion {
namespace {

using SoundClock = std::chrono::steady_clock;

constexpr std::size_t kMixBlock = 256;     ///< frames that are mixed at once: 5.3 ms
constexpr std::uint32_t kMoveRamp = 1024;  ///< a moved sound reaches its new gains within 21 ms [frames]
/// A device that never waits, such as a file, gets no more than a little above the nominal rate. The clocks of
/// real devices are far nearer to it.
constexpr double kFastest = 1.02;
constexpr std::chrono::milliseconds kMixAhead{100};
constexpr std::chrono::seconds kOpenAgain{2};

class LoudspeakerDevice final : public SoundDevice {
public:
  LoudspeakerDevice(const LoudspeakerSet& hall, std::string name, OpenSpeakerOutput open,
                    std::unique_ptr<SpeakerOutput> output)
      : mixer_(hall), name_(std::move(name)), open_(std::move(open)), output_(std::move(output)),
        thread_([this] { work(); }) {}
  ~LoudspeakerDevice() override {
    ending_ = true;
    thread_.join();
  }
  LoudspeakerDevice(const LoudspeakerDevice&) = delete;
  LoudspeakerDevice& operator=(const LoudspeakerDevice&) = delete;

  std::string name() const override { return name_; }
  bool standsInRoom() const override { return true; }
  Voice start(const std::shared_ptr<const Sound>& sound, bool loop, double offset) override {
    const std::lock_guard lock(mutex_);
    return mixer_.start(sound, loop, offset);
  }
  void set(Voice voice, double gain, const Vec3& place) override {
    const std::lock_guard lock(mutex_);
    mixer_.set(voice, gain, place, kMoveRamp);
  }
  void stop(Voice voice) override {
    const std::lock_guard lock(mutex_);
    mixer_.stop(voice);
  }
  void pause(Voice voice, bool paused) override {
    const std::lock_guard lock(mutex_);
    mixer_.pause(voice, paused);
  }
  void setVolume(double volume) override {
    const std::lock_guard lock(mutex_);
    mixer_.setVolume(volume, kMoveRamp);
  }

private:
  void work() {
    std::vector<float> block(kMixBlock * mixer_.channels());
    SoundClock::time_point begun = SoundClock::now(), tried = begun - kOpenAgain;
    double written = 0;  // since `begun` [s]
    while (!ending_) {
      {
        const std::lock_guard lock(mutex_);
        mixer_.mix(block);
      }
      const auto due = begun + std::chrono::duration_cast<SoundClock::duration>(
                                   std::chrono::duration<double>(written / kFastest));
      const SoundClock::time_point now = SoundClock::now();
      if (now - due > kMixAhead) {  // the device waits, or this thread had no processor: nothing is made up
        begun = now;
        written = 0;
      } else if (due - now > kMixAhead) {
        std::this_thread::sleep_until(due - kMixAhead);
      }
      written += static_cast<double>(kMixBlock) / SpeakerMixer::kRate;
      if (output_ && !output_->write(block)) output_.reset();
      if (output_ || now - tried < kOpenAgain) continue;
      tried = now;
      if (auto again = open_()) output_ = std::move(again.value());
    }
  }

  SpeakerMixer mixer_;  ///< under the mutex, but for channels()
  const std::string name_;
  OpenSpeakerOutput open_;
  std::mutex mutex_;
  std::unique_ptr<SpeakerOutput> output_;  ///< null: the device has gone
  std::atomic<bool> ending_ = false;
  std::thread thread_;
};

}  // namespace

Result<std::unique_ptr<SoundDevice>> openLoudspeakers(const LoudspeakerSet& hall, OpenSpeakerOutput open) {
  if (!open) open = [card = hall.card, channels = hall.channels()] { return openAlsaOutput(card, channels); };
  auto output = open();
  if (!output) return output.error();
  std::string name = fmt::format("{} loudspeaker{} on {} channels of \"{}\"", hall.all.size(),
                                 hall.all.size() == 1 ? "" : "s", hall.channels(),
                                 hall.card.empty() ? "default" : hall.card);
  return std::unique_ptr<SoundDevice>(
      std::make_unique<LoudspeakerDevice>(hall, std::move(name), std::move(open), std::move(output.value())));
}

}  // namespace stadion
