#include "engine/plain_text/csv_field.h"
#include "profiling/report/show_figures.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace stadion {
namespace {

std::string placeOf(const NodeName& name) {
  if (name.file.empty()) return "";
  const std::size_t slash = name.file.rfind('/');
  const std::string file = slash == std::string::npos ? name.file : name.file.substr(slash + 1);
  return fmt::format("{}:{}{}", file, name.line, name.unloaded ? " (unloaded)" : "");
}

/// Null: not measured.
nlohmann::json measured(double ms, bool known) {
  return known || ms > 0 ? nlohmann::json(ms) : nlohmann::json();
}

/// "-": not measured, or never; a measured part is shown.
std::string cell(double ms, bool known, int width, int digits) {
  if (!known && ms <= 0) return fmt::format("{:>{}}", "-", width);
  return fmt::format("{:>{}}", fmt::format("{}{:.{}f}", known ? "" : ">", ms, digits), width);
}

/// As cell(); "~": less than can be measured.
std::string drawCell(const NodeRow& r) {
  const bool tooLittle = r.drawMeasured && !r.drawKnown();
  return tooLittle ? fmt::format("{:>8}", "~") : cell(r.draw, r.drawMeasured, 8, 3);
}

std::string tooLittleText(const ShowFigures& f) {
  const auto count =
      std::ranges::count_if(f.nodes, [](const NodeRow& r) { return r.drawMeasured && !r.drawKnown(); });
  return count == 0 ? "" : fmt::format("~ {} nodes: too little to be told from drawing nothing\n", count);
}

/// If the pieces do not add up to the whole, their costs are less certain than they look.
std::string apartText(const StageBreakdown& alone) {
  constexpr double kMuch = 0.15;
  if (std::abs(alone.covered() - 1) <= kMuch) return {};
  return fmt::format(
      "draw: what was drawn alone came to {:.0f} % of the eyes drawn whole: a node's draw time may be as "
      "far off\n",
      100 * alone.covered());
}

bool isUnmeasured(const NodeRow& r) {
  return !r.cullMeasured || !r.drawMeasured;
}

std::string unmeasuredText(const ShowFigures& f) {
  const auto count = std::ranges::count_if(f.nodes, isUnmeasured);
  if (count == 0) return "";
  if (f.framesNeeded == 0) return "- not measured: nothing was drawn\n";
  return fmt::format(
      "- not measured, > on some walls only: {} of {} nodes had no turn in {} frames; some {} would do "
      "(--frames {})\n",
      count, f.nodes.size(), f.frames, f.framesNeeded, f.framesNeeded);
}

/// Adds a node's rows: its App and the parts of it, its Cull by wall, its Draw by wall and eye.
void addRows(const NodeRow& r, const ShowFigures& f, std::string& csv) {
  const std::string node =
      fmt::format("{},{},{},{}", csvField(r.name.path), csvField(r.name.file), r.name.line, r.name.type);
  const std::string budget = r.name.budget > 0 ? fmt::to_string(r.name.budget) : "";
  const std::string method = csvField(f.drawMethod);
  const auto ifKnown = [](double ms, bool is) { return is ? fmt::to_string(ms) : ""; };
  csv += fmt::format("{},app,,,,{},{},{},{},{},{},{},\n", node, r.app, ifKnown(r.visitP95, r.visits > 0),
                     ifKnown(r.visitMost, r.visits > 0),
                     std::llround(r.visits * static_cast<double>(f.wholeFrames)), r.allocations, r.share,
                     budget);
  for (const auto& [part, ms] : {std::pair{"receive", r.receive},
                                 {"simulate", r.simulate},
                                 {"dispatch", r.dispatch},
                                 {"settle", r.settle},
                                 {"publish", r.publish}})
    csv += fmt::format("{},app,{},,,{},,,,,,,\n", node, part, ms);
  const auto add = [&](const char* stage, const std::string& wall, const char* eye, double ms, bool known) {
    csv += fmt::format("{},{},,{},{},{},,,,,,,{}\n", node, stage, csvField(wall), eye,
                       known ? fmt::to_string(ms) : "", *eye != 0 ? method : "");
  };
  if (!f.drawMethod.empty())
    csv += fmt::format("{},draw,,,,{},{},{},{},,,,{}\n", node, ifKnown(r.draw, r.drawKnown()),
                       ifKnown(r.drawingP95, r.drawings > 0), ifKnown(r.drawingMost, r.drawings > 0),
                       r.drawings, method);
  for (std::size_t w = 0; w < r.walls.size(); ++w) {
    const NodeOnWall& on = r.walls[w];
    add("cull", f.walls[w], "", on.cull, on.cullMeasured);
    for (std::size_t eye = 0; eye < f.eyes[w]; ++eye)
      add("draw", f.walls[w], eye == 0 ? "left" : "right", on.draw[eye], on.drawMeasured[eye]);
  }
}

nlohmann::json toJson(const NodeRow& row, const std::vector<std::string>& walls) {
  nlohmann::json j{{"path", row.name.path},
                   {"file", row.name.file},
                   {"line", row.name.line},
                   {"kind", row.name.type},
                   {"unloaded", row.name.unloaded},
                   {"budget_ms", row.name.budget},
                   {"receive_ms", row.receive},
                   {"simulate_ms", row.simulate},
                   {"dispatch_ms", row.dispatch},
                   {"settle_ms", row.settle},
                   {"publish_ms", row.publish},
                   {"app_ms", row.app},
                   {"cull_ms", measured(row.cull, row.cullMeasured)},
                   {"draw_ms", measured(row.draw, row.drawKnown())},
                   {"draw_too_little", row.drawTooLittle},
                   {"draw_complete", row.drawMeasured},
                   {"total_ms", row.total},
                   {"share", row.share},
                   {"allocations", row.allocations},
                   {"allocated_bytes", row.bytes},
                   {"visits", row.visits},
                   {"visit_p95_ms", measured(row.visitP95, row.visits > 0)},
                   {"visit_max_ms", measured(row.visitMost, row.visits > 0)},
                   {"drawings", row.drawings},
                   {"drawing_p95_ms", measured(row.drawingP95, row.drawings > 0)},
                   {"drawing_max_ms", measured(row.drawingMost, row.drawings > 0)}};
  for (std::size_t w = 0; w < row.walls.size(); ++w)
    j["walls"].push_back({{"wall", walls[w]},
                          {"cull_ms", measured(row.walls[w].cull, row.walls[w].cullMeasured)},
                          {"draw_left_ms", measured(row.walls[w].draw[0], row.walls[w].drawMeasured[0])},
                          {"draw_right_ms", measured(row.walls[w].draw[1], row.walls[w].drawMeasured[1])}});
  return j;
}

std::string countersText(const ShowFigures& f) {
  std::string text;
  for (const auto& [name, value] : f.counters) text += fmt::format("{}: {:g}\n", name, value);
  return text;
}

}  // namespace

std::string toText(const ShowFigures& f, std::size_t mostNodes) {
  if (f.frames == 0)
    return fmt::format("no frame was recorded: the first {} are not; play some hundreds\n",
                       FrameLogOptions{}.from);
  const bool budgets = std::ranges::any_of(f.nodes, [](const NodeRow& r) { return r.name.budget > 0; });
  std::string text = fmt::format("ms a frame, all walls and eyes; p95: of a visit of App (without "
                                 "publishing), of drawing it for one eye\n"
                                 "    app     p95    cull     draw      p95    total  share{}  node\n",
                                 budgets ? "   budget" : "");
  for (std::size_t i = 0; i < std::min(mostNodes, f.nodes.size()); ++i) {
    const NodeRow& r = f.nodes[i];
    const std::string budget =
        r.name.budget > 0 ? fmt::format("{:9.4g}", r.name.budget) : std::string(budgets ? 9 : 0, ' ');
    text += fmt::format("{:7.4f} {} {} {} {} {:8.3f} {:5.1f}%{}  {}  {}\n", r.app,
                        cell(r.visitP95, r.visits > 0, 7, 4), cell(r.cull, r.cullMeasured, 7, 4), drawCell(r),
                        cell(r.drawingP95, r.drawings > 0, 8, 3), r.total, 100 * r.share, budget, r.name.path,
                        placeOf(r.name));
  }
  text += unmeasuredText(f) + tooLittleText(f);
  if (f.wholeFrames < f.frames)
    text += fmt::format(
        "App by node is of {} of the {} frames: in the others it had no processor for a while, or it visits "
        "too many nodes to record them each time\n",
        f.wholeFrames, f.frames);
  if (f.warmUpMs > 0)
    text += fmt::format("warm-up {:.3f} s before the first frame: shaders, uploads\n", f.warmUpMs / 1000);
  text += countersText(f);
  text += "\n       ms      p95      max  allocs  stage\n";
  for (const StageRow& s : f.stages)
    text += fmt::format("{:9.4f} {:8.3f} {:8.3f} {:7.1f}  {}{}{}\n", s.ms, s.p95, s.most, s.allocations,
                        s.name(), s.part.empty() ? "" : ": ", s.part);
  text += "\n      mean        max  counted a frame\n";
  for (const CountRow& c : f.counts)
    text += fmt::format("{:10.1f} {:10.0f}  {}: {}\n", c.mean, c.most, c.of, c.what);
  text += "\nexplained   measured     nodes  the stage's own parts\n";
  for (const StageBreakdown* e : f.breakdowns())
    if (!f.drawMethod.empty() || (e != &f.draw && e != &f.alone))
      text +=
          fmt::format("{:5} {} {:9.4f} {:9.4f} {:9.4f}{}\n", e->stage,
                      e->measured > 0 ? fmt::format("{:5.1f}%", 100 * e->covered()) : "     -", e->measured,
                      e->nodes, e->named, e == &f.alone ? "  each eye drawn alone, before scaling" : "");
  if (f.alone.measured <= 0) return text;
  return text + "draw: " + f.drawMethod + "\n" + (f.framesNeeded == 0 ? apartText(f.alone) : "");
}

std::string toJson(const ShowFigures& f) {
  nlohmann::json j{{"frames", f.frames}, {"walls", f.walls}};
  j["draw_method"] = f.drawMethod.empty() ? nlohmann::json() : nlohmann::json(f.drawMethod);
  // No number of frames measures nodes that are never drawn.
  const bool wouldDo = f.framesNeeded > 0 || std::ranges::none_of(f.nodes, isUnmeasured);
  j["frames_needed"] = wouldDo ? nlohmann::json(f.framesNeeded) : nlohmann::json();
  j["whole_frames"] = f.wholeFrames;
  j["warm_up_ms"] = f.warmUpMs;
  if (!f.counters.empty()) j["counters"] = f.counters;
  j["nodes"] = nlohmann::json::array();
  j["stages"] = nlohmann::json::array();
  for (const NodeRow& row : f.nodes) j["nodes"].push_back(toJson(row, f.walls));
  for (const StageRow& s : f.stages)
    j["stages"].push_back({{"stage", s.name()},
                           {"part", s.part},
                           {"ms", s.ms},
                           {"p95_ms", s.p95},
                           {"max_ms", s.most},
                           {"count", s.count},
                           {"allocations", s.allocations},
                           {"allocated_bytes", s.bytes},
                           {"wait", s.wait}});
  j["counts"] = nlohmann::json::array();
  for (const CountRow& c : f.counts)
    j["counts"].push_back({{"of", c.of}, {"what", c.what}, {"mean", c.mean}, {"max", c.most}});
  for (const StageBreakdown* e : f.breakdowns())
    j["explained"].push_back(
        {{"stage", e->stage},
         {"measured_ms", e->measured},
         {"nodes_ms", e->nodes},
         {"parts_ms", e->named},
         {"covered", e->measured > 0 ? nlohmann::json(e->covered()) : nlohmann::json()}});
  return j.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string toCsv(const ShowFigures& f) {
  std::string csv =
      "path,file,line,kind,stage,part,wall,eye,ms,p95_ms,max_ms,count,allocations,share,budget_ms,method\n";
  for (const NodeRow& r : f.nodes) addRows(r, f, csv);
  for (const StageRow& s : f.stages)
    csv += fmt::format(",,,{},{},{},{},{},{},{},{},{},{},,,{}\n", s.wait ? "wait" : "stage",
                       csvField(s.stage), csvField(s.part), csvField(s.wall), s.eye, s.ms, s.p95, s.most,
                       s.count, s.allocations, csvField(s.alone ? f.drawMethod : ""));
  return csv;
}

}  // namespace stadion
