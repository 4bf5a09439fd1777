#pragma once
/// Hashes of the pictures that walls show, as lines, while a run plays.
///
/// A thread of its own computes and writes them. A live show never waits for it: if it falls behind, frames
/// are left out and counted. A run in which every frame counts waits.
///
/// Threads  PictureSink's; finish() after the run.

#include "pipeline/loop/show_stages.h"

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace stadion {

struct HashStreamOptions {
  std::vector<std::string> wallNames;
  std::function<void(const std::string&)> write;  ///< receives the lines of a frame; may wait
  PictureSink* next = nullptr;                    ///< takes the pictures, too; null: nothing else does
  bool everyFrame = false;                        ///< no frame is left out
};

class HashStream final : public PictureSink {
public:
  explicit HashStream(HashStreamOptions options);
  ~HashStream() override;

  bool wants(const TimeSignature&) const override { return true; }
  Failure take(const TimeSignature& now, const std::vector<EyePictures>& walls) override;

  /// Waits until everything is written. Returns the number of frames that were left out.
  std::uint64_t finish();

private:
  struct Shown {
    std::uint64_t frame;
    std::vector<EyePictures> walls;
  };
  void work();

  HashStreamOptions options_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Shown> waiting_;
  std::uint64_t leftOut_ = 0;
  bool ending_ = false;
  std::thread writer_;
};

}  // namespace stadion
