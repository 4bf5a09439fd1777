#pragma once
/// Plays the show's sounds. Like the walls, it reads what App publishes.
///
/// In each frame it gets the sounding voices with their start times and places, and starts and stops voices
/// accordingly. It sends nothing back, so the show is the same with or without a device.
///
/// A sound's volume falls to zero at its range R: with d its distance from the head, it is (1 - d/R)^2.
///
/// Threads    one of its own, which reads files and waits for the device; play() is App's and only hands
///            over.
/// Ownership  borrows the roots, which must outlive it.
/// Errors     without a device it says so once, and is silent.

#include "pipeline/sound/sample_store.h"
#include "pipeline/sound/sound_device.h"
#include "pipeline/sound/sound_sink.h"

#include <condition_variable>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>

namespace stadion {

/// Returns the volume of a sound of range R [m] at a distance [m]; 1 if R is 0.
double loudnessAt(double distance, double range);

class SoundPlayer final : public SoundSink {
public:
  using OpenDevice = std::function<Result<std::unique_ptr<SoundDevice>>()>;

  /// `tell` gets one line when the first sound plays: the device's name, or why there is none.
  SoundPlayer(const AssetRoots& roots, std::function<void(const std::string&)> tell,
              OpenDevice open = openSoundDevice);
  ~SoundPlayer() override;
  SoundPlayer(const SoundPlayer&) = delete;
  SoundPlayer& operator=(const SoundPlayer&) = delete;

  void play(SoundScape& scape, const SoundMix& mix) override;
  /// Waits until all sounds handed over have reached the device.
  void waitUntilPlayed();

private:
  struct Playing {
    SoundDevice::Voice voice = 0;
    Nanoseconds since = 0;
    bool paused = false;
  };

  void work();
  void follow(const SoundScape& scape, const SoundMix& mix);
  void begin(const SoundRecord& sound, Nanoseconds now, Playing& playing);
  void openDevice();

  std::function<void(const std::string&)> tell_;
  OpenDevice open_;

  bool silent_ = true;  ///< the last scape was silent; used by App only

  std::mutex mutex_;
  std::condition_variable changed_;
  SoundScape next_;  ///< from here to `ending_`: shared, under the mutex
  SoundMix nextMix_;
  bool fresh_ = false, busy_ = false, ending_ = false;

  bool opened_ = false;  ///< from here on: used by the thread only
  std::unique_ptr<SoundDevice> device_;
  double volume_ = -1;
  std::map<NodeRef, Playing> playing_;
  SampleStore samples_;
  std::thread thread_;
};

}  // namespace stadion
