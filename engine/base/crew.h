#pragma once
/// Threads that help App with independent pieces of work.
///
/// Threads    one caller at a time; run() returns when every piece is done. Pieces are taken in order by
/// whoever is
///            free, the caller among them, so nothing may depend on who does what.
///            To be woken takes a thread longer than small pieces take: the others are called when the
///            pieces of the run before took longer than that, all together.
/// Ownership  owns its threads; they sleep between runs.
/// Errors     what a piece throws is thrown by run(), the first one by number.

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace stadion {

class Crew {
public:
  /// `threads` in all, the caller included: 1 has nobody else.
  explicit Crew(std::size_t threads);
  ~Crew();
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;

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
  std::atomic<std::chrono::nanoseconds::rep> work_ = 0;  ///< of all pieces of the run [ns]
  bool worthIt_ = true;                                  ///< to call the others
  std::vector<std::exception_ptr> thrown_;               ///< by piece
  std::vector<std::thread> threads_;
};

}  // namespace stadion
