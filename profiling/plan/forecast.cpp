#include "profiling/plan/forecast.h"

#include "engine/maths/median.h"

#include <algorithm>
#include <fmt/format.h>

namespace stadion::plan {
namespace {

constexpr std::size_t kFilling = 4, kEmptying = 3;
/// A processor, or a rasteriser, with this load has no room for more work.
constexpr double kFull = 0.93;

/// The frames that count: [first, last) of those shown.
struct Window {
  std::size_t first = 0, last = 0;
  double begin = 0, end = 0;
};

Window windowOf(const Schedule& s) {
  Window w;
  w.last = s.shown.size();
  if (w.last > kFilling + kEmptying + 1) {
    w.first = kFilling;
    w.last -= kEmptying;
  }
  if (w.first >= w.last) return w;
  w.begin = s.shown[w.first].shown;
  w.end = s.shown[w.last - 1].shown;
  return w;
}

/// Returns the time of a row's bars in the window that `counts` accepts.
template <class Counts>
double timeIn(const Schedule& s, const Window& w, const Counts& counts) {
  double sum = 0;
  for (const Bar& b : s.bars)
    if (counts(b)) sum += std::max(0.0, std::min(b.end, w.end) - std::max(b.begin, w.begin));
  return sum;
}

std::vector<Use> usesOf(const Schedule& s, const Window& w, const Plan& plan) {
  std::vector<Use> uses;
  const double length = w.end - w.begin;
  if (length <= 0) return uses;
  double processors = 0;
  for (const double busy : s.busy) processors += busy / static_cast<double>(s.busy.size());
  uses.push_back({"processors", processors / (plan.machine.cores * s.end)});
  for (std::size_t row = 0; row < s.rows.size(); ++row) {
    const auto own = [&](const Bar& b) {
      return b.row == row && (!isWait(b.what) || b.what == Activity::ForPixels);
    };
    uses.push_back({s.rows[row], timeIn(s, w, own) / length});
  }
  const auto inTurn = [&](const Bar& b) {
    return b.what == Activity::Calls || (plan.waitsInTurn && b.what == Activity::ForPixels);
  };
  const bool takesTurns = plan.takesTurns && plan.walls > 1 && plan.rasterisers == 1;
  if (takesTurns && plan.pipelined && plan.machines == 1)
    uses.push_back({"turns of the walls", timeIn(s, w, inTurn) / length});
  return uses;
}

/// A shared resource delays all threads, so it is named before the threads that wait for it.
std::string bottleneckOf(const std::vector<Use>& uses) {
  const auto full = [&](std::string_view name) {
    return std::ranges::any_of(uses,
                               [&](const Use& u) { return u.name.starts_with(name) && u.share >= kFull; });
  };
  for (const char* shared : {"processors", "turns", "rasteriser"})
    if (full(shared)) return shared == std::string("turns") ? "turns of the walls" : shared;
  const auto most = std::ranges::max_element(uses, {}, &Use::share);
  return most == uses.end() ? "" : most->name;
}

}  // namespace

Forecast forecastOf(const Schedule& schedule, const Plan& plan) {
  Forecast f;
  const Window w = windowOf(schedule);
  std::vector<double> periods, latencies;
  for (std::size_t i = w.first; i < w.last; ++i) {
    if (i > w.first) periods.push_back(schedule.shown[i].shown - schedule.shown[i - 1].shown);
    latencies.push_back(schedule.shown[i].shown - schedule.shown[i].began);
  }
  if (w.end > w.begin) f.perSecond = 1000 * static_cast<double>(w.last - w.first - 1) / (w.end - w.begin);
  f.period = median(std::move(periods));
  f.latency = median(std::move(latencies));
  f.uses = usesOf(schedule, w, plan);
  f.bottleneck = bottleneckOf(f.uses);
  return f;
}

std::vector<Remedy> remediesFor(const std::vector<FrameCost>& costs, const Plan& plan) {
  std::vector<Remedy> remedies;
  const auto attempt = [&](std::string what, Plan other) {
    remedies.push_back({std::move(what), forecastOf(scheduleOf(costs, other), other)});
  };
  // The rasteriser has a thread for each core, and keeps the same part of them busy.
  const auto withCores = [&](double factor) {
    Plan p = plan;
    p.machine.cores *= factor;
    p.machine.rasterThreads *= factor;
    return p;
  };
  for (const double factor : {2.0, 4.0})
    attempt(fmt::format("{:.0f} cores", plan.machine.cores * factor), withCores(factor));
  Plan p = plan;
  p.pipelined = !plan.pipelined;
  attempt(p.pipelined ? "pipelined" : "sequential", p);
  if (plan.walls > 1 && plan.machines == 1) {
    p = plan;
    p.machines = 2;
    attempt("two machines, half of the walls each", p);
  }
  if (plan.walls > 1 && plan.rasterisers == 1) {
    p = plan;
    p.rasterisers = plan.walls;
    attempt("a rasteriser for each wall (walls as processes)", p);
    p = withCores(2);
    p.rasterisers = plan.walls;
    attempt(fmt::format("{:.0f} cores and a rasteriser for each wall", p.machine.cores), p);
  }
  std::ranges::stable_sort(remedies, std::greater(), [](const Remedy& r) { return r.then.perSecond; });
  return remedies;
}

}  // namespace stadion::plan
