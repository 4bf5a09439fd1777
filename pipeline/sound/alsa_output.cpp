#include "pipeline/sound/alsa_output.h"

#include "engine/base/shared_library.h"
#include "pipeline/sound/sound_libraries.h"
#include "pipeline/sound/speaker_mixer.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <vector>

namespace stadion {
namespace {

constexpr unsigned kLatency = 50'000;  ///< of the device's buffer [us]

// Values of ALSA's enumerations, which are part of its binary interface.
constexpr int kPlayback = 0, kInterleaved = 3, kFloat = 14, kInt32 = 10, kInt16 = 2;

/// The functions of the library that are used.
struct Alsa {
  int (*open)(void** pcm, const char* name, int stream, int mode) = nullptr;
  int (*setParams)(void* pcm, int format, int access, unsigned channels, unsigned rate, int resample,
                   unsigned latency) = nullptr;
  long (*write)(void* pcm, const void* frames, unsigned long count) = nullptr;
  int (*recover)(void* pcm, int error, int silent) = nullptr;
  int (*drop)(void* pcm) = nullptr;
  int (*close)(void* pcm) = nullptr;
  const char* (*text)(int error) = nullptr;

  bool load(const SharedLibrary& library) {
    const auto get = [&](auto& function, const char* name) {
      function = library.find<std::remove_pointer_t<std::remove_reference_t<decltype(function)>>>(name);
      return function != nullptr;
    };
    return get(open, "snd_pcm_open") && get(setParams, "snd_pcm_set_params") &&
           get(write, "snd_pcm_writei") && get(recover, "snd_pcm_recover") && get(drop, "snd_pcm_drop") &&
           get(close, "snd_pcm_close") && get(text, "snd_strerror");
  }
};

class AlsaOutput final : public SpeakerOutput {
public:
  AlsaOutput(const Alsa& alsa, std::uint32_t channels) : alsa_(alsa), channels_(channels) {}
  ~AlsaOutput() override {
    if (!pcm_) return;
    alsa_.drop(pcm_);
    alsa_.close(pcm_);
  }
  AlsaOutput(const AlsaOutput&) = delete;
  AlsaOutput& operator=(const AlsaOutput&) = delete;

  /// Why it cannot be opened; empty if it is.
  std::string open(const std::string& device) {
    int wrong = alsa_.open(&pcm_, device.c_str(), kPlayback, 0);
    if (wrong < 0) {
      pcm_ = nullptr;
      return alsa_.text(wrong);
    }
    for (const int format : {kFloat, kInt32, kInt16}) {
      wrong = alsa_.setParams(pcm_, format, kInterleaved, channels_, SpeakerMixer::kRate, 1, kLatency);
      format_ = format;
      if (wrong >= 0) return {};
    }
    return fmt::format("it plays no {} channels at {} Hz ({})", channels_, SpeakerMixer::kRate,
                       alsa_.text(wrong));
  }

  bool write(std::span<const float> frames) override {
    const std::size_t bytes = convert(frames) * channels_;
    for (std::size_t at = 0, left = frames.size() / channels_; left > 0;) {
      const long done = alsa_.write(pcm_, &converted_[at * bytes], left);
      if (done < 0 && alsa_.recover(pcm_, static_cast<int>(done), 1) < 0) return false;
      if (done <= 0) continue;
      at += static_cast<std::size_t>(done);
      left -= static_cast<std::size_t>(done);
    }
    return true;
  }

private:
  template <class Sample, class Value>
  std::size_t fill(std::span<const float> frames, const Value& value) {
    converted_.resize(frames.size() * sizeof(Sample));
    for (std::size_t i = 0; i < frames.size(); ++i) {
      const Sample sample = value(std::clamp(static_cast<double>(frames[i]), -1.0, 1.0));
      std::memcpy(&converted_[i * sizeof sample], &sample, sizeof sample);
    }
    return sizeof(Sample);
  }
  /// Returns the bytes of a sample.
  std::size_t convert(std::span<const float> frames) {
    if (format_ == kFloat) return fill<float>(frames, [](double x) { return static_cast<float>(x); });
    if (format_ == kInt32)
      return fill<std::int32_t>(
          frames, [](double x) { return static_cast<std::int32_t>(std::lround(x * 2147483647.0)); });
    return fill<std::int16_t>(frames,
                              [](double x) { return static_cast<std::int16_t>(std::lround(x * 32767.0)); });
  }

  Alsa alsa_;
  std::uint32_t channels_;
  void* pcm_ = nullptr;
  int format_ = kFloat;
  std::vector<char> converted_;
};

}  // namespace

Result<std::unique_ptr<SpeakerOutput>> openAlsaOutput(const std::string& device, std::uint32_t channels) {
  quietAlsa();
  const auto library = SharedLibrary::open("libasound.so.2", "libasound2");
  if (!library) return library.error();
  using Made = Result<std::unique_ptr<SpeakerOutput>>;
  Alsa alsa;
  if (!alsa.load(library.value())) return Made::failure("libasound.so.2 lacks functions of ALSA 1.2");
  const std::string name = device.empty() ? "default" : device;
  auto output = std::make_unique<AlsaOutput>(alsa, channels);
  if (const std::string why = output->open(name); !why.empty())
    return Made::failure(fmt::format("the sound device \"{}\" cannot be opened: {}", name, why));
  return std::unique_ptr<SpeakerOutput>(std::move(output));
}

}  // namespace stadion
