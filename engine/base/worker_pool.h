#pragma once
/// A worker pool: threads that help App with independent pieces of work.
///
/// Threads    One caller at a time; run() returns when every piece is done. Idle threads, including the
///            caller, take pieces in order, so results must not depend on the thread of a piece. Waking a
///            thread takes longer than a small piece: the others are woken only if all pieces of the previous
///            run together took longer than that.
/// Ownership  owns its threads; they sleep between runs. At a piece they run the caller's stage.
/// Errors     run() throws the exceptions of pieces, the first one by number.

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace stadion {

class WorkerPool {
public:
  /// `threads` includes the caller: with 1 there are no others.
  explicit WorkerPool(std::size_t threads);
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  /// Calls piece(0) ... piece(count - 1).
  void run(std::size_t count, const std::function<void(std::size_t)>& piece);

private:
  void help();
  void takePieces();
  void callHelp(std::size_t count);

  std::mutex mutex_;
  std::condition_variable begin_, end_;
  const std::function<void(std::size_t)>* piece_ = nullptr;
  std::size_t count_ = 0, helping_ = 0;
  std::uint64_t round_ = 0;
  bool leaving_ = false;
  std::atomic<std::size_t> next_ = 0;
  std::atomic<std::chrono::nanoseconds::rep> work_ = 0;  ///< time of all pieces of the run [ns]
  bool worthIt_ = true;                                  ///< waking the others pays
  std::vector<std::exception_ptr> thrown_;               ///< by piece
  std::vector<std::thread> threads_;
};

}  // namespace stadion
