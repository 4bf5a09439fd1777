#include "engine/base/worker_pool.h"

#include "engine/base/running_stage.h"

#include <algorithm>
#include <exception>

namespace stadion {
namespace {

using Clock = std::chrono::steady_clock;

/// Approximate cost of waking a thread and waiting for it again.
constexpr std::chrono::nanoseconds kWaking{50'000};

}  // namespace

// With fewer threads than requested, or none, the result is the same.
WorkerPool::WorkerPool(std::size_t threads) {
  try {
    for (std::size_t i = 1; i < threads; ++i) threads_.emplace_back([this] { help(); });
  } catch (const std::exception&) {
    // The system has no more threads, or no memory.
  }
}

WorkerPool::~WorkerPool() {
  {
    const std::lock_guard lock(mutex_);
    leaving_ = true;
  }
  begin_.notify_all();
  for (std::thread& t : threads_) t.join();
}

void WorkerPool::run(std::size_t count, const std::function<void(std::size_t)>& piece) {
  thrown_.assign(count, nullptr);
  const std::function<void(std::size_t)> pieceOfStage = [&piece, stage = RunningStage::current()](auto i) {
    const RunningStage running(stage);
    piece(i);
  };
  {
    const std::lock_guard lock(mutex_);
    piece_ = &pieceOfStage;
    count_ = count;
    next_ = 0;
    ++round_;
  }
  work_ = 0;
  if (worthIt_) callHelp(count);
  takePieces();
  std::unique_lock lock(mutex_);
  end_.wait(lock, [this] { return helping_ == 0; });
  piece_ = nullptr;  // a thread that wakes late finds no work
  worthIt_ = work_ > kWaking.count();
  for (const std::exception_ptr& e : thrown_)
    if (e) std::rethrow_exception(e);
}

void WorkerPool::callHelp(std::size_t count) {
  for (std::size_t i = 1; i < count && i <= threads_.size(); ++i) begin_.notify_one();
}

void WorkerPool::help() {
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

void WorkerPool::takePieces() {
  const Clock::time_point began = Clock::now();
  for (std::size_t i = next_++; i < count_; i = next_++) try {
      (*piece_)(i);
    } catch (...) {
      thrown_[i] = std::current_exception();
    }
  work_ += std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now() - began).count();
}

}  // namespace stadion
