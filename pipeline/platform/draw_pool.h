#pragma once
/// The threads of the CPU renderer: walls that draw at the same time share its threads.
///
/// Order      the pieces of the wall that came first are taken first, in order. Results must not depend on
///            the thread of a piece.
/// Threads    run() may be called on any number of threads at a time. A caller works at its own pieces while
///            fewer threads than the pool's number are at work. A thread runs the stage of its job's caller.
/// Errors     run() throws the first exception of a piece, by number; later pieces are then left out.

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace stadion {

struct StageRecord;

class DrawPool {
public:
  /// Whether callers of run() work at their pieces, or leave them to the pool: then what a caller does itself
  /// can be measured by its processor time.
  enum class Callers { Work, Wait };

  /// So many threads work at a time, callers included; at least one.
  explicit DrawPool(std::size_t threads, Callers callers = Callers::Work);
  ~DrawPool();
  DrawPool(const DrawPool&) = delete;
  DrawPool& operator=(const DrawPool&) = delete;

  /// Calls piece(0) ... piece(count - 1) and waits until all are done.
  void run(std::size_t count, const std::function<void(std::size_t)>& piece);

  std::size_t threads() const { return most_; }

private:
  struct Job {
    const std::function<void(std::size_t)>* piece;
    StageRecord* stage;  ///< of the caller, in which the pool's threads run the pieces
    std::size_t count, next = 0, running = 0;
    std::size_t firstThrown;
    std::exception_ptr thrown;
    bool hasMore() const { return next < count; }
    bool isDone() const { return !hasMore() && running == 0; }
  };
  /// A thread that waits: a caller for its job, a thread of the pool for any.
  struct Waiter {
    const Job* job = nullptr;
    bool isWoken = false;
    std::condition_variable woken;
  };
  using Lock = std::unique_lock<std::mutex>;

  void work();
  Job* jobWithMore();
  void take(Job& job, Lock& lock);
  void wait(const Job* job, Lock& lock);
  void wake(Waiter& waiter);
  bool canWork(const Waiter& waiter);
  void offerPlace();

  const std::size_t most_;
  const Callers callers_;
  std::mutex mutex_;
  std::deque<Job*> jobs_;
  std::vector<Waiter*> waiters_;
  std::size_t working_ = 0;
  bool leaving_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace stadion
