#include "profiling/plan/cost_probe.h"

#include "engine/maths/median.h"

#include <algorithm>
#include <ctime>
#include <thread>

namespace stadion::plan {
namespace {

double millisecondsOf(clockid_t clock) {
  timespec t{};
  clock_gettime(clock, &t);
  return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

/// The figures of a frame, in a fixed order, to be read or set.
template <class F>
void forEachFigure(FrameCost& cost, const F& f) {
  f(cost.app), f(cost.appHelpers), f(cost.swap);
  for (WallCost& wall : cost.walls) {
    f(wall.cull), f(wall.cullBesideDraw);
    for (PictureCost& picture : wall.pictures) f(picture.calls), f(picture.raster), f(picture.atOnce);
  }
}

std::vector<double> figuresOf(FrameCost cost) {
  std::vector<double> figures;
  forEachFigure(cost, [&](double& figure) { figures.push_back(figure); });
  return figures;
}

FrameCost middleOf(const std::vector<FrameCost>& same) {
  std::vector<std::vector<double>> figures;
  for (const FrameCost& cost : same) figures.push_back(figuresOf(cost));
  FrameCost middle = same.front();
  std::size_t i = 0;
  forEachFigure(middle, [&](double& figure) {
    std::vector<double> values;
    for (const auto& one : figures)
      if (i < one.size()) values.push_back(one[i]);
    figure = median(std::move(values));
    ++i;
  });
  return middle;
}

}  // namespace

CostProbe::Moment CostProbe::Moment::now() {
  return {millisecondsOf(CLOCK_THREAD_CPUTIME_ID), millisecondsOf(CLOCK_PROCESS_CPUTIME_ID),
          millisecondsOf(CLOCK_MONOTONIC)};
}

void CostProbe::began(Span what, std::uint64_t frame, std::uint32_t wall) {
  if (!isStage(what)) return;
  frame_ = frame;
  wall_ = wall;
  picturesEnd_.clear();
  began_ = Moment::now();
}

void CostProbe::began(Span what, NodeRef) {
  if (what == Span::Fill) fillBegan_ = Moment::now();
}

/// Cull counts after it has written the list, and before its span ends.
void CostProbe::counted(Count what, std::uint64_t count, NodeRef) {
  if (what != Count::Seen || frame_ < from_ || wall_ >= walls_) return;
  FrameCost& cost = frames_[frame_].cost;
  cost.walls.resize(walls_);
  const double all = static_cast<double>(count), first = static_cast<double>(portion_);
  cost.walls[wall_].cullBesideDraw = all > first ? fill_ * (1 - first / all) : 0;
}

void CostProbe::ended(Span what) {
  const bool picture = what == Span::LeftEye || what == Span::RightEye;
  if (!isStage(what) && !picture && what != Span::Fill) return;
  const Moment now = Moment::now();
  if (what == Span::Fill) fill_ = now.own - fillBegan_.own;
  if (picture) picturesEnd_.push_back(now);
  if (isStage(what)) endStage(what, now);
}

void CostProbe::endStage(Span what, const Moment& now) {
  if (frame_ < from_) return;
  Seen& seen = frames_[frame_];
  FrameCost& cost = seen.cost;
  cost.walls.resize(walls_);
  const double own = now.own - began_.own;
  const double others = std::max(0.0, now.process - began_.process - own);
  if (what == Span::App) {
    cost.app = own;
    cost.appHelpers = others;
  }
  if (what == Span::Swap) {
    cost.swap = own;
    seen.swapped = true;
  }
  if (wall_ >= walls_) return;
  if (what == Span::Cull) cost.walls[wall_].cull = own;
  if (what == Span::Draw) {
    endDraw(cost.walls[wall_], now);
    ++seen.drawn;
  }
}

/// Work after the last picture is counted with it.
void CostProbe::endDraw(WallCost& wall, const Moment& now) {
  const auto othersSince = [](const Moment& from, const Moment& to) {
    return std::max(0.0, to.process - from.process - (to.own - from.own));
  };
  if (picturesEnd_.empty()) picturesEnd_.push_back(now);
  inTurn_ += othersSince(began_, picturesEnd_.back());
  rastered_ += othersSince(began_, now);
  picturesEnd_.back() = now;
  // The clocks of time and of work differ by microseconds: a short wait would seem to have had hundreds of threads.
  const double processors = std::max(1u, std::thread::hardware_concurrency());
  Moment from = began_;
  for (const Moment& end : picturesEnd_) {
    const double own = end.own - from.own, raster = othersSince(from, end);
    const double waited = end.time - from.time - own;
    wall.pictures.push_back({own, raster, waited > 0 ? std::min(raster / waited, processors) : 1});
    from = end;
  }
}

std::map<std::uint64_t, FrameCost> CostProbe::costs() const {
  std::map<std::uint64_t, FrameCost> complete;
  for (const auto& [frame, seen] : frames_)
    if (seen.swapped && seen.drawn == walls_) complete.emplace(frame, seen.cost);
  return complete;
}

void assumeUndisturbed(std::vector<FrameCost>& frames) {
  std::map<std::pair<std::size_t, std::size_t>, std::vector<double>> seen;
  const auto forEachPicture = [&](const auto& f) {
    for (FrameCost& frame : frames)
      for (std::size_t w = 0; w < frame.walls.size(); ++w)
        for (std::size_t p = 0; p < frame.walls[w].pictures.size(); ++p)
          f(frame.walls[w].pictures[p], seen[{w, p}]);
  };
  forEachPicture([](const PictureCost& picture, auto& all) { all.push_back(picture.atOnce); });
  for (auto& [where, all] : seen) std::ranges::sort(all);
  forEachPicture([](PictureCost& picture, const auto& all) { picture.atOnce = all[all.size() * 9 / 10]; });
}

std::vector<FrameCost> typicalCosts(const std::vector<std::map<std::uint64_t, FrameCost>>& runs) {
  std::map<std::uint64_t, std::vector<FrameCost>> byFrame;
  for (const auto& run : runs)
    for (const auto& [frame, cost] : run) byFrame[frame].push_back(cost);
  std::vector<FrameCost> typical;
  for (const auto& [frame, same] : byFrame) typical.push_back(middleOf(same));
  return typical;
}

std::vector<FrameCost> plannedCosts(const std::vector<std::map<std::uint64_t, FrameCost>>& runs) {
  std::vector<FrameCost> frames = typicalCosts(runs);
  assumeUndisturbed(frames);
  return frames;
}

bool wasStarved(const std::vector<FrameCost>& frames) {
  constexpr double kWorth = 1, kStarved = 0.5;
  std::vector<double> atOnce;
  for (const FrameCost& frame : frames)
    for (const WallCost& wall : frame.walls)
      for (const PictureCost& picture : wall.pictures)
        if (picture.raster >= kWorth) atOnce.push_back(picture.atOnce);
  return !atOnce.empty() && median(atOnce) < kStarved;
}

}  // namespace stadion::plan
