#include "profiling/report/show_figures.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>

namespace stadion {
namespace {

/// A scale above this is not due to the nodes.
constexpr double kLargestScale = 1.5;

class Figures {
public:
  Figures(const ShowProfile& profile, const NodeNames& names, const std::vector<std::string>& walls)
      : profile_(profile), names_(names), frames_(std::max<double>(1, static_cast<double>(profile.frames()))),
        wholeFrames_(std::max<double>(1, static_cast<double>(profile.wholeFrames()))) {
    appScale_ = appScale();
    out_.frames = profile.frames();
    out_.walls = walls;
    for (std::uint32_t wall = 0; wall < walls.size(); ++wall) out_.eyes.push_back(eyesOf(wall));
    for (const auto& [ref, node] : profile.nodes())
      if (ref.valid()) addNode(ref, node);
    addVisitor();
    explainAlone();
    scaleDraw();
    addStages();
    addCounts();
    explain();
    const double all = out_.app.measured + out_.cull.measured + out_.alone.measured;
    out_.framesNeeded = framesNeeded();
    out_.wholeFrames = profile.wholeFrames();
    for (NodeRow& row : out_.nodes) row.share = all > 0 ? row.total / all : 0;
    std::ranges::sort(out_.nodes, [](const NodeRow& a, const NodeRow& b) {
      return a.total != b.total ? a.total > b.total : a.node < b.node;
    });
  }
  ShowFigures take() { return std::move(out_); }

private:
  /// Recording every node takes time, and memory from the caches, so App is longer in these frames. Nodes'
  /// times come from them; their times in other frames are in proportion.
  double appScale() const {
    const double others = frames_ - wholeFrames_, whole = profile_.wholeApp() / wholeFrames_;
    const auto app = profile_.spans().find({Span::App, kNoWall});
    if (others < 1 || whole <= 0 || app == profile_.spans().end()) return 1;
    return std::clamp((app->second.ms.sum() - profile_.wholeApp()) / others / whole, 0.0, 1.0);
  }

  double perSample(double ms, std::uint32_t wall) const {
    const std::uint64_t samples = profile_.sampled(wall);
    return samples > 0 ? ms / static_cast<double>(samples) : 0;
  }

  double shareOf(std::uint64_t shares, Span what, std::uint32_t wall) const {
    const std::uint64_t all = profile_.shares(what, wall);
    return all > 0 ? sum(what, wall) * static_cast<double>(shares) / static_cast<double>(all) : 0;
  }

  /// Returns the number of sampled frames in which that eye saw it. If the eyes were not distinguished, both
  /// saw all.
  std::uint64_t seenBy(std::size_t eye, std::uint32_t wall, const NodeWallCost& cost) const {
    const bool apart = profile_.shares(Span::LeftEye, wall) + profile_.shares(Span::RightEye, wall) > 0;
    const auto at = cost.shares.find(!apart ? Span::Fill : eye == 0 ? Span::LeftEye : Span::RightEye);
    return at == cost.shares.end() ? 0 : at->second;
  }

  std::size_t eyesOf(std::uint32_t wall) const {
    const auto drawn = [&](std::uint32_t eye, Span what) {
      return profile_.eyes().contains({wall, eye}) || profile_.shares(what, wall) > 0 ||
             profile_.spans().contains({what, wall});
    };
    return drawn(1, Span::RightEye) ? 2 : drawn(0, Span::LeftEye) ? 1 : 0;
  }

  void addNode(NodeRef ref, const NodeProfile& node) {
    NodeRow row;
    row.node = ref;
    if (auto name = names_.find(ref)) row.name = std::move(*name);
    const double each = appScale_ / wholeFrames_;
    row.receive = each * node.phases[0];
    row.simulate = each * node.phases[1];
    row.dispatch = each * node.phases[2];
    row.settle = each * node.settle;
    row.publish = shareOf(node.published, Span::Publish, kNoWall);
    row.app = row.receive + row.simulate + row.dispatch + row.settle + row.publish;
    row.visitP95 = node.visit.percentile(95);
    row.visitMost = node.visit.most();
    row.visits = static_cast<double>(node.visit.count()) / wholeFrames_;
    row.drawingP95 = node.drawing.percentile(95);
    row.drawingMost = node.drawing.most();
    row.drawings = node.drawing.count();
    row.allocations = static_cast<double>(node.allocations.count) / wholeFrames_;
    row.bytes = static_cast<double>(node.allocations.bytes) / wholeFrames_;
    row.walls.resize(out_.walls.size());
    for (const auto& [wall, cost] : node.walls) {
      if (wall >= row.walls.size()) continue;
      NodeOnWall& on = row.walls[wall];
      for (const auto& [what, shares] : cost.shares)
        if (stageOf(what) == Span::Cull) on.cull += shareOf(shares, what, wall);
      for (std::size_t eye = 0; eye < 2; ++eye) {
        const double present = perSample(static_cast<double>(seenBy(eye, wall, cost)), wall);
        if (cost.draw[eye] > 0)
          on.draw[eye] = present * cost.draw[eye] / static_cast<double>(cost.drawn[eye]);
        row.draw += on.draw[eye];
      }
      row.cull += on.cull;
    }
    markMeasured(row, node);
    row.total = row.app + row.cull + row.draw;
    out_.nodes.push_back(std::move(row));
  }

  /// Measured: drawn where it was visible, or sampled and visible nowhere. Otherwise its cost is unknown.
  void markMeasured(NodeRow& row, const NodeProfile& node) {
    for (std::uint32_t wall = 0; wall < row.walls.size(); ++wall) {
      NodeOnWall& on = row.walls[wall];
      const auto cost = node.walls.find(wall);
      on.cullMeasured = profile_.sampled(wall) > 0;
      row.cullMeasured = row.cullMeasured && on.cullMeasured;
      for (std::uint32_t eye = 0; eye < 2; ++eye) {
        const bool seen = cost != node.walls.end() && seenBy(eye, wall, cost->second) > 0;
        const bool drawn = profile_.eyes().contains({wall, eye});
        on.drawMeasured[eye] = on.cullMeasured && drawn && (!seen || cost->second.drawn[eye] > 0);
        if (seen && cost->second.drawn[eye] > 0 && cost->second.draw[eye] <= 0) row.drawTooLittle = true;
        if (drawn || eye == 0) row.drawMeasured = row.drawMeasured && on.drawMeasured[eye];
        if (!seen || !drawn) continue;
        ++seen_[{wall, eye}];
        if (on.drawMeasured[eye]) ++sampled_[{wall, eye}];
      }
    }
  }

  /// An estimate: the number of nodes drawn alone in each sample stays the same. If nothing is drawn, no
  /// frames are missing.
  std::uint64_t framesNeeded() const {
    const bool draws =
        std::ranges::any_of(profile_.spans(), [](const auto& s) { return s.first.first == Span::LeftEye; });
    if (std::ranges::all_of(out_.nodes,
                            [&](const NodeRow& r) { return r.cullMeasured && (r.drawMeasured || !draws); }))
      return 0;
    const FrameLogOptions log;
    const std::uint64_t played = profile_.frames() + log.from;
    std::uint64_t needed = 4 * log.sampleEvery;
    for (const auto& [eye, seen] : seen_) {
      const auto at = sampled_.find(eye);
      if (at == sampled_.end() || at->second == seen) continue;
      const std::uint64_t every = log.sampleEvery * (seen > kManyShares ? log.crowdedEvery : 1);
      const double rounds = static_cast<double>(1 + played / every), margin = 1.25;
      const double all = rounds * static_cast<double>(seen) / static_cast<double>(at->second);
      needed = std::max(needed, every * (1 + static_cast<std::uint64_t>(margin * all)));
    }
    return std::max(needed, played + log.sampleEvery);
  }

  /// Adds costs that belong to no node of the script: trackers, and the eyes in front of the walls.
  void addVisitor() {
    NodeRow row;
    row.name.path = "visitor";
    row.name.type = "rig";
    row.receive = sum(Span::Input);
    const auto published = profile_.nodes().find(NodeRef{});
    if (published != profile_.nodes().end())
      row.publish = shareOf(published->second.published, Span::Publish, kNoWall);
    row.app = row.receive + row.publish;
    row.walls.resize(out_.walls.size());
    for (std::uint32_t wall = 0; wall < row.walls.size(); ++wall)
      row.cull += row.walls[wall].cull = sum(Span::Eyes, wall);
    row.total = row.app + row.cull;
    if (row.total > 0) out_.nodes.push_back(std::move(row));
  }

  std::string wallName(std::uint32_t wall) const { return wall < out_.walls.size() ? out_.walls[wall] : ""; }

  StageRow stageRow(Span stage, std::uint32_t wall) const {
    StageRow row;
    row.stage = std::string(nameOf(stage));
    row.wall = wallName(wall);
    return row;
  }

  void addStages() {
    for (const auto& [key, total] : profile_.spans()) {
      const auto& [what, wall] = key;
      if (isOfNode(what) || what == Span::Settle) continue;
      StageRow row = stageRow(stageOf(what), wall);
      if (!isStage(what)) row.part = std::string(nameOf(what));
      row.ms = isStage(what) ? total.ms.sum() / frames_ : total.own / framesOf(what, wall);
      row.p95 = total.ms.percentile(95);
      row.most = total.ms.most();
      row.count = total.ms.count();
      row.wait = isWait(what);
      const double times = std::max(1.0, static_cast<double>(total.counted));
      row.allocations = static_cast<double>(total.allocations.count) / times;
      row.bytes = static_cast<double>(total.allocations.bytes) / times;
      out_.stages.push_back(std::move(row));
    }
    for (const auto& [key, eye] : profile_.eyes()) {
      const auto add = [&, wall = key.first, side = key.second](const std::string& part,
                                                                const CostSeries& ms) {
        StageRow row = stageRow(Span::Draw, wall);
        row.eye = side == 0 ? "left" : "right";
        row.part = part;
        row.alone = true;
        row.ms = std::max(0.0, ms.mean());
        row.p95 = ms.percentile(95);
        row.most = ms.most();
        row.count = ms.count();
        out_.stages.push_back(std::move(row));
      };
      add("", eye.whole);
      for (const auto& [part, ms] : eye.parts) add(std::string(nameOf(part)), ms);
      add("nothing", eye.empty);
    }
  }

  void addCounts() {
    for (const auto& [key, amount] : profile_.counts()) {
      CountRow row;
      row.of = stageRow(stageOf(key.of), key.wall).name();
      if (key.of == Span::LeftEye || key.of == Span::RightEye)
        row.of += key.of == Span::LeftEye ? " left" : " right";
      if (key.node.valid()) {
        const auto name = names_.find(key.node);
        row.of = name ? name->path : "a node";
      }
      row.what = std::string(nameOf(key.what));
      row.mean = amount.sum() / frames_;
      row.most = amount.most();
      out_.counts.push_back(std::move(row));
    }
  }

  /// Returns the cost a frame, of one wall or of all; over the frames with recorded parts.
  double sum(Span what, std::optional<std::uint32_t> wall = {}) const {
    double ms = 0;
    for (const auto& [key, total] : profile_.spans())
      if (key.first == what && (!wall || key.second == *wall))
        ms += (isStage(what) ? total.kept : total.own) / framesOf(what, key.second);
    return ms * (isPartOfApp(what) ? appScale_ : 1);
  }

  static bool isPartOfApp(Span what) { return what > Span::Swap && what <= Span::Watching; }

  /// Returns the number of frames in which that was recorded, and counts.
  double framesOf(Span what, std::uint32_t wall) const {
    const bool ofCull =
        (what == Span::Cull || (what >= Span::Eyes && what <= Span::Sort)) && profile_.keptCulls(wall) > 0;
    return isPartOfApp(what) ? wholeFrames_
           : ofCull          ? static_cast<double>(profile_.keptCulls(wall))
                             : frames_;
  }

  void explain() {
    StageBreakdown& app = out_.app;
    // If other threads help, App waits for them meanwhile.
    app.stage = "app";
    const double helped = appScale_ * profile_.helped() / wholeFrames_;
    app.measured =
        appScale_ * profile_.wholeApp() / wholeFrames_ + helped - std::min(sum(Span::Workers), helped);
    double published = 0;
    for (const NodeRow& row : out_.nodes) {
      app.nodes += row.app;
      published += row.publish;
    }
    for (const Span s : {Span::Loading, Span::Mail, Span::Workers, Span::Sound, Span::Watching})
      app.named += sum(s);
    app.named += std::max(0.0, sum(Span::Publish) - published);
    app.named -= std::min(sum(Span::Workers), helped);

    StageBreakdown& cull = out_.cull;
    cull.stage = "cull";
    cull.measured = sum(Span::Cull);
    for (const NodeRow& row : out_.nodes) cull.nodes += row.cull;
    // The parts without a node.
    for (const Span s : {Span::Test, Span::Fill, Span::ShadowCasts, Span::Sort})
      for (std::uint32_t wall = 0; wall < out_.walls.size(); ++wall)
        if (profile_.shares(s, wall) == 0) cull.named += sum(s, wall);

    StageBreakdown& draw = out_.draw;
    draw.stage = "draw";
    draw.measured = sum(Span::Draw);
    for (const Span s :
         {Span::Prepare, Span::Upload, Span::ShadowMaps, Span::Finish, Span::Read, Span::Warp, Span::ForTurn})
      draw.named += sum(s);
    for (const auto& [key, eye] : profile_.eyes()) {
      if (eye.whole.mean() <= 0 || key.first >= out_.walls.size()) continue;
      const auto factor = factors_.find(key);
      const double nodes = nodesOf(key),
                   parts = partsOf(eye) * (factor == factors_.end() ? 1 : factor->second);
      const double whole = std::max(eye.whole.mean(), nodes + parts);
      const double took = sum(key.second == 0 ? Span::LeftEye : Span::RightEye, key.first);
      draw.nodes += took * nodes / whole;
      draw.named += took * parts / whole;
    }
  }

  /// Returns the cost of all nodes together for that eye of a wall.
  double nodesOf(std::pair<std::uint32_t, std::uint32_t> eye) const {
    double ms = 0;
    for (const NodeRow& row : out_.nodes) ms += row.walls[eye.first].draw[eye.second];
    return ms;
  }

  /// Explains the eyes as drawn alone.
  void explainAlone() {
    StageBreakdown& alone = out_.alone;
    alone.stage = "alone";
    for (const NodeRow& row : out_.nodes) alone.nodes += row.draw;
    for (const auto& [key, eye] : profile_.eyes()) {
      alone.measured += std::max(0.0, eye.whole.mean());
      alone.named += partsOf(eye);
    }
  }
  static double partsOf(const EyeCost& eye) {
    double sum = 0;
    for (const auto& [part, ms] : eye.parts)
      if (part == Span::Sky || part == Span::Resolve) sum += std::max(0.0, ms.mean());
    return sum;
  }

  /// Scales nodes and parts drawn alone by one factor, so that their sum is the eye's whole time. In a tiny
  /// picture most of that time is fixed cost, and belongs to no node.
  void scaleDraw() {
    for (const auto& [key, eye] : profile_.eyes()) {
      const std::uint32_t wall = key.first, side = key.second;
      if (eye.whole.count() == 0 || wall >= out_.walls.size()) continue;
      if (!std::ranges::all_of(out_.nodes,
                               [&](const NodeRow& row) { return row.walls[wall].drawMeasured[side]; }))
        continue;  // an eye without a sample must not be counted with the others
      const double alone = nodesOf(key) + partsOf(eye);
      const double factor =
          alone > 0 && eye.whole.mean() > 0 ? std::min(kLargestScale, eye.whole.mean() / alone) : 1;
      for (NodeRow& row : out_.nodes) row.walls[wall].draw[side] *= factor;
      factors_[key] = factor;
    }
    for (NodeRow& row : out_.nodes) {
      row.draw = 0;
      for (const NodeOnWall& on : row.walls) row.draw += on.draw[0] + on.draw[1];
      row.total = row.app + row.cull + row.draw;
    }
  }

  const ShowProfile& profile_;
  const NodeNames& names_;
  double frames_, wholeFrames_, appScale_ = 1;
  /// Numbers of nodes by wall and eye: visible there, and of these drawn alone.
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint64_t> seen_, sampled_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> factors_;  ///< the factors of scaling
  ShowFigures out_;
};

std::string drawMethod(std::string_view gl) {
  if (gl.empty()) return {};
  if (drawnByCpuRenderer(gl)) return "processor time of one thread, each batch drawn once more, alone";
  if (!drawnBySoftware(gl)) return "OpenGL timer queries, each batch alone";
  return "processor time of the drawing thread and the rasteriser's, each batch alone, " +
         rasteriserThreadsText();
}

}  // namespace

bool drawnBySoftware(std::string_view gl) {
  return gl.find("llvmpipe") != std::string_view::npos || gl.find("softpipe") != std::string_view::npos;
}

bool drawnByCpuRenderer(std::string_view renderer) {
  return renderer.starts_with("CPU renderer");
}

std::string rasteriserThreadsText() {
  const char* threads = std::getenv("LP_NUM_THREADS");
  if (!threads) return "LP_NUM_THREADS not set: a thread for each processor";
  const std::string_view text(threads);
  const bool isNumber = !text.empty() && text.size() < 5 && std::ranges::all_of(text, [](char c) {
    return std::isdigit(static_cast<unsigned char>(c)) != 0;
  });
  return "LP_NUM_THREADS=" + std::string(text) +
         (isNumber ? "" : " (no number: a thread for each processor)");
}

std::string StageRow::name() const {
  std::string text = stage;
  for (const std::string* more : {&wall, &eye})
    if (!more->empty()) text += " " + *more;
  return alone ? text + ", alone" : text;
}

ShowFigures figuresOf(const ShowProfile& profile, const NodeNames& names,
                      const std::vector<std::string>& walls, std::string_view gl) {
  ShowFigures figures = Figures(profile, names, walls).take();
  figures.drawMethod = drawMethod(gl);
  return figures;
}

}  // namespace stadion
