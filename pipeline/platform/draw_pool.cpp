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
    while (!waiters_.empty()) wake(*waiters_.back());
  }
  for (std::thread& t : threads_) t.join();
}

void DrawPool::run(std::size_t count, const std::function<void(std::size_t)>& piece) {
  if (count == 0) return;
  Job job{&piece, RunningStage::current(), count, 0, 0, count, nullptr};
  const bool works = callers_ == Callers::Work || threads_.empty();
  Lock lock(mutex_);
  jobs_.push_back(&job);
  while (!job.isDone()) {
    if (works && job.hasMore() && working_ < most_) {
      take(job, lock);
    } else {
      offerPlace();
      wait(&job, lock);
    }
  }
  std::erase(jobs_, &job);
  offerPlace();
  if (job.thrown) std::rethrow_exception(job.thrown);
}

DrawPool::Job* DrawPool::jobWithMore() {
  const auto job = std::ranges::find_if(jobs_, &Job::hasMore);
  return job == jobs_.end() ? nullptr : *job;
}

void DrawPool::work() {
  Lock lock(mutex_);
  while (!leaving_) {
    if (Job* job = working_ < most_ ? jobWithMore() : nullptr)
      take(*job, lock);
    else
      wait(nullptr, lock);
  }
}

void DrawPool::take(Job& job, Lock& lock) {
  const RunningStage running(job.stage);
  const std::size_t i = job.next++;
  ++job.running, ++working_;
  offerPlace();
  lock.unlock();
  std::exception_ptr thrown;
  try {
    (*job.piece)(i);
  } catch (...) {
    thrown = std::current_exception();
  }
  lock.lock();
  --job.running, --working_;
  if (thrown && i < job.firstThrown) {
    job.firstThrown = i;
    job.thrown = thrown;
    job.next = job.count;
  }
  if (!job.isDone()) return;
  const auto caller = std::ranges::find(waiters_, &job, &Waiter::job);
  if (caller != waiters_.end()) wake(**caller);
}

void DrawPool::wait(const Job* job, Lock& lock) {
  Waiter self;
  self.job = job;
  waiters_.push_back(&self);
  self.woken.wait(lock, [&] { return self.isWoken; });
}

void DrawPool::wake(Waiter& waiter) {
  std::erase(waiters_, &waiter);
  waiter.isWoken = true;
  waiter.woken.notify_one();
}

bool DrawPool::canWork(const Waiter& waiter) {
  if (!waiter.job) return jobWithMore() != nullptr;
  return (callers_ == Callers::Work || threads_.empty()) && waiter.job->hasMore();
}

// Only one thread is woken. It offers the next place, if there is one, when it takes its piece. So no thread
// is woken for nothing: with many small pieces that cost 6 % of the time.
void DrawPool::offerPlace() {
  if (working_ >= most_) return;
  const auto waiter = std::ranges::find_if(waiters_, [this](const Waiter* w) { return canWork(*w); });
  if (waiter != waiters_.end()) wake(**waiter);
}

}  // namespace stadion
