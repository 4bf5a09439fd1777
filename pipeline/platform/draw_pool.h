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

  void work();
  Job* waiting();
  void take(Job& job, std::unique_lock<std::mutex>& lock);

  const std::size_t most_;
  const Callers callers_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Job*> jobs_;
  std::size_t working_ = 0;
  bool leaving_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace stadion
