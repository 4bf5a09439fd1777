#pragma once
/// A discrete-event simulation: processes compute and wait, and computing processes share processors equally.
///
/// A process is a coroutine that does what a thread would do:
///
///     Process cull(Simulation& s) {
///       co_await s.until([&] { return leased; });
///       co_await s.compute(0, 3.5);
///     }
///
/// If more threads are ready than a machine has processors, each gets the same share, as from a fair
/// scheduler with short time slices. The process that has waited longest continues first. The same processes
/// thus always end at the same times.
///
/// Units    milliseconds.
/// Threads  one.
/// Errors   run() throws the exceptions of processes.

#include <coroutine>
#include <cstddef>
#include <deque>
#include <functional>
#include <utility>
#include <vector>

namespace stadion::plan {

/// Owns a coroutine.
class Process {
public:
  struct promise_type {
    Process get_return_object() { return Process(Handle::from_promise(*this)); }
    std::suspend_always initial_suspend() noexcept { return {}; }
    std::suspend_always final_suspend() noexcept { return {}; }
    void return_void() {}
    void unhandled_exception() { throw; }
  };
  using Handle = std::coroutine_handle<promise_type>;

  Process(Process&& other) noexcept : handle_(std::exchange(other.handle_, {})) {}
  Process& operator=(Process&&) = delete;
  ~Process() {
    if (handle_) handle_.destroy();
  }
  Handle handle() const { return handle_; }

private:
  explicit Process(Handle handle) : handle_(handle) {}
  Handle handle_;
};

class Simulation {
public:
  /// Makes machines with these numbers of processors.
  explicit Simulation(std::vector<double> processors);

  /// The process begins with run().
  void start(Process process);
  /// Runs until no process can continue.
  void run();
  double now() const { return now_; }
  /// Returns the processor time used so far.
  double busy(std::size_t machine) const { return machines_[machine].busy; }

  class Wait {
  public:
    Wait(std::function<void(std::coroutine_handle<>)> begin, bool ready)
        : begin_(std::move(begin)), ready_(ready) {}
    bool await_ready() const { return ready_; }
    void await_suspend(std::coroutine_handle<> process) { begin_(process); }
    void await_resume() const {}

  private:
    std::function<void(std::coroutine_handle<>)> begin_;
    bool ready_;
  };

  /// Uses `work` of processor time, on at most `threads` processors at a time.
  Wait compute(std::size_t machine, double work, double threads = 1);
  /// Waits until the condition holds. It may depend on what processes do, but not on the time.
  Wait until(std::function<bool()> condition);
  Wait sleepUntil(double when);

private:
  struct Job {
    double left, threads;
    std::coroutine_handle<> process;
  };
  struct Machine {
    double processors;
    double busy = 0;
    std::vector<Job> jobs{};

    /// Returns the rate relative to a thread that is alone.
    double rate() const;
    double untilNext() const;
    void advance(double ms, std::deque<std::coroutine_handle<>>& done);
  };
  struct Waiting {
    std::function<bool()> condition;
    std::coroutine_handle<> process;
  };
  struct Sleeper {
    double when;
    std::coroutine_handle<> process;
  };

  bool wakeOne();
  bool advance();

  double now_ = 0;
  std::vector<Process> processes_;
  std::vector<Machine> machines_;
  std::deque<std::coroutine_handle<>> ready_;
  std::deque<Waiting> waiting_;
  std::vector<Sleeper> sleepers_;
};

}  // namespace stadion::plan
