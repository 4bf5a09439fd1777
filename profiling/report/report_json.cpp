#include "profiling/report/duration_histogram.h"
#include "profiling/report/node_table.h"
#include "profiling/report/report_data.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

namespace stadion {
namespace {

using nlohmann::json;

/// Limits of nodes: each takes about 100 bytes. The costs on each wall are included for the most expensive
/// ones.
constexpr std::size_t kMostNodes = 12'000, kMostOnWalls = 1200;
constexpr std::size_t kColumns = 1200;  ///< of the strip that shows the whole run

/// Six digits are enough for a picture, four for one of very many nodes.
json number(double v, int digits = 6) {
  if (!std::isfinite(v) || v == 0) return 0;
  const double scale = std::pow(10, digits - 1 - std::floor(std::log10(std::abs(v))));
  return std::round(v * scale) / scale;
}

/// Null: not measured.
json measured(double v, bool known, int digits) {
  return known || v > 0 ? number(v, digits) : json();
}

json number(std::optional<double> v) {
  return v ? number(*v) : json();
}

class Builder {
public:
  explicit Builder(const ReportData& data) : data_(data), table_(data.figures, data.names, kMostNodes) {}

  json build() {
    json j;
    j["head"] = head();
    j["walls"] = data_.figures.walls;
    j["spans"] = json::array();
    for (std::size_t s = 0; s < kSpans; ++s) j["spans"].push_back(nameOf(static_cast<Span>(s)));
    j["distributions"] = distributions();
    j["strip"] = strip();
    j["stretches"] = stretches();
    for (const auto& thread : data_.threads) j["threads"].push_back(thread.name);
    j["late"] = late();
    j["causes"] = causes();
    j["stages"] = stages();
    j["eyes"] = json::array();
    for (const EyeFigures& e : data_.eyes)
      j["eyes"].push_back({{"wall", e.wall},
                           {"eye", e.eye},
                           {"ms", number(e.ms)},
                           {"p95", number(e.p95, 3)},
                           {"count", e.count}});
    j["dynamics"] = data_.dynamics ? dynamics(*data_.dynamics) : json();
    j["nodes"] = nodes();  // last, because the other parts may add nodes
    j["files"] = files_;
    j["kinds"] = kinds_;
    return j;
  }

private:
  json head() const {
    json h{{"show", data_.head.show},
           {"rate", data_.head.rate},
           {"frames", data_.head.frames},
           {"recording", number(data_.head.recording)},
           {"drawMethod", data_.figures.drawMethod},
           {"framesNeeded", data_.figures.framesNeeded},
           {"profiled", data_.figures.frames},
           {"whole", data_.figures.wholeFrames}};
    h["facts"] = json::array();
    for (const auto& [what, how] : data_.head.facts) h["facts"].push_back({what, how});
    return h;
  }

  /// For frames without sampling.
  json distribution(const std::string& name, const char* stage,
                    const std::function<float(std::size_t row)>& of) const {
    std::vector<float> values;
    for (std::size_t row = 0; row < data_.series.rows().size(); ++row)
      if (!data_.series.rows()[row].sampled && of(row) > 0) values.push_back(of(row));
    const DurationHistogram d = durationHistogramOf(std::move(values));
    return {{"name", name},           {"stage", stage},
            {"mean", number(d.mean)}, {"median", number(d.median)},
            {"p95", number(d.p95)},   {"p99", number(d.p99)},
            {"max", number(d.most)},  {"from", number(d.from)},
            {"step", number(d.step)}, {"bins", d.bins},
            {"count", d.count}};
  }

  json distributions() const {
    json all = json::array();
    const FrameSeries& series = data_.series;
    all.push_back(
        distribution("frame to frame", "frame", [&](std::size_t row) { return series.rows()[row].period; }));
    all.push_back(distribution("App", "app", [&](std::size_t row) { return series.rows()[row].app; }));
    const auto at = [](std::span<const float> byWall, std::size_t wall) {
      return wall < byWall.size() ? byWall[wall] : 0;
    };
    const std::vector<std::string>& walls = data_.figures.walls;
    for (std::size_t w = 0; w < walls.size(); ++w)
      all.push_back(
          distribution("Cull " + walls[w], "cull", [&](std::size_t row) { return at(series.cull(row), w); }));
    for (std::size_t w = 0; w < walls.size(); ++w)
      all.push_back(
          distribution("Draw " + walls[w], "draw", [&](std::size_t row) { return at(series.draw(row), w); }));
    std::erase_if(all.get_ref<json::array_t&>(), [](const json& d) { return d["count"] == 0; });
    return all;
  }

  /// Returns the whole run. If there are too many frames, several share a column, and the worst is shown.
  json strip() const {
    const auto& rows = data_.series.rows();
    const std::size_t each = std::max<std::size_t>(1, (rows.size() + kColumns - 1) / kColumns);
    json s{{"framesEach", each}, {"columns", json::array()}};
    for (std::size_t i = 0; i < rows.size(); i += each) {
      const FrameRow* worst = nullptr;
      std::size_t at = i;
      for (std::size_t k = i; k < std::min(i + each, rows.size()); ++k) {
        const bool better = !worst || (worst->sampled && !rows[k].sampled) ||
                            (worst->sampled == rows[k].sampled && rows[k].period > worst->period);
        if (better) {
          worst = &rows[k];
          at = k;
        }
      }
      s["columns"].push_back({worst->frame, number(static_cast<double>(worst->period)),
                              worst->sampled ? 1 : 0, worst->cause == Cause::None ? 0 : 1,
                              number(static_cast<double>(worst->app)),
                              number(static_cast<double>(std::ranges::max(data_.series.cull(at)))),
                              number(static_cast<double>(std::ranges::max(data_.series.draw(at))))});
    }
    return s;
  }

  json stretch(const Stretch& s, const std::string& key, const std::string& label) {
    json frames = json::array();
    std::int64_t origin = -1;
    for (const auto& [frame, kept] : data_.kept.frames())
      if (s.covers(frame))
        for (const KeptSpan& span : kept.spans)
          if (!isWait(span.what) && (origin < 0 || span.began < origin)) origin = span.began;
    for (const auto& [frame, kept] : data_.kept.frames())
      if (s.covers(frame)) frames.push_back(keptFrame(frame, kept, origin));
    return {{"key", key}, {"label", label}, {"about", s.about}, {"frames", std::move(frames)}};
  }

  json keptFrame(std::uint64_t frame, const KeptFrame& kept, std::int64_t origin) {
    const FrameFacts& f = kept.facts;
    const bool late = f.cause != Cause::None && !kept.sampled;
    json j{{"frame", frame},
           {"period", number(static_cast<double>(f.period))},
           {"late", late},
           {"sampled", kept.sampled},
           {"verdict", late ? toText(f, data_.figures.walls) : ""}};
    json spans = json::array();
    for (const KeptSpan& s : kept.spans) {
      const auto track = std::ranges::find(data_.threads, s.track, &ThreadNames::Thread::track);
      if (track == data_.threads.end()) continue;
      const long node = s.node.valid() ? table_.find(s.node) : -1;
      const auto us = [](std::int64_t ns) { return static_cast<double>(ns / 10) / 100; };
      spans.push_back({track - data_.threads.begin(), static_cast<int>(s.what),
                       s.wall == kNoWall ? -1 : static_cast<long>(s.wall), s.depth, node,
                       us(s.began - origin), us(s.ended - s.began), number(static_cast<double>(s.ms))});
    }
    j["spans"] = std::move(spans);
    return j;
  }

  json stretches() {
    json all = json::array();
    double median = 0;
    for (const auto& d : distributions())
      if (d["stage"] == "frame") median = d["median"];
    for (const Stretch& s : data_.kept.worst()) {
      const bool first = all.empty();
      all.push_back(stretch(s, first ? "worst" : "worst" + std::to_string(all.size() + 1),
                            first ? "around the longest frame" : "around the next longest"));
    }
    if (const Stretch* normal = data_.kept.normal(median))
      all.push_back(stretch(*normal, "normal", "normal frames"));
    return all;
  }

  json late() {
    json all = json::array();
    for (const FrameFacts& f : data_.series.late())
      all.push_back(
          {{"frame", f.frame},
           {"period", number(static_cast<double>(f.period))},
           {"cause", nameOf(f.cause)},
           {"stage", nameOf(f.stage)},
           {"wall",
            f.stage == Span::App || f.wall >= data_.figures.walls.size() ? "" : data_.figures.walls[f.wall]},
           {"text", toText(f, data_.figures.walls)},
           {"node", nodeExplains(f) ? table_.find(f.mostExpensive()) : -1},
           {"nodeMs", number(static_cast<double>(f.nodeMs))}});
    return all;
  }

  json causes() const {
    json all = json::array();
    for (const auto& [cause, count] : data_.series.causes())
      all.push_back({cause == Cause::None ? "in time" : std::string(nameOf(cause)), count});
    return all;
  }

  json stages() const {
    json s{{"rows", json::array()}, {"explained", json::array()}};
    for (const StageRow& r : data_.figures.stages)
      s["rows"].push_back({{"name", r.name()},
                           {"part", r.part},
                           {"ms", number(r.ms)},
                           {"p95", number(r.p95, 3)},
                           {"max", number(r.most)},
                           {"wait", r.wait}});
    s["counts"] = json::array();
    for (const CountRow& c : data_.figures.counts)
      s["counts"].push_back(
          {{"of", c.of}, {"what", c.what}, {"mean", number(c.mean)}, {"max", number(c.most)}});
    for (const StageBreakdown* e : data_.figures.breakdowns())
      s["explained"].push_back({{"stage", e->stage},
                                {"measured", number(e->measured)},
                                {"nodes", number(e->nodes)},
                                {"named", number(e->named)}});
    return s;
  }

  /// Leaves out values that are 0 or the same for most nodes; the page's script restores them (readNodes).
  json nodes() {
    json all = json::array();
    std::size_t priced = 0;
    for (std::size_t i = 0; i < table_.nodes().size(); ++i) {
      const TableNode& n = table_.nodes()[i];
      json j{{"path", n.name.path}};
      if (n.parent != i) j["parent"] = n.parent;
      if (!n.name.file.empty()) j["place"] = {placeIn(files_, n.name.file), n.name.line};
      if (n.restCount == 0) j["kind"] = placeIn(kinds_, std::string(n.name.type));
      if (n.name.unloaded) j["unloaded"] = true;
      if (n.name.budget > 0) j["budget"] = number(n.name.budget);
      if (n.row || n.restCount > 0) addCosts(j, n.row ? *n.row : n.rest, ++priced <= kMostOnWalls);
      all.push_back(std::move(j));
    }
    return all;
  }

  static std::size_t placeIn(std::vector<std::string>& list, const std::string& text) {
    const auto at = std::ranges::find(list, text);
    if (at == list.end()) {
      list.push_back(text);
      return list.size() - 1;
    }
    return static_cast<std::size_t>(at - list.begin());
  }

  static void addCosts(json& j, const NodeRow& r, bool onWalls) {
    const int digits = onWalls ? 6 : 4;
    j["costs"] = {number(r.app, digits), measured(r.cull, r.cullMeasured, digits),
                  measured(r.draw, r.drawKnown(), digits)};
    if (!r.drawMeasured && r.draw > 0) j["inPart"] = true;
    if (r.share > 0) j["share"] = number(r.share, digits);
    if (r.visits > 0)
      j["visits"] = {number(r.visits, digits), number(r.visitP95, digits), number(r.visitMost, digits)};
    if (r.drawings > 0)
      j["drawings"] = {r.drawings, number(r.drawingP95, digits), number(r.drawingMost, digits)};
    if (r.app > 0)
      for (const double ms : {r.receive, r.simulate, r.dispatch, r.settle, r.publish})
        j["phases"].push_back(number(ms, digits));
    if (r.cull + r.draw <= 0 || !onWalls) return;
    for (const NodeOnWall& w : r.walls)
      j["walls"].push_back({measured(w.cull, w.cullMeasured, 6), measured(w.draw[0], w.drawMeasured[0], 6),
                            measured(w.draw[1], w.drawMeasured[1], 6)});
  }

  static json dynamics(const DynamicsFigures& d) {
    json j{{"tolerance", d.tolerance}, {"note", d.note}, {"bodies", json::array()}};
    for (const BodyFigures& b : d.bodies)
      j["bodies"].push_back({{"name", b.name},
                             {"place", b.file + ":" + std::to_string(b.line)},
                             {"shape", b.shape},
                             {"share", number(b.share)},
                             {"cost", number(b.cost)},
                             {"error", number(b.error)},
                             {"endError", number(b.endError)},
                             {"beyond", number(b.beyond)},
                             {"advice", b.advice},
                             {"caution", b.caution},
                             {"adviceCost", number(b.adviceCost)},
                             {"adviceError", number(b.adviceError)}});
    return j;
  }

  const ReportData& data_;
  NodeTable table_;
  std::vector<std::string> files_, kinds_;
};

}  // namespace

std::string reportJson(const ReportData& data) {
  return Builder(data).build().dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace stadion
