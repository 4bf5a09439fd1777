#pragma once
/// The places of a person's joints.
///
/// Frames   as he stands with hanging arms, he looks +Y, right is +X, +Z is up. Each is in the frame of the
///          joint before it; left ones are mirrored.
/// Units    metres. A person is 1.76 m tall.

#include "assets/generator/craft/geometry.h"

namespace stadion::assets::joints {

constexpr double kHipHeight = 0.93;              ///< of the pelvis above the ground, standing straight
constexpr Point kWaist{0, 0, 0.14};              ///< from the pelvis
constexpr Point kNeck{0, -0.005, 0.42};          ///< from the waist
constexpr Point kShoulder{0.188, -0.01, 0.345};  ///< from the waist
constexpr Point kElbow{0, 0, -0.30}, kWrist{0, 0, -0.26};
constexpr Point kHip{0.092, 0, -0.02};  ///< from the pelvis
constexpr Point kKnee{0, 0, -0.44}, kAnkle{0, 0, -0.39};
constexpr double kSole = 0.08;  ///< ankle above the ground

}  // namespace stadion::assets::joints
