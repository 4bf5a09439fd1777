#include "show/output/hash_stream.h"

#include "show/output/picture_hashes.h"

namespace stadion {
namespace {

constexpr std::size_t kMostWaiting = 8;  ///< frames, for each of which pictures are kept

}  // namespace

HashStream::HashStream(HashStreamOptions options)
    : options_(std::move(options)), writer_([this] { work(); }) {}

HashStream::~HashStream() {
  finish();
}

Failure HashStream::take(const TimeSignature& now, const std::vector<EyePictures>& walls) {
  if (options_.next && options_.next->wants(now))
    if (Failure failure = options_.next->take(now, walls)) return failure;
  std::unique_lock lock(mutex_);
  if (options_.everyFrame) changed_.wait(lock, [&] { return waiting_.size() < kMostWaiting; });
  if (waiting_.size() >= kMostWaiting) {
    ++leftOut_;
    return Failure{};
  }
  waiting_.push_back({now.frame, walls});
  changed_.notify_all();
  return {};
}

std::uint64_t HashStream::finish() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
    changed_.notify_all();
  }
  if (writer_.joinable()) writer_.join();
  return leftOut_;
}

void HashStream::work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [&] { return ending_ || !waiting_.empty(); });
    if (waiting_.empty()) return;
    const Shown shown = std::move(waiting_.front());
    waiting_.pop_front();
    changed_.notify_all();
    lock.unlock();
    options_.write(hashLinesOf(shown.frame, shown.walls, options_.wallNames));
    lock.lock();
  }
}

}  // namespace stadion
