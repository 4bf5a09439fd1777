#include "profiling/plan/report.h"

#include "engine/plain_text/text_line.h"
#include "profiling/plan/diagram.h"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace stadion::plan {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kMostRasterThreads = 32;  // Mesa takes no more
constexpr std::size_t kFramesInDiagram = 3;

struct TableRow {
  Plan plan;
  Forecast forecast;
};

/// The table shows each number of walls of a small hall, and every eighth of a large one.
bool hasRow(std::size_t walls, std::size_t most) {
  constexpr std::size_t kSmall = 24;
  return walls <= kSmall || walls % 8 == 0 || walls == most;
}

std::vector<TableRow> tableOf(const ShowCosts& costs, const Question& q) {
  std::vector<TableRow> rows;
  for (std::size_t walls = 1; walls <= q.plan.walls; ++walls) {
    if (!hasRow(walls, q.plan.walls)) continue;
    for (const bool pipelined : {false, true}) {
      if (!(pipelined ? q.pipelined : q.sequential)) continue;
      Plan p = q.plan;
      p.walls = walls;
      p.pipelined = pipelined;
      rows.push_back({p, forecastOf(scheduleOf(costs.frames, p), p)});
    }
  }
  return rows;
}

/// Means over the frames.
FrameCost meanOf(const ShowCosts& costs) {
  FrameCost mean;
  mean.walls.resize(costs.walls.size());
  const double part = 1 / static_cast<double>(costs.frames.size());
  for (const FrameCost& f : costs.frames) {
    mean.app += part * f.app;
    mean.appHelpers += part * f.appHelpers;
    mean.swap += part * f.swap;
    for (std::size_t w = 0; w < f.walls.size(); ++w) {
      mean.walls[w].cull += part * f.walls[w].cull;
      mean.walls[w].pictures.resize(1, {0, 0, 0});  // all eyes together; here atOnce is a duration
      for (const PictureCost& p : f.walls[w].pictures) {
        mean.walls[w].pictures[0].calls += part * p.calls;
        mean.walls[w].pictures[0].raster += part * p.raster;
        if (p.atOnce > 0) mean.walls[w].pictures[0].atOnce += part * p.raster / p.atOnce;
      }
    }
  }
  return mean;
}

/// A costs file may come from any source, so its names must not control a terminal.
std::string shown(const std::string& name) {
  constexpr std::size_t kMostCharacters = 100;
  return printable(name, kMostCharacters);
}

std::string costsText(const ShowCosts& costs) {
  const FrameCost mean = meanOf(costs);
  std::string text = fmt::format(
      "{}, {} a picture, {} a wall, {} look: {} frames measured on {:g} cores, {:g} threads of the "
      "{}\n\n"
      "ms of processor time a frame: App {:.3f}{}, swap {:.3f}\n"
      "    cull   draw: calls  rasterising  threads at a time  wall\n",
      shown(costs.show), shown(costs.size), costs.eyes == 2 ? "two" : "one", costs.look, costs.frames.size(),
      costs.cores, costs.rasterThreads, costs.renderer == "cpu" ? "CPU renderer" : "rasteriser", mean.app,
      mean.appHelpers > 0.01 ? fmt::format(" and {:.3f} of its helpers", mean.appHelpers) : "", mean.swap);
  for (std::size_t w = 0; w < costs.walls.size(); ++w) {
    const WallCost& wall = mean.walls[w];
    const PictureCost picture = wall.pictures.empty() ? PictureCost{} : wall.pictures[0];
    text += fmt::format("{:8.3f} {:13.3f} {:12.3f} {:18.2f}  {}\n", wall.cull, picture.calls, picture.raster,
                        picture.atOnce > 0 ? picture.raster / picture.atOnce : 1, shown(costs.walls[w]));
  }
  return text;
}

const char* modeOf(const Plan& p) {
  return p.pipelined ? "pipelined" : "sequential";
}

std::string planText(const Plan& p) {
  std::string text = fmt::format("{}, {} wall{}, {:g} core{}", modeOf(p), p.walls, p.walls == 1 ? "" : "s",
                                 p.machine.cores, p.machine.cores == 1 ? "" : "s");
  if (p.machines > 1) text += fmt::format(" on each of {} machines", p.machines);
  if (p.rasterisers > 1) text += ", walls as processes";
  if (p.pipelined && p.mostInFlight > 0)
    text += fmt::format(", {} frame{} in flight", p.mostInFlight, p.mostInFlight == 1 ? "" : "s");
  if (p.pipelined && !p.drawBeginsEarly) text += ", Draw apart from Cull";
  if (p.pace == Pace::Free)
    return text + (p.newest ? ", live, as fast as it goes" : ", every frame, as fast as it goes");
  return text +
         fmt::format(", {} at {:g} frames a second", p.pace == Pace::Lock ? "locked" : "floating", p.rate);
}

std::string usesText(const Forecast& f) {
  std::vector<Use> uses = f.uses;
  std::ranges::stable_sort(uses, std::greater(), &Use::share);
  std::string text;
  for (std::size_t i = 0; i < std::min<std::size_t>(8, uses.size()); ++i)
    text += fmt::format("{}{} {:.0f} %", i ? ", " : "", uses[i].name, 100 * uses[i].share);
  return text;
}

Json forecastJson(const Forecast& f) {
  Json j{{"period_ms", f.period},
         {"frames_per_second", f.perSecond},
         {"latency_ms", f.latency},
         {"bottleneck", f.bottleneck}};
  j["uses"] = Json::array();
  for (const Use& u : f.uses) j["uses"].push_back({{"of", u.name}, {"share", u.share}});
  return j;
}

Json planJson(const Plan& p) {
  const char* pace = p.pace == Pace::Free ? "free" : p.pace == Pace::Lock ? "lock" : "float";
  return {{"mode", modeOf(p)},
          {"walls", p.walls},
          {"cores", p.machine.cores},
          {"raster_threads_factor", p.machine.rasterThreads},
          {"machines", p.machines},
          {"rasterisers", p.rasterisers},
          {"pace", pace},
          {"rate_hz", p.rate},
          {"newest", p.newest},
          {"latency", p.mostInFlight},
          {"cull_draw", p.drawBeginsEarly ? "overlap" : "apart"}};
}

}  // namespace

Machine machineWith(double cores, const ShowCosts& costs) {
  const double threads = costs.renderer == "cpu" ? cores : std::min(cores, kMostRasterThreads);
  return {cores, threads / costs.rasterThreads};
}

std::string reportText(const ShowCosts& costs, const Question& q) {
  const Schedule schedule = scheduleOf(costs.frames, q.plan);
  const Forecast f = forecastOf(schedule, q.plan);
  std::string text = costsText(costs);
  text += fmt::format("\n{}: {:.2f} ms a frame in the middle, {:.1f} frames a second on average, {:.1f} ms "
                      "from the poses to the picture\n"
                      "bottleneck: {}\nin use: {}\n\n{}",
                      planText(q.plan), f.period, f.perSecond, f.latency, f.bottleneck, usesText(f),
                      diagramText(schedule, kFramesInDiagram));
  text += "\nwalls  mode         ms a frame  frames/s  latency ms  bottleneck\n";
  for (const TableRow& row : tableOf(costs, q))
    text += fmt::format("{:5}  {:<10} {:12.2f} {:9.1f} {:11.1f}  {}\n", row.plan.walls, modeOf(row.plan),
                        row.forecast.period, row.forecast.perSecond, row.forecast.latency,
                        row.forecast.bottleneck);
  text += "\nwhat would change it\n  ms a frame  frames/s  latency ms  with\n";
  for (const Remedy& r : remediesFor(costs.frames, q.plan))
    text += fmt::format("{:12.2f} {:9.1f} {:11.1f}  {}\n", r.then.period, r.then.perSecond, r.then.latency,
                        r.what);
  return text;
}

std::string reportJson(const ShowCosts& costs, const Question& q) {
  Json j{{"plan", planJson(q.plan)},
         {"forecast", forecastJson(forecastOf(scheduleOf(costs.frames, q.plan), q.plan))}};
  j["table"] = Json::array();
  j["remedies"] = Json::array();
  for (const TableRow& row : tableOf(costs, q)) {
    Json entry = forecastJson(row.forecast);
    entry.erase("uses");
    entry["walls"] = row.plan.walls;
    entry["mode"] = modeOf(row.plan);
    j["table"].push_back(std::move(entry));
  }
  for (const Remedy& r : remediesFor(costs.frames, q.plan)) {
    Json entry = forecastJson(r.then);
    entry.erase("uses");
    entry["with"] = r.what;
    j["remedies"].push_back(std::move(entry));
  }
  j["costs"] = Json::parse(toJson(costs));
  return j.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace stadion::plan
