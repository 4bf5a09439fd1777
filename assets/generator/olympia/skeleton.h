#pragma once
/// The bones of a person, and clips from motions.
///
/// Frames   of the person's place, in which the first bone, "root", stays. Joints as motion.h has them. A
///          helper bone turns half as far as a joint and carries the skin there, so that the skin keeps its
///          volume; a wrist's helper shares the turn of the hand along the forearm.

#include "assets/generator/craft/figure_model.h"
#include "assets/generator/craft/sculpt.h"
#include "assets/generator/olympia/motion.h"

#include <functional>
#include <string>
#include <vector>

namespace stadion::assets {

constexpr int boneOf(Joint joint) {
  return 1 + static_cast<int>(joint);
}

/// The bones at rest: standing with legs apart, the arms away from the body.
std::vector<BoneModel> personBones();
/// The rest places of the joints' bones in the person's place, by bone.
std::vector<Pose> personAtRest();

/// The bones that carry a vertex of this clay at rest.
Carriers carriersAt(const Clay& clay, Point p, double over = 0.02);
/// From the shares of the joints' bones, by bone; helpers take theirs.
Carriers carriersOf(std::vector<double> shares);

/// What of a motion differs from its performance.
using Change = std::function<void(Figure&, double time)>;
ClipModel clipOf(const std::string& name, const Performance& performance, const Change& change = {});

}  // namespace stadion::assets
