#pragma once
/// Records a video of a run with the ffmpeg program (H.264 in MP4).
///
/// A thread of the writer's own sends frames to ffmpeg through a pipe, so the caller never waits. The file
/// gets its name only when ffmpeg has succeeded and ffprobe has counted every frame in it.
///
/// Ownership  owns the thread and the child; a destructor without finish() ends both and leaves no file.
/// Threads    offer(), waitForRoom() and finish() from one thread.
/// Errors     The first one is kept, later offers are refused, and finish() reports it: no ffmpeg, a full
///            disk, an encoder that fails, stalls or loses frames. The run goes on without the video.

#include "engine/base/diagnostic.h"
#include "pipeline/picture/picture.h"

#include <chrono>
#include <memory>
#include <optional>
#include <string>

namespace stadion {

struct VideoOptions {
  std::uint32_t width = 0, height = 0;  ///< size of every frame [pixels]
  double rate = 60;                     ///< [frames/s]
  std::size_t queue = 8;                ///< frames that may wait
  std::string ffmpeg = "ffmpeg";        ///< programs, found along PATH
  std::string ffprobe = "ffprobe";
  std::chrono::milliseconds patience{60'000};  ///< time limit for a stalled encoder
};

struct VideoReport {
  std::uint64_t frames = 0;  ///< in the file
  std::uint64_t bytes = 0;
};

class VideoWriter {
public:
  enum class Offer {
    Taken,
    Full,    ///< the queue is full; the caller keeps the picture
    Refused  ///< the video has failed, or the picture has the wrong size
  };

  VideoWriter(std::string path, const VideoOptions& options);
  ~VideoWriter();

  /// Takes the picture if there is room.
  Offer offer(Picture&& picture);
  /// Waits until there is room, the video fails or the time is up. Returns true if an offer would not be
  /// Full.
  bool waitForRoom(std::chrono::milliseconds limit);
  bool failed() const;
  bool lacksEncoder() const;  ///< ffmpeg is not installed; known after finish()

  /// Ends the file and checks it. Returns its content, or why there is none.
  Result<VideoReport> finish();

private:
  class Work;
  std::unique_ptr<Work> work_;
};

}  // namespace stadion
