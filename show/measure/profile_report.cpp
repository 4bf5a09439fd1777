#include "show/measure/profile_report.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <fmt/format.h>
#include <thread>

namespace stadion {
namespace {

constexpr double kSeconds = 10;  ///< that other models may take, unasked
constexpr std::uint64_t kBodies = 4;
constexpr std::uint64_t kRounds = 2;  ///< one tells nothing of how far off a cost is
constexpr double kModels = 9;         ///< that a body is played with, about

std::string today() {
  const std::time_t now = std::time(nullptr);
  std::tm t{};
  gmtime_r(&now, &t);
  char text[32];
  return {text, std::strftime(text, sizeof text, "%Y-%m-%d %H:%M UTC", &t)};
}

std::string wallsText(const ProfileRunOptions& o, const Player& player) {
  std::string text = o.show.walls + ":";
  for (const WallEntry& w : player.walls().walls) text += " " + w.wall.name;
  if (!o.show.size.empty()) text += ", " + o.show.size + " pixels";
  return text;
}

std::string rasteriserText(const std::string& gl) {
  if (gl.empty()) return "none: App and Cull alone";
  return !drawnBySoftware(gl) ? gl : gl + ", " + rasteriserThreadsText();
}

BodyFigures figuresOf(const BodyFidelity& b) {
  BodyFigures f;
  f.name = b.body.name;
  f.file = b.body.file;
  f.line = b.body.line;
  f.shape = std::string(nameOf(b.body.shape));
  f.share = 1e-3 * b.cost;
  f.caution = cautionAbout(b);
  for (const TriedModel& t : b.tried) {
    if (!t.asIs) continue;
    f.error = t.error;
    f.endError = t.endError;
    f.beyond = t.beyondFrom;
    if (t.cost > t.noise) f.cost = 1e-3 * t.cost;
  }
  const auto advised = advisable(b);
  const auto cheapest = std::ranges::min_element(advised, {}, &TriedModel::cost);
  if (cheapest == advised.end()) return f;
  f.advice = (*cheapest)->name;
  f.adviceError = (*cheapest)->error;
  if ((*cheapest)->cost > (*cheapest)->noise) f.adviceCost = 1e-3 * (*cheapest)->cost;
  return f;
}

DynamicsFigures figuresOf(const Fidelity& fidelity) {
  DynamicsFigures d;
  d.tolerance = fidelity.tolerance;
  for (const BodyFidelity& b : fidelity.bodies) d.bodies.push_back(figuresOf(b));
  return d;
}

/// Nothing if nothing could be measured; that it could be played is known.
std::optional<Fidelity> measure(const FidelityOptions& options) {
  Diagnostics unheard;
  return measureFidelity(options, unheard, [](const std::string&) {});
}

}  // namespace

ReportHead reportHead(const ProfileRunOptions& o, const Player& player, const std::string& gl) {
  ReportHead head;
  head.show = o.show.script;
  head.rate = player.rate();
  const auto add = [&](const char* what, std::string how) { head.facts.emplace_back(what, std::move(how)); };
  add("walls", wallsText(o, player));
  add("eyes", o.layout == StereoLayout::Off ? "one" : "two");
  add("mode", nameOf(o.show.mode));
  add("drawn by", rasteriserText(gl));
  add("App threads",
      o.show.appThreads > 0 ? std::to_string(o.show.appThreads) : "as many as processors, 8 at most");
  add("processors", std::to_string(std::thread::hardware_concurrency()));
  add("input", player.inputFound() ? player.inputName() : "none");
  add("played", "every frame, as fast as it goes");
  add("recorded on", today());
  return head;
}

std::optional<DynamicsFigures> dynamicsFigures(const ProfileRunOptions& o, const ShowFigures& figures,
                                               OutputFiles& files) {
  const auto moved = std::ranges::count_if(
      figures.nodes, [](const NodeRow& r) { return r.name.type == "dynamics" && r.simulate > 0; });
  if (moved == 0 && !o.fidelityAsked) return {};
  FidelityOptions options = o.fidelity;
  options.show = o.show;
  options.show.walls = "desktop";
  if (o.fidelityAsked) {
    const auto all = measure(options);
    if (all) files.write("fidelity.json", fidelityJson(*all) + "\n");
    return all ? std::optional(figuresOf(*all)) : std::nullopt;
  }
  if (figures.app.measured * 1e-3 * static_cast<double>(figures.frames) > kSeconds) return {};
  const auto start = std::chrono::steady_clock::now();
  options.most = 0;
  options.rounds = 1;
  const auto listed = measure(options);
  if (!listed || listed->bodies.empty()) return {};
  const double once = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const auto bodies = std::min<std::uint64_t>(kBodies, listed->bodies.size());
  const double needed = once * kModels * kRounds * static_cast<double>(bodies);
  if (needed <= kSeconds) {
    options.most = kBodies;
    options.rounds = kRounds;
    if (const auto some = measure(options)) {
      DynamicsFigures d = figuresOf(*some);
      d.note = "The most expensive few were played twice with each model; --fidelity plays more.";
      return d;
    }
  }
  DynamicsFigures d = figuresOf(*listed);
  d.note =
      fmt::format("Errors were not measured: that would have taken some {:.0f} s. --fidelity does.", needed);
  return d;
}

}  // namespace stadion
