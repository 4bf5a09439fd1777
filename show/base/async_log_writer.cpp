#include "show/base/async_log_writer.h"

#include <utility>

namespace stadion {
namespace {

constexpr std::size_t kMostLines = 1000;

}  // namespace

AsyncLogWriter::AsyncLogWriter(std::function<void(const std::string&)> say)
    : say_(std::move(say)), thread_([this] { work(); }) {}

AsyncLogWriter::~AsyncLogWriter() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void AsyncLogWriter::write(std::string line) {
  {
    const std::lock_guard lock(mutex_);
    if (lines_.size() < kMostLines) lines_.push_back(std::move(line));
  }
  changed_.notify_all();
}

void AsyncLogWriter::work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return ending_ || !lines_.empty(); });
    if (lines_.empty()) return;
    const std::string line = std::move(lines_.front());
    lines_.pop_front();
    lock.unlock();
    say_(line);
    lock.lock();
  }
}

}  // namespace stadion
