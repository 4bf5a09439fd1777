#include "engine/scene/pose_tracks.h"

#include "engine/maths/functions.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

bool same(const Pose& a, const Pose& b) {
  return a.p == b.p && a.q.coeffs() == b.q.coeffs();
}

/// But for rounding.
bool near(const Pose& a, const Pose& b) {
  return (a.p - b.p).norm() <= 1e-9 * (1 + a.p.norm()) && std::fabs(a.q.dot(b.q)) >= 1 - 1e-12;
}

}  // namespace

void PoseTracks::clear() {
  for (std::uint32_t i = 0; i < used_; ++i) at_[pool_[i].id] = 0;
  used_ = 0;
}

PoseTrack& PoseTracks::of(PlacementId id, const PoseKnot& first) {
  if (at_.size() <= id) at_.resize(id + std::size_t{1});
  if (at_[id] != 0) return pool_[at_[id] - 1].track;
  if (used_ == pool_.size()) pool_.emplace_back();
  Known& known = pool_[used_];
  at_[id] = ++used_;
  known.id = id;
  known.track.assign(1, first);
  return known.track;
}

const PoseTracks::Known* PoseTracks::above(PlacementId id, const Placements& placements) const {
  if (used_ == 0) return nullptr;
  for (; id != kNoPlacement; id = placements.carrier(id))
    if (id < at_.size() && at_[id] != 0) return &pool_[at_[id] - 1];
  return nullptr;
}

Pose PoseTracks::at(PlacementId id, Nanoseconds time, const Placements& placements) const {
  const Pose now = poseOf(placements.world(id));
  const Known* carrier = above(id, placements);
  if (!carrier) return now;
  const PoseTrack& way = carrier->track;
  return poseOn(way, time, Limit::After) * (way.back().X.inverse() * now);
}

Pose PoseTracks::startOf(PlacementId id, const Placements& placements) const {
  const Pose now = poseOf(placements.world(id));
  const Known* carrier = above(id, placements);
  return carrier ? carrier->track.front().X * (carrier->track.back().X.inverse() * now) : now;
}

bool PoseTracks::bends(PlacementId id, const Placements& placements) const {
  const Known* carrier = above(id, placements);
  if (!carrier) return false;
  const Eigen::Vector4d first = carrier->track.front().X.q.coeffs();
  return stadion::bends(carrier->track) ||
         std::ranges::any_of(carrier->track, [&](const PoseKnot& k) { return k.X.q.coeffs() != first; });
}

void PoseTracks::addKnots(PlacementId id, const Placements& placements,
                          std::vector<Nanoseconds>& times) const {
  if (const Known* carrier = above(id, placements))
    for (const PoseKnot& knot : carrier->track) times.push_back(knot.time);
}

bool PoseTracks::jumps(PlacementId id, Nanoseconds from, Nanoseconds to, const Placements& placements) const {
  const Known* carrier = above(id, placements);
  return carrier && std::ranges::any_of(carrier->track, [&](const PoseKnot& knot) {
           return knot.jump && knot.time > from && knot.time <= to;
         });
}

PoseTrack PoseTracks::within(PlacementId id, const Pose& before, Nanoseconds start, Nanoseconds end,
                             const Placements& placements) const {
  const Pose now = poseOf(placements.world(id));
  const Known* carrier = above(id, placements);
  const bool carried = carrier && moves(carrier->track);
  if (!carried && same(before, now)) return {};
  PoseTrack track{{start, before, false}};
  if (carried) {
    const PoseTrack& way = carrier->track;
    const bool itself = carrier->id == id;
    // A node that has not looked for some frames does not know the way before this one: it takes it as
    // straight.
    const bool late = way.front().time > start;
    const Pose X_CN1 = itself ? Pose{} : way.back().X.inverse() * now;
    const Pose X_CN0 = itself ? Pose{} : late ? X_CN1 : way.front().X.inverse() * before;
    const auto at = [&](Nanoseconds time, const Pose& X, double part = 0) {  // so many ns later
      const double since = static_cast<double>(time - start) + part;
      const double s = end > start ? since / static_cast<double>(end - start) : 1;
      return itself ? X : X * det::interpolate(X_CN0, X_CN1, s);
    };
    const PoseKnot* last = nullptr;
    for (const PoseKnot& knot : way) {
      // What hangs off something that turns goes round, not straight.
      const bool turns = last && !knot.jump && !knot.between && knot.X.q.coeffs() != last->X.q.coeffs();
      if (turns && !itself)
        for (Nanoseconds t = (last->time / kChord + 1) * kChord; t < knot.time; t += kChord)
          track.push_back({t, at(t, poseOn(way, t, Limit::Before)), false});
      const Pose X = at(knot.time, knot.X);
      std::optional<CurvePoses> between;
      if (last && knot.between) {
        between.emplace();
        for (std::size_t k = 0; k < between->size(); ++k) {
          const QuarterTime quarter = QuarterTime::of(last->time, knot.time, k);
          (*between)[k] = at(quarter.time, (*knot.between)[k], quarter.part);
        }
      }
      if (last || !near(X, before)) track.push_back({knot.time, X, knot.jump || (!last && !late), between});
      last = &knot;
    }
    if (track.back().time >= end || near(track.back().X, now)) return track;
  }
  track.push_back({end, now, track.back().time >= end});
  return track;
}

}  // namespace stadion
