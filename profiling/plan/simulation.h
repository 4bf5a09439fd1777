#pragma once
/// Discrete events: processes that compute and wait, on processors that those who compute share alike.
///
/// A process is a coroutine that says what a thread would do:
///
///     Process cull(Simulation& s) {
///       co_await s.until([&] { return leased; });
///       co_await s.compute(0, 3.5);
///     }
///
/// Where more threads are ready than a machine has processors, each gets the same part of them, as from a
/// fair scheduler whose slices are short. Whoever has waited longest goes on first. So the same processes
/// always end in the same times.
///
/// Units    milliseconds. Threads  one.
/// Errors   what a process throws comes out of run().

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
  /// Machines, each with so many processors.
  explicit Simulation(std::vector<double> processors);

  /// It begins with run().
  void start(Process process);
  /// Until no process can go on.
  void run();
  double now() const { return now_; }
  /// Processor time used so far.
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

  /// Takes `work` of processor time, on as many as `threads` processors at a time.
  Wait compute(std::size_t machine, double work, double threads = 1);
  /// Waits until it is so. The condition may depend on what processes do, not on the time.
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

    /// Of what one thread would get if it were alone.
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
