#include "engine/crew.h"

#include <algorithm>

namespace stadion {

Crew::Crew(std::size_t threads) {
  for (std::size_t i = 1; i < threads; ++i) threads_.emplace_back([this] { help(); });
}

Crew::~Crew() {
  {
    const std::lock_guard lock(mutex_);
    leaving_ = true;
  }
  begin_.notify_all();
  for (std::thread& t : threads_) t.join();
}

void Crew::run(std::size_t count, const std::function<void(std::size_t)>& piece) {
  thrown_.assign(count, nullptr);
  {
    const std::lock_guard lock(mutex_);
    piece_ = &piece, count_ = count;
    next_ = 0;
    ++round_;
  }
  for (std::size_t i = 0; i < std::min(threads_.size(), count - std::min<std::size_t>(count, 1)); ++i)
    begin_.notify_one();
  takePieces();
  std::unique_lock lock(mutex_);
  end_.wait(lock, [this] { return helping_ == 0; });
  piece_ = nullptr;  // who wakes up late finds nothing to do
  for (const std::exception_ptr& e : thrown_)
    if (e) std::rethrow_exception(e);
}

void Crew::help() {
  std::uint64_t seen = 0;
  std::unique_lock lock(mutex_);
  for (;;) {
    begin_.wait(lock, [&] { return leaving_ || (piece_ && round_ != seen); });
    if (leaving_) return;
    seen = round_;
    ++helping_;
    lock.unlock();
    takePieces();
    lock.lock();
    if (--helping_ == 0) end_.notify_one();
  }
}

void Crew::takePieces() {
  for (std::size_t i = next_++; i < count_; i = next_++) try {
      (*piece_)(i);
    } catch (...) {
      thrown_[i] = std::current_exception();
    }
}

}  // namespace stadion
