#pragma once
/// The contact scheme of the paper (Georgios Papaioannou, on the interactive dynamics of EVS): move, test,
/// subdivide, back up. `impact=paper` of a dynamics node.
///
/// Method   the sides move one step and are tested there. If they overlap, the step is halved until the sides
///          cannot move farther than the tolerance in what is left of it. Then the last time at which they
///          were apart is the time of the contact, and their nearest points then are its place.
/// Test     meshes by hierarchies of object-aligned boxes, as in ColDet, the collision library of the paper;
///          here FCL builds them (mesh_distance.h). A mesh is its surface and has no inside. Other shapes are
///          their own boxes: they overlap if their exact distance is negative.
/// Limits   by design. What is apart at both ends of a step is not seen: thin and fast things pass each
///          other. Touches come early, by up to the tolerance. What has got inside of a mesh leaves it
///          freely.
/// Sides    that overlap at the start touch as soon as they approach each other; else they come apart first.

#include "dynamics/collision/impact_scheme.h"
#include "dynamics/collision/touch.h"

namespace stadion {

class SteppedSearch {
public:
  /// `grid` is a time of the grid of steps. Tests are counted in `tests`.
  SteppedSearch(const Side& a, const Side& b, const ImpactScheme& scheme, double grid, std::uint64_t& tests)
      : a_(a), b_(b), scheme_(scheme), grid_(grid), tests_(tests) {}

  /// The first contact in [from, to]; nothing if none is seen.
  std::optional<Touch> first(double from, double to) const;

private:
  bool overlap(double tau) const;
  double nextStep(double tau) const;
  double motion(double from, double to) const;
  std::optional<Touch> approaching(double tau) const;
  std::optional<Touch> firstApproach(double from, double to) const;
  std::optional<Touch> backUp(double apart, double overlapping) const;

  const Side &a_, &b_;
  const ImpactScheme& scheme_;
  double grid_;
  std::uint64_t& tests_;
};

}  // namespace stadion
