#include "pipeline/platform/draw_pool.h"

#include "engine/base/running_stage.h"

#include <algorithm>
#include <pthread.h>
#include <string>

namespace stadion {

// With fewer threads than requested, or none, the result is the same.
DrawPool::DrawPool(std::size_t threads, Callers callers)
    : most_(std::max<std::size_t>(threads, 1)), callers_(callers) {
  try {
    for (std::size_t i = callers_ == Callers::Work ? 1 : 0; i < most_; ++i) {
      threads_.emplace_back([this] { work(); });
      pthread_setname_np(threads_.back().native_handle(), ("draw-pool-" + std::to_string(i)).c_str());
    }
  } catch (const std::exception&) {
    // The system has no more threads, or no memory.
  }
}

DrawPool::~DrawPool() {
  {
    const std::lock_guard lock(mutex_);
    leaving_ = true;
  }
  changed_.notify_all();
  for (std::thread& t : threads_) t.join();
}

void DrawPool::run(std::size_t count, const std::function<void(std::size_t)>& piece) {
  if (count == 0) return;
  Job job{&piece, RunningStage::current(), count, 0, 0, count, nullptr};
  const bool works = callers_ == Callers::Work || threads_.empty();
  std::unique_lock lock(mutex_);
  jobs_.push_back(&job);
  changed_.notify_all();
  while (!job.isDone()) {
    if (works && job.hasMore() && working_ < most_)
      take(job, lock);
    else
      changed_.wait(lock);
  }
  std::erase(jobs_, &job);
  if (job.thrown) std::rethrow_exception(job.thrown);
}

DrawPool::Job* DrawPool::waiting() {
  const auto job = std::ranges::find_if(jobs_, &Job::hasMore);
  return job == jobs_.end() ? nullptr : *job;
}

void DrawPool::work() {
  std::unique_lock lock(mutex_);
  while (!leaving_) {
    Job* job = working_ < most_ ? waiting() : nullptr;
    if (job)
      take(*job, lock);
    else
      changed_.wait(lock);
  }
}

void DrawPool::take(Job& job, std::unique_lock<std::mutex>& lock) {
  const RunningStage running(job.stage);
  const std::size_t i = job.next++;
  ++job.running;
  ++working_;
  lock.unlock();
  std::exception_ptr thrown;
  try {
    (*job.piece)(i);
  } catch (...) {
    thrown = std::current_exception();
  }
  lock.lock();
  --job.running;
  --working_;
  if (thrown && i < job.firstThrown) {
    job.firstThrown = i;
    job.thrown = thrown;
    job.next = job.count;
  }
  if (job.isDone() || working_ + 1 == most_) changed_.notify_all();
}

}  // namespace stadion
