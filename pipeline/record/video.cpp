#include "pipeline/record/video.h"

#include "pipeline/platform/child_process.h"

#include <fmt/format.h>

#include <atomic>
#include <cerrno>
#include <charconv>
#include <condition_variable>
#include <csignal>
#include <cstring>
#include <deque>
#include <exception>
#include <fcntl.h>
#include <filesystem>
#include <mutex>
#include <poll.h>
#include <thread>
#include <unistd.h>

namespace stadion {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;

constexpr std::uint64_t kFreeSpace = 64ull << 20;  ///< below this the disk counts as full [bytes]
constexpr std::uint64_t kCheckEvery = 64;          ///< frames between two checks of the disk

/// Returns the most informative line of ffmpeg's messages: the last one.
std::string lastLine(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.pop_back();
  const std::size_t begin = text.rfind('\n');
  return begin == std::string::npos ? text : text.substr(begin + 1);
}

bool diskIsFull(const std::string& path) {
  fs::path folder = fs::path(path).parent_path();
  if (folder.empty()) folder = ".";
  std::error_code problem;
  const fs::space_info space = fs::space(folder, problem);
  return !problem && space.available < kFreeSpace;
}

/// ffmpeg reads "name:..." as a protocol; this prefix makes any path a plain file.
std::string plainFile(const std::string& path) {
  return fmt::format("file:{}", path);
}

std::vector<std::string> encoderArguments(const VideoOptions& o, const std::string& target) {
  return {o.ffmpeg, "-nostdin", "-hide_banner", "-loglevel", "error", "-xerror", "-y", "-f", "rawvideo",
          "-pix_fmt", "rgba", "-video_size", fmt::format("{}x{}", o.width, o.height), "-framerate",
          fmt::format("{}", o.rate), "-i", "pipe:0",
          // Chroma at half resolution needs even sides.
          "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-c:v", "libx264", "-preset", "veryfast", "-crf", "18",
          "-pix_fmt", "yuv420p", "-movflags", "+faststart", "-f", "mp4", plainFile(target)};
}

}  // namespace

/// The writer's private part: the queue between the threads, and the thread's work.
class VideoWriter::Work {
public:
  Work(std::string path, const VideoOptions& options) : path_(std::move(path)), options_(options) {
    const fs::path target(path_);
    temporary_ =
        (target.parent_path() / fmt::format(".{}.{}.part", target.filename().string(), getpid())).string();
    thread_ = std::thread([this] { run(); });
  }

  ~Work() {
    close(true);
    std::error_code ignored;
    fs::remove(temporary_, ignored);
  }

  Offer offer(Picture&& picture) {
    const std::lock_guard lock(mutex_);
    if (failed_ || closed_) return Offer::Refused;
    if (picture.width != options_.width || picture.height != options_.height) return Offer::Refused;
    if (queue_.size() >= options_.queue) return Offer::Full;
    queue_.push_back(std::move(picture));
    changed_.notify_all();
    return Offer::Taken;
  }

  bool waitForRoom(milliseconds limit) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, limit, [this] { return failed_ || queue_.size() < options_.queue; });
  }

  bool failed() const {
    const std::lock_guard lock(mutex_);
    return failed_.has_value();
  }

  Result<VideoReport> finish() {
    close(false);
    const std::lock_guard lock(mutex_);
    if (failed_) return *failed_;
    return report_;
  }

  bool lacksEncoder() const { return lacksEncoder_; }

private:
  void close(bool abandon) {
    {
      const std::lock_guard lock(mutex_);
      closed_ = true;
    }
    if (abandon) abandoned_ = true;
    changed_.notify_all();
    if (thread_.joinable()) thread_.join();
  }

  void fail(const std::string& why) {
    const std::lock_guard lock(mutex_);
    if (failed_) return;
    Diagnostic& d = failed_.emplace();
    d.where.file = path_;
    d.message = why;
    queue_.clear();
    changed_.notify_all();
  }

  void run() {
    // Writing to an encoder that has exited must be an error here, not a signal that ends the show. The
    // signal is blocked in this thread alone, so the rest of the process is unaffected.
    sigset_t pipe;
    sigemptyset(&pipe);
    sigaddset(&pipe, SIGPIPE);
    pthread_sigmask(SIG_BLOCK, &pipe, nullptr);
    try {
      if (start() && feed() && finishEncoder() && verify()) publish();
    } catch (const std::exception& e) {  // for instance out of memory: there is no video, and the show goes
                                         // on
      fail(e.what());
    }
  }

  bool start() {
    if (options_.width == 0 || options_.height == 0 || !(options_.rate > 0))
      return no("a video needs a size and a rate");
    if (diskIsFull(path_))
      return no("there are less than 64 MiB free on its disk; the run goes on without video");
    Pipe pipe = makePipe();
    complaints_ = makeMemoryFile();
    if (!pipe.write || !complaints_) return no(fmt::format("no pipe to ffmpeg: {}", std::strerror(errno)));
    const auto problem =
        encoder_.start(encoderArguments(options_, temporary_), {pipe.read.get(), -1, complaints_.get()});
    lacksEncoder_ = problem && *problem == ENOENT;
    if (lacksEncoder_)
      return no("ffmpeg is not installed (apt-get install ffmpeg); the run goes on without video");
    if (problem) return no(fmt::format("ffmpeg did not start: {}", std::strerror(*problem)));
    toEncoder_ = std::move(pipe.write);
    fcntl(toEncoder_.get(), F_SETFL, O_NONBLOCK);
    return true;
  }

  bool no(const std::string& why) {
    fail(why);
    return false;
  }

  std::optional<Picture> take() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return closed_ || !queue_.empty(); });
    if (queue_.empty() || abandoned_) return std::nullopt;
    Picture picture = std::move(queue_.front());
    queue_.pop_front();
    changed_.notify_all();
    return picture;
  }

  bool feed() {
    while (const auto picture = take()) {
      if (sent_ % kCheckEvery == 0 && diskIsFull(path_))
        return no("the disk is full; the video was given up");
      if (!send(*picture)) return false;
      ++sent_;
    }
    return !abandoned_;
  }

  bool send(const Picture& picture) {
    const std::uint8_t* bytes = picture.rgba.data();
    std::size_t left = picture.rgba.size();
    auto deadline = std::chrono::steady_clock::now() + options_.patience;
    while (left > 0) {
      const ssize_t wrote = write(toEncoder_.get(), bytes, left);
      if (wrote > 0) {
        bytes += wrote;
        left -= static_cast<std::size_t>(wrote);
        deadline = std::chrono::steady_clock::now() + options_.patience;
      } else if (wrote < 0 && errno == EAGAIN) {
        if (abandoned_) return false;
        if (std::chrono::steady_clock::now() > deadline)
          return no("ffmpeg has stalled; the video was given up");
        pollfd ready{toEncoder_.get(), POLLOUT, 0};
        poll(&ready, 1, 50);
      } else if (!(wrote < 0 && errno == EINTR)) {
        encoder_.wait(milliseconds(1000));  // so that its last messages are complete
        return no(fmt::format("ffmpeg failed: {}", reason()));
      }
    }
    return true;
  }

  std::string reason() const {
    const std::string said = lastLine(contentOf(complaints_));
    return said.empty() ? "it ended before its time" : said;
  }

  /// Waits for a child in small steps, so that the wait can be stopped.
  std::optional<int> ended(ChildProcess& child) {
    const auto deadline = std::chrono::steady_clock::now() + options_.patience;
    while (!abandoned_ && std::chrono::steady_clock::now() < deadline)
      if (const auto status = child.wait(milliseconds(50))) return status;
    return std::nullopt;
  }

  bool finishEncoder() {
    toEncoder_.close();
    const auto status = ended(encoder_);
    if (sent_ == 0) return no("no frame was drawn for it");
    if (!status) return no("ffmpeg did not end; the video was given up");
    if (*status != 0) return no(fmt::format("ffmpeg failed: {}", reason()));
    return true;
  }

  /// An encoder that reports success may still have lost frames on a full disk. Counts the frames in the
  /// file.
  bool verify() {
    const FileDescriptor answer = makeMemoryFile();
    ChildProcess probe;
    const auto problem =
        probe.start({options_.ffprobe, "-v", "error", "-count_packets", "-select_streams", "v:0",
                     "-show_entries", "stream=nb_read_packets", "-of", "csv=p=0", plainFile(temporary_)},
                    {-1, answer.get(), -1});
    if (problem)
      return no(
          fmt::format("the video cannot be checked, ffprobe did not start: {}", std::strerror(*problem)));
    const auto status = ended(probe);
    const std::string text = contentOf(answer);
    std::uint64_t frames = 0;
    std::from_chars(text.data(), text.data() + text.size(), frames);
    if (!status || *status != 0) return no("ffprobe cannot read the video");
    if (frames != sent_) return no(fmt::format("the video has {} of {} frames", frames, sent_));
    return true;
  }

  void publish() {
    std::error_code problem;
    const std::uint64_t bytes = fs::file_size(temporary_, problem);
    if (!problem) fs::rename(temporary_, path_, problem);
    if (problem) return fail(fmt::format("cannot be written: {}", problem.message()));
    const std::lock_guard lock(mutex_);
    report_ = {sent_, bytes};
  }

  const std::string path_;
  const VideoOptions options_;
  std::string temporary_;

  mutable std::mutex mutex_;  ///< guards the next five
  std::condition_variable changed_;
  std::deque<Picture> queue_;
  bool closed_ = false;
  bool lacksEncoder_ = false;  ///< belongs to the thread until it is joined
  std::optional<Diagnostic> failed_;
  VideoReport report_;
  std::atomic<bool> abandoned_ = false;

  ChildProcess encoder_;  ///< from here on: used by the thread only
  FileDescriptor toEncoder_;
  FileDescriptor complaints_;
  std::uint64_t sent_ = 0;

  std::thread thread_;
};

VideoWriter::VideoWriter(std::string path, const VideoOptions& options)
    : work_(std::make_unique<Work>(std::move(path), options)) {}

VideoWriter::~VideoWriter() = default;

VideoWriter::Offer VideoWriter::offer(Picture&& picture) {
  return work_->offer(std::move(picture));
}

bool VideoWriter::waitForRoom(std::chrono::milliseconds limit) {
  return work_->waitForRoom(limit);
}

bool VideoWriter::failed() const {
  return work_->failed();
}

bool VideoWriter::lacksEncoder() const {
  return work_->lacksEncoder();
}

Result<VideoReport> VideoWriter::finish() {
  return work_->finish();
}

}  // namespace stadion
