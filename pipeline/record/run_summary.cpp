#include "pipeline/record/run_summary.h"

#include "engine/maths/angles.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace stadion {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kDegrees = 180 / kPi;

void keepFinite(std::vector<double>& values) {
  std::erase_if(values, [](double v) { return !std::isfinite(v); });
}

/// Expects sorted values.
double nearestRank(const std::vector<double>& sorted, double percent) {
  if (sorted.empty()) return 0;
  const double n = static_cast<double>(sorted.size());
  // 1e-9 of a rank allows for the rounding of percent / 100, so that 95 % of 20 is 19 and not 20.
  const double rank = std::clamp(std::ceil(percent / 100 * n - 1e-9), 1.0, n);
  return sorted[static_cast<std::size_t>(rank) - 1];
}

std::string hex(std::uint64_t hash) {
  return fmt::format("{:016x}", hash);
}

Json json(const SampleStatistics& d) {
  return {{"count", d.count}, {"min", d.min}, {"mean", d.mean}, {"p50", d.p50},
          {"p95", d.p95},     {"p99", d.p99}, {"max", d.max}};
}

/// An event that a node repeats.
struct Again {
  std::size_t times = 0;
  double last = 0;  ///< [s]
  bool told = false;
};

std::string row(const std::string& stage, const std::string& wall, const SampleStatistics& d) {
  return fmt::format("  {:<16} {:<12} {:>9.3f} {:>9.3f} {:>9.3f} {:>9.3f}\n", stage, wall, d.p50, d.p95,
                     d.p99, d.max);
}

}  // namespace

double percentile(std::vector<double> values, double percent) {
  keepFinite(values);
  std::ranges::sort(values);
  return nearestRank(values, percent);
}

SampleStatistics sampleStatisticsOf(std::vector<double> values) {
  keepFinite(values);
  if (values.empty()) return {};
  std::ranges::sort(values);
  double sum = 0;
  for (const double v : values) sum += v;
  return {values.size(),
          values.front(),
          sum / static_cast<double>(values.size()),
          nearestRank(values, 50),
          nearestRank(values, 95),
          nearestRank(values, 99),
          values.back()};
}

namespace {

std::string textOf(const BudgetSummary& b) {
  std::string text = fmt::format("  {} {}:{}: ", b.node, b.file, b.line);
  if (b.budget > 0) text += fmt::format("budget {:g} ms, ", b.budget);
  if (b.drawMeasured)
    text += fmt::format("mean {:.3f}{}, {}worst {:.3f} in frame {}{}", b.mean, b.budget > 0 ? "" : " ms",
                        b.budget > 0 ? fmt::format("over in {} frames, ", b.overruns) : "", b.worst,
                        b.worstFrame, b.worstStage.empty() ? "" : " (" + b.worstStage + ")");
  else
    text += "not measured: drawing it had no turn while it was seen";
  if (!b.drawCounted) text += ", without Draw, which --wall-workers thread counts";
  if (b.changes > 0)
    text += fmt::format("; gave up {} of {} levels at most, {} now, {} changes", b.highest, b.levels, b.now,
                        b.changes);
  return text + "\n";
}

Json json(const BudgetSummary& b) {
  return Json{{"node", b.node},
              {"file", b.file},
              {"line", b.line},
              {"budget_ms", b.budget},
              {"mean_ms", b.drawMeasured ? Json(b.mean) : Json()},
              {"worst_ms", b.drawMeasured ? Json(b.worst) : Json()},
              {"worst_frame", b.worstFrame},
              {"worst_stage", b.worstStage},
              {"overruns", b.overruns},
              {"changes", b.changes},
              {"highest_level", b.highest},
              {"level", b.now},
              {"levels", b.levels},
              {"draw_counted", b.drawCounted},
              {"draw_measured", b.drawMeasured}};
}

}  // namespace

namespace {

std::string clusterText(const ClusterSummary& c) {
  std::string text =
      fmt::format("  cluster: {}, {} of {} hosts", c.node, c.leads ? "the leader" : "one", c.nodes);
  if (c.leads)
    text +=
        fmt::format("; {:.0f} bytes a frame, {} at most; {} have come, {} were left out; {} scenes compared, "
                    "{} differed",
                    c.orderBytes, c.mostOrderBytes, c.joined, c.leftOut, c.compared, c.differed);
  if (c.barrier.count > 0)
    text += fmt::format(
        "; the last of all to have drawn in {} frames, which it might show after {:.3f} ms (p50), "
        "{:.3f} (p99)",
        c.barrier.count, c.barrier.p50, c.barrier.p99);
  return text + "\n";
}

/// Describes the measures that keep the head's pose young.
std::string headText(const RunSummary& s) {
  std::string text;
  if (s.lateLatch)
    text += fmt::format(
        "  late latch: {} frames from a newer head, up to {:.1f} mm and {:.2f} degrees away; {} beyond "
        "the reach\n",
        s.lateLatch->frames, 1e3 * s.lateLatch->farthest, s.lateLatch->widest * kDegrees,
        s.lateLatch->beyond);
  if (s.aimedAt) text += fmt::format("  the head was told {:.1f} ms ahead, at the end\n", *s.aimedAt);
  return text;
}

}  // namespace

std::string toText(const RunSummary& s) {
  // The speed of frames that no wall draws means nothing.
  const bool all = s.framesDrawn == s.frames;
  const double rate = s.elapsedSeconds > 0 ? static_cast<double>(s.frames) / s.elapsedSeconds : 0.0;
  std::string text = fmt::format("{}: {}, {:.3f} s of show in {:.3f} s{}, {} late\n", s.show,
                                 all ? fmt::format("{} frames", s.frames)
                                     : fmt::format("drawn {} of {} frames", s.framesDrawn, s.frames),
                                 s.seconds, s.elapsedSeconds,
                                 all ? fmt::format(" ({:.1f} frames/s)", rate) : "", s.lateFrames);
  if (s.groups > 1) text += fmt::format("  the last of {} groups in {:.0f} s\n", s.groups, s.uptimeSeconds);
  text += fmt::format("  walls {}, stereo {}, {} x {} pixels, {}, {} Hz\n", s.walls, s.stereo, s.width,
                      s.height, s.mode, s.rate);
  if (!s.drawing.drawnBy.empty()) text += fmt::format("  drawn by {}: {}\n", s.drawing.text, s.drawing.why);
  if (!s.drawing.chosen.empty())
    text += fmt::format("  renderer {}: {}\n", s.drawing.renderer, s.drawing.chosen);
  if (s.warmUpMs > 0)
    text += fmt::format("  warm-up {:.3f} s before the first frame: {}\n", s.warmUpMs / 1000,
                        s.drawing.renderer == "cpu" ? "meshes, textures" : "shaders, uploads");
  if (s.frameMs.count + s.stages.size() + s.latency.size() > 0)
    text += fmt::format("  {:<16} {:<12} {:>9} {:>9} {:>9} {:>9}\n", "milliseconds", "wall", "p50", "p95",
                        "p99", "max");
  if (s.frameMs.count > 0) text += row("frame", "", s.frameMs);
  for (const StageTimes& t : s.stages)
    if (t.ms.count > 0) text += row(t.stage, t.wall, t.ms);
  for (const WallLatency& l : s.latency)
    if (l.ms.count > 0) text += row("motion to image", l.wall, l.ms);
  text += headText(s);
  for (const WallLate& w : s.lateWalls)
    text += fmt::format("  wall {} was not drawn in time for {} frames, {} in a row at most\n", w.wall,
                        w.frames, w.inARow);
  if (s.stateHash) text += fmt::format("  state hash of frame {}: {}\n", s.lastFrame, hex(*s.stateHash));
  for (const ImageHash& h : s.imageHashes)
    text += fmt::format("  image hash of frame {}: {} {} {}\n", s.lastFrame, hex(h.hash), h.wall, h.eye);
  for (const auto& [name, value] : s.counters) text += fmt::format("  {}: {}\n", name, value);
  for (const MeasuredDistance& m : s.measured)
    text += fmt::format("  measured {:.3f} m: {} at {:.3f} s\n", m.metres, m.node, m.seconds);
  for (const BudgetSummary& b : s.budgets) text += textOf(b);
  for (const ReplayedDegradation& o : s.replayedDegradations)
    text += fmt::format("  obeyed the log: {} gave up {} levels at most, {} at the end, {} changes\n", o.node,
                        o.highest, o.now, o.changes);
  if (s.cluster) text += clusterText(*s.cluster);
  if (s.stress && s.stress->changes > 0)
    text += fmt::format(
        "  stress: everything counted as up to {:.3g} times farther away, {:.3g} at the end, {} changes\n",
        s.stress->highest, s.stress->atEnd, s.stress->changes);
  for (const std::string& file : s.files) text += fmt::format("  wrote {}\n", file);
  for (const std::string& remark : s.remarks) text += fmt::format("  note: {}\n", remark);
  if (!s.stopped.empty()) text += fmt::format("  stopped by {} after frame {}\n", s.stopped, s.lastFrame);
  return text;
}

std::string eventsText(const RunSummary& s) {
  if (s.events.empty()) return {};
  std::map<std::pair<std::string, std::string>, Again> again;
  for (const ShowEvent& h : s.events)
    if (!h.metres) {
      ++again[{h.event, h.node}].times;
      again[{h.event, h.node}].last = h.seconds;
    }
  std::string text = "\nwhat happened\n";
  std::size_t lines = 0, told = 0;
  for (const ShowEvent& h : s.events) {
    Again* alike = h.metres ? nullptr : &again[{h.event, h.node}];
    if (alike && alike->times <= RunSummary::kMostAlike) alike = nullptr;
    if (alike && alike->told) continue;
    if (++lines > RunSummary::kEventsInText) break;
    told += alike ? alike->times : 1;
    text += fmt::format("{:9.4f} s  {:<10} {}{}{}\n", h.seconds, h.event, h.node,
                        h.metres ? fmt::format("  {:.3f} m", *h.metres) : "",
                        alike ? fmt::format("  {} times, until {:.4f} s", alike->times, alike->last) : "");
    if (alike) alike->told = true;
  }
  if (s.eventCount > told)
    text += fmt::format(
        "  ... and {} more; summary.json (--out DIR, or --json) has {} of them\n", s.eventCount - told,
        s.events.size() == s.eventCount ? "all" : fmt::format("the first {}", s.events.size()));
  return text;
}

namespace {

// The sections of summary.json, in the order of the file.

void addShow(Json& j, const RunSummary& s) {
  j["show"] = s.show;
  j["walls"] = s.walls;
  j["mode"] = s.mode;
  j["stereo"] = s.stereo;
  j["width"] = s.width;
  j["height"] = s.height;
  j["rate_hz"] = s.rate;
  j["frames"] = s.frames;
  j["frames_drawn"] = s.framesDrawn;
  j["seconds"] = s.seconds;
  j["elapsed_seconds"] = s.elapsedSeconds;
  j["groups"] = s.groups;
  j["uptime_seconds"] = s.uptimeSeconds;
  if (!s.drawing.drawnBy.empty())
    j["how_drawn"] =
        Json{{"renderer", s.drawing.renderer},
             {"renderer_why", s.drawing.chosen},
             {"wall_workers", s.drawing.drawnBy},
             {s.drawing.renderer == "cpu" ? "draw_threads" : "rasteriser_threads", s.drawing.threads},
             {"pinned", s.drawing.pinned},
             {"why", s.drawing.why}};
}

void addTimes(Json& j, const RunSummary& s) {
  j["warm_up_ms"] = s.warmUpMs;
  j["late_frames"] = s.lateFrames;
  j["frame_ms"] = json(s.frameMs);
  j["stages"] = Json::array();
  for (const StageTimes& t : s.stages) {
    Json stage{{"stage", t.stage}, {"wall", t.wall.empty() ? Json() : Json(t.wall)}, {"ms", json(t.ms)}};
    if (!t.method.empty()) stage["method"] = t.method;
    j["stages"].push_back(std::move(stage));
  }
  j["motion_to_image_ms"] = Json::object();
  for (const WallLatency& l : s.latency) j["motion_to_image_ms"][l.wall] = json(l.ms);
}

/// Frames that were shown late, and the measures that keep the head's pose young.
void addLateness(Json& j, const RunSummary& s) {
  j["most_passed_over"] = s.mostTicksWithoutFrame;
  j["late_walls"] = Json::object();
  for (const WallLate& w : s.lateWalls)
    j["late_walls"][w.wall] = Json{{"frames", w.frames}, {"in_a_row", w.inARow}};
  if (s.lateLatch)
    j["late_latch"] = Json{{"frames", s.lateLatch->frames},
                           {"beyond_reach", s.lateLatch->beyond},
                           {"farthest_m", s.lateLatch->farthest},
                           {"widest_rad", s.lateLatch->widest}};
  if (s.aimedAt) j["predicted_ms"] = *s.aimedAt;
}

void addHashes(Json& j, const RunSummary& s) {
  j["last_frame"] = s.lastFrame;
  j["state_hash"] = s.stateHash ? Json(hex(*s.stateHash)) : Json();
  j["history_hash"] = s.historyHash ? Json(hex(*s.historyHash)) : Json();
}

Json json(const ClusterSummary& c) {
  return Json{{"node", c.node},
              {"nodes", c.nodes},
              {"leads", c.leads},
              {"orders", c.orders},
              {"order_bytes", c.orderBytes},
              {"most_order_bytes", c.mostOrderBytes},
              {"barriers", c.barrier.count},
              {"barrier_p50_ms", c.barrier.p50},
              {"barrier_p99_ms", c.barrier.p99},
              {"joined", c.joined},
              {"left_out", c.leftOut},
              {"compared", c.compared},
              {"differed", c.differed},
              {"stopped_for_difference", c.stopped}};
}

void addDegradation(Json& j, const RunSummary& s) {
  if (s.stress)
    j["stress"] =
        Json{{"highest", s.stress->highest}, {"at_end", s.stress->atEnd}, {"changes", s.stress->changes}};
  for (const BudgetSummary& b : s.budgets) j["budgets"].push_back(json(b));
  for (const ReplayedDegradation& o : s.replayedDegradations)
    j["obeyed"].push_back(
        Json{{"node", o.node}, {"changes", o.changes}, {"highest_level", o.highest}, {"level", o.now}});
}

void addPictures(Json& j, const RunSummary& s) {
  j["drawn"] = Json::array();
  for (const DrawnCounts& d : s.drawn)
    j["drawn"].push_back(Json{{"wall", d.wall},
                              {"eye", d.eye},
                              {"frames", d.frames},
                              {"calls", d.calls},
                              {"instances", d.instances},
                              {"triangles", d.triangles}});
  j["image_hashes"] = Json::array();
  for (const ImageHash& h : s.imageHashes)
    j["image_hashes"].push_back(Json{{"wall", h.wall}, {"eye", h.eye}, {"hash", hex(h.hash)}});
}

void addNotes(Json& j, const RunSummary& s) {
  j["counters"] = Json::object();
  for (const auto& [name, value] : s.counters) j["counters"][name] = value;
  j["files"] = s.files;
  j["remarks"] = s.remarks;
  j["stopped"] = s.stopped.empty() ? Json() : Json(s.stopped);
  j["failure"] = s.failure.empty() ? Json() : Json(s.failure);
}

void addHappenings(Json& j, const RunSummary& s) {
  j["happened_count"] = s.eventCount;
  j["happened"] = Json::array();
  for (const ShowEvent& h : s.events) {
    Json event{{"seconds", h.seconds}, {"event", h.event}, {"node", h.node}};
    if (h.metres) event["metres"] = *h.metres;
    j["happened"].push_back(std::move(event));
  }
  j["measured"] = Json::array();
  for (const MeasuredDistance& m : s.measured)
    j["measured"].push_back(Json{{"seconds", m.seconds}, {"node", m.node}, {"metres", m.metres}});
}

}  // namespace

std::string toJson(const RunSummary& s) {
  Json j;
  addShow(j, s);
  addTimes(j, s);
  addLateness(j, s);
  addHashes(j, s);
  if (s.cluster) j["cluster"] = json(*s.cluster);
  addDegradation(j, s);
  addPictures(j, s);
  addNotes(j, s);
  addHappenings(j, s);
  // File names may be any bytes; JSON may not.
  return j.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace stadion
