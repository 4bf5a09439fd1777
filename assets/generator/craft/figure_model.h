#pragma once
/// Models with bones that play clips, and the file format they are written to.
///
/// Frames   as part.h, also for what hangs from a bone in a show. A bone's place is in the frame of the bone
///          before it, a root's in the model's.
/// Units    metres, seconds.

#include "assets/generator/craft/part.h"

#include "engine/maths/maths.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace stadion::assets {

struct BoneModel {
  std::string name;
  int parent = -1;  ///< a bone before this one; -1 = none
  Pose rest;        ///< in which the surfaces are made
};

/// The bones that carry a vertex; the sum of the weights is 1.
struct Carriers {
  std::array<int, 4> bone{};
  std::array<double, 4> weight{1, 0, 0, 0};
};

struct SkinnedPart {
  Part part;
  std::vector<Carriers> carriers;  ///< one a vertex
};

/// Poses of all bones at the same times.
struct ClipModel {
  std::string name;
  std::vector<double> times;             ///< ascending, from 0
  std::vector<std::vector<Pose>> poses;  ///< by time, then by bone
};

struct FigureModel {
  std::vector<BoneModel> bones;  ///< parents before their children; the first never moves
  std::vector<SkinnedPart> parts;
  std::vector<ClipModel> clips;
};

/// Binary glTF 2.0: one mesh with a skin of all bones. Keys that follow from their neighbours within
/// `place_error` metres and `turn_error` radians are left out.
std::string toGlb(const FigureModel& model, double place_error = 0.0015, double turn_error = 0.007);

}  // namespace stadion::assets
