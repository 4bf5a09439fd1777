#include "profiling/plan/simulation.h"

#include <algorithm>
#include <limits>

namespace stadion::plan {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
/// Rest of a finished job, from rounding [ms].
constexpr double kNothing = 1e-12;

}  // namespace

Simulation::Simulation(std::vector<double> processors) {
  for (const double p : processors) machines_.push_back({p});
}

void Simulation::start(Process process) {
  ready_.push_back(process.handle());
  processes_.push_back(std::move(process));
}

Simulation::Wait Simulation::compute(std::size_t machine, double work, double threads) {
  return {[this, machine, work, threads](std::coroutine_handle<> process) {
            machines_[machine].jobs.push_back({work, std::max(threads, 1e-3), process});
          },
          work <= 0};
}

Simulation::Wait Simulation::until(std::function<bool()> condition) {
  const bool already = condition();
  return {[this, condition = std::move(condition)](std::coroutine_handle<> process) {
            waiting_.push_back({condition, process});
          },
          already};
}

Simulation::Wait Simulation::sleepUntil(double when) {
  return {[this, when](std::coroutine_handle<> process) {
            sleepers_.push_back({when, process});
          },
          when <= now_};
}

double Simulation::Machine::rate() const {
  double threads = 0;
  for (const Job& j : jobs) threads += j.threads;
  return std::min(1.0, processors / threads);
}

double Simulation::Machine::untilNext() const {
  double next = kNever;
  for (const Job& j : jobs) next = std::min(next, j.left / (j.threads * rate()));
  return next;
}

void Simulation::Machine::advance(double ms, std::deque<std::coroutine_handle<>>& done) {
  const double each = jobs.empty() ? 0 : rate() * ms;
  for (Job& j : jobs) {
    j.left -= each * j.threads;
    busy += each * j.threads;
    if (j.left <= kNothing) done.push_back(j.process);
  }
  std::erase_if(jobs, [](const Job& j) { return j.left <= kNothing; });
}

void Simulation::run() {
  while (!ready_.empty() || wakeOne() || advance()) {
    while (!ready_.empty()) {
      const std::coroutine_handle<> next = ready_.front();
      ready_.pop_front();
      next.resume();
    }
  }
}

/// Wakes one process: it may take a resource for which others wait, too.
bool Simulation::wakeOne() {
  const auto at = std::ranges::find_if(waiting_, [](const Waiting& w) { return w.condition(); });
  if (at == waiting_.end()) return false;
  ready_.push_back(at->process);
  waiting_.erase(at);
  return true;
}

/// Advances to the next event. Returns false if there is none.
bool Simulation::advance() {
  double next = kNever;
  for (const Machine& m : machines_) next = std::min(next, m.untilNext());
  for (const Sleeper& s : sleepers_) next = std::min(next, s.when - now_);
  if (next == kNever) return false;
  next = std::max(next, 0.0);
  for (Machine& m : machines_) m.advance(next, ready_);
  now_ += next;
  for (const Sleeper& s : sleepers_)
    if (s.when - now_ <= kNothing) ready_.push_back(s.process);
  std::erase_if(sleepers_, [&](const Sleeper& s) { return s.when - now_ <= kNothing; });
  return true;
}

}  // namespace stadion::plan
