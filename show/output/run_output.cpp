#include "show/output/run_output.h"

#include "pipeline/picture/contact_sheet.h"

#include <algorithm>
#include <charconv>
#include <exception>
#include <fmt/format.h>
#include <new>

namespace stadion {
namespace {

constexpr std::size_t kQueue = 4;  // frames that may wait to be written

}  // namespace

std::optional<PictureChoice> PictureChoice::parse(const std::string& text) {
  if (text == "last") return PictureChoice{Kind::Last, 1};
  if (text == "all") return PictureChoice{Kind::All, 1};
  if (text == "none") return PictureChoice{Kind::None, 1};
  PictureChoice c{Kind::EveryNth, 0};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), c.n);
  if (error != std::errc{} || end != text.data() + text.size() || c.n == 0) return std::nullopt;
  return c;
}

RunOutput::RunOutput(RunOutputOptions options) : options_(std::move(options)) {
  if (options_.hashes) hashes_.emplace(options_.folder, options_.wallNames, options_.further);
  writer_ = std::thread([this] { work(); });
}

RunOutput::~RunOutput() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
    changed_.notify_all();
  }
  if (writer_.joinable()) writer_.join();
}

bool RunOutput::wantsPictures(std::uint64_t frame) const {
  switch (options_.pictures.kind) {
  case PictureChoice::Kind::All: return true;
  case PictureChoice::Kind::EveryNth: return frame % options_.pictures.n == 0;
  case PictureChoice::Kind::None:
  case PictureChoice::Kind::Last: return false;
  }
  return false;
}

bool RunOutput::wants(const TimeSignature& now) const {
  return (options_.video && !videoFailed_) || options_.hashes || wantsPictures(now.frame);
}

Failure RunOutput::take(const TimeSignature& now, const std::vector<EyePictures>& walls) {
  // A machine of a cluster that catches up draws nothing: what it has is older.
  const auto isDrawn = [&](const EyePictures& wall) { return wall.frame == now.frame; };
  if (std::ranges::none_of(walls, isDrawn)) return {};
  const auto shown = std::chrono::steady_clock::now();
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return jobs_.size() < kQueue || failed_; });
  if (failed_) return failure_;
  jobs_.push_back({now.frame, walls, wantsPictures(now.frame), shown});
  changed_.notify_all();
  return {};
}

void RunOutput::work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [&] { return ending_ || !jobs_.empty(); });
    if (jobs_.empty()) return;
    const Job job = std::move(jobs_.front());
    jobs_.pop_front();
    changed_.notify_all();
    lock.unlock();
    guard([&] { write(job); });
    lock.lock();
    if (failed_) jobs_.clear();
    changed_.notify_all();
  }
}

/// Nothing that is thrown while pictures are written may end the process.
template <class Work>
void RunOutput::guard(const Work& work) {
  try {
    work();
  } catch (const std::exception& e) {
    failBy(e.what());
  }
}

void RunOutput::failBy(const char* thrown) noexcept {
  try {
    fail(Reason(std::string("writing pictures: ") + thrown));
  } catch (const std::bad_alloc&) {
    fail(Reason("out of memory"));  // not even enough for a sentence
  }
}

void RunOutput::fail(Reason why) {
  const std::lock_guard lock(mutex_);
  if (!failure_) failure_ = std::move(why);
  failed_ = true;
}

void RunOutput::write(const Job& job) {
  if (job.pictures) writePictures(job);
  if (options_.video) addToVideo(job);
  if (!hashes_ || failed_) return;
  if (const auto wrong = hashes_->add(job.frame, job.walls, job.shown))
    fail(Reason(*wrong, FailureKind::Refusal));
}

void RunOutput::writePictures(const Job& job) {
  for (std::size_t w = 0; w < job.walls.size(); ++w) {
    const std::vector<Picture>& eyes = job.walls[w].eyes;
    const auto name = [&](const std::string& what) {
      return fmt::format("{}-{}-{:06}.png", options_.wallNames[w], what, job.frame);
    };
    if (eyes.size() == 2 && !keepsEyesApart(options_.layout))
      writeFile(name(stereoLayoutName(options_.layout)), compose(options_.layout, eyes[0], eyes[1]));
    else
      for (std::size_t e = 0; e < eyes.size(); ++e) writeFile(name(pictureName(e)), eyes[e]);
  }
  if (options_.sheets) writeFile(fmt::format("contact-sheet-{:06}.png", job.frame), sheetOf(job, 320));
  lastWritten_ = job.frame;
}

Picture RunOutput::sheetOf(const Job& job, std::uint32_t cellWidth) const {
  std::vector<WallPictures> walls;
  for (std::size_t w = 0; w < job.walls.size(); ++w) {
    const std::vector<Picture>& eyes = job.walls[w].eyes;
    walls.push_back({options_.wallNames[w], eyes.empty() ? nullptr : &eyes[0],
                     eyes.size() < 2 ? nullptr : &eyes[1], options_.wallAspects[w]});
  }
  return contactSheet(walls, job.frame, cellWidth);
}

void RunOutput::addToVideo(const Job& job) {
  if (videoFailed_) return;
  Picture frame = sheetOf(job, 480);
  if (!video_) {
    VideoOptions video;
    video.width = frame.width;
    video.height = frame.height;
    video.rate = options_.rate;
    if (const auto wrong = options_.folder.note("video.mp4"))
      return fail(Reason(*wrong, FailureKind::Refusal));
    video_ = std::make_unique<VideoWriter>(options_.folder.pathOf("video.mp4"), video);
  }
  // Here every frame counts, and only the show's own back-pressure waits for the video.
  while (!video_->failed() && !video_->waitForRoom(std::chrono::seconds(1))) {
  }
  videoFailed_ = video_->failed();
  if (!videoFailed_) video_->offer(std::move(frame));
}

void RunOutput::writeFile(const std::string& name, const Picture& picture) {
  if (failed_) return;
  auto wrong = options_.folder.note(name);
  if (!wrong) wrong = writePng(options_.folder.pathOf(name), picture);
  if (wrong) return fail(Reason(*wrong, FailureKind::Refusal));
}

void RunOutput::writeLast(const Job& last) {
  if (options_.pictures.kind == PictureChoice::Kind::None) return;
  const bool whole = std::ranges::all_of(
      last.walls, [&](const EyePictures& w) { return !w.eyes.empty() && w.frame == last.frame; });
  if (last.walls.empty() || !whole) {
    remarks_.push_back("no contact sheet: the run ended before its last frame was drawn");
    return;
  }
  if (options_.pictures.kind == PictureChoice::Kind::Last && lastWritten_ != last.frame) writePictures(last);
  writeFile("contact-sheet.png", sheetOf(last, 320));
  if (!failed_) files_.push_back(options_.folder.pathOf("contact-sheet.png"));
}

void RunOutput::finish(const std::vector<EyePictures>& walls) {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
    changed_.notify_all();
  }
  writer_.join();
  guard([&] { writeLast({walls.empty() ? 0 : walls[0].frame, walls, true, {}}); });
  if (!video_) return;
  auto report = video_->finish();
  if (report)
    files_.push_back(options_.folder.pathOf("video.mp4"));
  else
    video_->lacksEncoder() ? remarks_.push_back("no video: " + report.error().message)
                           : fail(Reason(report.error(), FailureKind::Refusal));
}

}  // namespace stadion
