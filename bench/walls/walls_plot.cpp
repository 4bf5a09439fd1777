#include "bench/walls/walls_plot.h"

#include "bench/walls/svg_parts.h"
#include "bench/walls/walls_case.h"
#include "bench/walls/walls_judge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace stadion::bench {
namespace {

constexpr double kWidth = 1120, kNames = 130, kPanel = 420, kGap = 70, kTop = 84, kGroup = 62, kBar = 15;
constexpr const char* kOurs = "#c00000";
constexpr const char* kTheirs = "#1f77b4";
constexpr const char* kFloor = "#7f7f7f";
constexpr const char* kGrid = "stroke='#ddd'";

struct Group {
  const char* scene;
  bool flat;
  const char* kind;
  double leastFps;       ///< of OpenSceneGraph's
  double mostProcessor;  ///< of OpenSceneGraph's; 0: no limit
};

constexpr Group kGroups[] = {
    {"a", false, "STRICT", 1.4, 0.8}, {"b", false, "STRICT", 1.4, 0.8}, {"c", true, "STRICT", 2.2, 0},
    {"c", false, "STRICT", 1.6, 0},   {"a", false, "OPEN", 2.2, 0},     {"b", false, "OPEN", 2.2, 0},
    {"a", false, "SUBMIT", 2, 0},     {"b", false, "SUBMIT", 2, 0},     {"c", false, "SUBMIT", 3.5, 0}};

struct Bar {
  const char* colour;
  std::optional<double> value;
};

/// Stadion's bar, that of OpenSceneGraph's best, and bare OpenGL's.
std::array<Bar, 3> barsOf(const WallsResults& results, const Group& g, const char* field) {
  const std::string kind = std::string(g.kind) == "SUBMIT" ? "SUBMIT" : "STRICT";
  const auto of = [&](const std::string& name) { return results.median(name, field); };
  return {{{kOurs, of(nameOf(ourCase(g.scene, g.flat, g.kind)))},
           {kTheirs, of(bestOsg(results, g.scene, g.flat, kind))},
           {kFloor, of(nameOf(floorCase(g.scene, kind)))}}};
}

/// One figure of all programs, of every group, as multiples of OpenSceneGraph's best.
class Panel {
public:
  Panel(const WallsResults& results, double left, const char* title, const char* field, const char* unit,
        double most)
      : results_(results), left_(left), field_(field), unit_(unit), most_(most),
        svg_(svgText(left, kTop - 30, "start", title, "font-weight='bold'")) {}

  void add(const Group& g, double top, double limit) {
    const auto all = barsOf(results_, g, field_);
    const std::optional<double> theirs = all[1].value;
    // Without OpenSceneGraph the longest bar is the unit.
    const double one = theirs.value_or(std::max(all[0].value.value_or(0), all[2].value.value_or(0)));
    if (one <= 0) return;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (all[i].value)
        svg_ += svgBox(left_, top + kBar * static_cast<double>(i), x(*all[i].value / one) - left_, kBar - 2,
                       all[i].colour);
    if (limit > 0 && theirs)
      svg_ += svgLine(x(limit), top - 4, x(limit), top + 2 * kBar + 2, "stroke='black' stroke-width='2'");
    for (std::size_t i = 0; i < all.size(); ++i)
      if (all[i].value)
        svg_ += svgText(x(*all[i].value / one) + 5, top + kBar * static_cast<double>(i) + kBar - 4, "start",
                        fmt::format("{:.1f} {}", *all[i].value, unit_),
                        "font-size='11' paint-order='stroke' stroke='white' stroke-width='3'");
  }

  std::string drawn(double bottom) const {
    std::string grid;
    for (double value = 0; value <= most_; value += most_ > 3 ? 1 : 0.5)
      grid += svgLine(x(value), kTop - 10, x(value), bottom, kGrid) +
              svgText(x(value), kTop - 14, "middle", fmt::format("{:g}", value), "fill='#777'");
    return grid + svg_;
  }

private:
  double x(double multiple) const { return left_ + std::min(multiple, most_) / most_ * (kPanel - 90); }

  const WallsResults& results_;
  double left_;
  const char* field_;
  const char* unit_;
  double most_;
  std::string svg_;
};

std::string legend(double x, double y, const char* colour, const char* what) {
  return svgBox(x, y - 10, 14, 11, colour) + svgText(x + 20, y, "start", what);
}

/// A curve with a dot at each measured place.
struct Curve {
  const char* name;
  const char* colour;
  std::vector<std::pair<double, double>> points;
};

std::string drawn(const Curve& curve, const auto& x, const auto& y) {
  std::string path, dots;
  for (const auto& [a, b] : curve.points) {
    path += fmt::format("{:.1f},{:.1f} ", x(a), y(b));
    dots += fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='3.5' fill='{}'/>\n", x(a), y(b), curve.colour);
  }
  return fmt::format("<polyline points='{}' fill='none' stroke='{}' stroke-width='1.8'/>\n", path,
                     curve.colour) +
         dots;
}

/// Over the number of nodes.
std::string nodeCurves(const WallsResults& results, double left, double right, double top, double bottom) {
  std::vector<Curve> curves{{"App and publishing", "#2ca02c", {}},
                            {"Cull, all walls", "#ff7f0e", {}},
                            {"Draw, all walls", kOurs, {}},
                            {"bare OpenGL, all walls", kFloor, {}}};
  const char* fields[] = {"app_ms", "cull_ms_sum", "draw_ms_sum", "frame_ms_median"};
  std::vector<double> times, counts;
  for (const std::size_t nodes : scalingNodes())
    for (std::size_t i = 0; i < curves.size(); ++i) {
      const auto ms = results.median(nameOf(scalingCase(nodes, i == 3 ? "floor" : "stadion")), fields[i]);
      if (!ms || *ms <= 0) continue;
      curves[i].points.emplace_back(static_cast<double>(nodes), *ms);
      times.push_back(*ms);
      counts.push_back(static_cast<double>(nodes));
    }
  const LogAxis x = logAxis(counts, left, right), y = logAxis(times, bottom, top);
  std::string svg = svgText(left, top - 34, "start", "a frame of 4 walls over the number of nodes [ms]",
                            "font-weight='bold'");
  for (int d = x.first; d <= x.last; ++d)
    svg += svgLine(x.at(std::pow(10, d)), top, x.at(std::pow(10, d)), bottom, kGrid) +
           svgText(x.at(std::pow(10, d)), bottom + 18, "middle", fmt::format("{:g}", std::pow(10, d)));
  for (int d = y.first; d <= y.last; ++d)
    svg += svgLine(left, y.at(std::pow(10, d)), right, y.at(std::pow(10, d)), kGrid) +
           svgText(left - 8, y.at(std::pow(10, d)) + 4, "end", fmt::format("{:g}", std::pow(10, d)));
  double line = top + 8;
  for (const Curve& c : curves) {
    if (c.points.empty()) continue;
    svg += drawn(
        c, [&](double v) { return x.at(v); }, [&](double v) { return y.at(v); });
    svg += legend(left + 12, line += 18, c.colour, c.name);
  }
  return svg;
}

/// Over the number of walls.
std::string wallCurves(const WallsResults& results, double left, double right, double top, double bottom) {
  std::vector<Curve> curves{
      {"Stadion", kOurs, {}}, {"OpenSceneGraph, DPC", kTheirs, {}}, {"bare OpenGL, one thread", kFloor, {}}};
  double most = 1;
  for (std::size_t walls = 1; walls <= 6; ++walls) {
    WallsCase of[] = {ourCase("a", false, "STRICT"), osgCase("a", false, "STRICT", "DPC"),
                      floorCase("a", "STRICT")};
    for (std::size_t i = 0; i < std::size(of); ++i) {
      of[i].walls = walls;
      const auto fps = results.median(nameOf(of[i]), "fps");
      if (!fps) continue;
      curves[i].points.emplace_back(static_cast<double>(walls), *fps);
      most = std::max(most, *fps);
    }
  }
  const auto x = [&](double walls) { return left + (walls - 1) / 5 * (right - left); };
  const auto y = [&](double fps) { return bottom - fps / most * (bottom - top); };
  std::string svg =
      svgText(left, top - 34, "start", "scene a, STRICT: frames a second over the number of walls",
              "font-weight='bold'");
  for (int walls = 1; walls <= 6; ++walls)
    svg += svgLine(x(walls), top, x(walls), bottom, kGrid) +
           svgText(x(walls), bottom + 18, "middle", std::to_string(walls));
  for (int i = 0; i <= 5; ++i)
    svg += svgLine(left, y(most * i / 5), right, y(most * i / 5), kGrid) +
           svgText(left - 8, y(most * i / 5) + 4, "end", fmt::format("{:.3g}", most * i / 5));
  double line = top + 8;
  for (const Curve& c : curves) {
    if (c.points.empty()) continue;
    svg += drawn(c, x, y) + legend(right - 170, line += 18, c.colour, c.name);
  }
  return svg;
}

}  // namespace

std::string wallsPlot(const WallsResults& results) {
  Panel fps(results, kNames, "frames a second (OpenSceneGraph's best = 1)", "fps", "fps", 6);
  Panel processor(results, kNames + kPanel + kGap, "processor time a frame (OpenSceneGraph's best = 1)",
                  "cpu_ms_per_frame", "ms", 2);
  std::string names;
  double top = kTop;
  for (const Group& g : kGroups) {
    if (!barsOf(results, g, "fps")[0].value) continue;
    const std::string scene = std::string(g.scene) == "c" ? (g.flat ? "c flat" : "c grid") : g.scene;
    names += svgText(kNames - 12, top + kBar + 8, "end", scene + " " + g.kind);
    fps.add(g, top, g.leastFps);
    processor.add(g, top, g.mostProcessor);
    top += kGroup;
  }
  const std::string svg =
      svgText(20, 26, "start", "A room of 4 walls, both eyes on each", "font-size='16'") +
      legend(460, 26, kOurs, "Stadion") + legend(545, 26, kTheirs, "OpenSceneGraph's best") +
      legend(725, 26, kFloor, "bare OpenGL, one thread") +
      svgLine(910, 14, 910, 28, "stroke='black' stroke-width='2'") +
      svgText(920, 26, "start", "what has to hold") + names + fps.drawn(top) + processor.drawn(top);
  return svgPicture(kWidth, top + 20, svg);
}

std::string scalingPlot(const WallsResults& results) {
  return svgPicture(kWidth, 500,
                    svgText(20, 26, "start", "What grows with nodes and walls", "font-size='16'") +
                        nodeCurves(results, 70, 530, 90, 450) + wallCurves(results, 630, 1080, 90, 450));
}

}  // namespace stadion::bench
