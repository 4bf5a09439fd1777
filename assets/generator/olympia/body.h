#pragma once
/// The parts of an athlete's body, each about the joint that carries it.
///
/// Frames   as he stands with hanging arms, he looks +Y, right is +X, +Z is up. Trunk and head rise from
///          their joints, limbs hang from theirs.
/// Units    metres. He is 1.76 m tall, seven and a half heads.

#include "assets/generator/craft/part.h"

namespace stadion::assets {

/// The places of joints, in the frame of the joint before them; left ones mirrored.
namespace joints {
constexpr double kHipHeight = 0.93;              ///< of the pelvis above the ground, standing straight
constexpr Point kWaist{0, 0, 0.14};              ///< from the pelvis
constexpr Point kNeck{0, -0.005, 0.42};          ///< from the waist
constexpr Point kShoulder{0.188, -0.01, 0.345};  ///< from the waist
constexpr Point kElbow{0, 0, -0.30}, kWrist{0, 0, -0.26};
constexpr Point kHip{0.092, 0, -0.02};  ///< from the pelvis
constexpr Point kKnee{0, 0, -0.44}, kAnkle{0, 0, -0.39};
constexpr double kSole = 0.08;  ///< ankle above the ground
}  // namespace joints

enum class Hair { Dark, Fair, Bearded };

Parts pelvis();
Parts chest();
/// In cells of `step` metres: finer for figures seen from near.
Parts head(Hair hair, double step);
// Of the right side.
Parts upperArm();
Parts forearm();
Parts hand();
Parts thigh();
Parts shin();
Parts foot();

/// The other side of a part.
Parts leftOf(const Parts& parts);

/// A long robe in folds for standing figures, about the pelvis.
Parts robe(Rgb cloth, Rgb border);
/// A trumpet of bronze, 1.1 m, its mouthpiece at the origin, +Y to the bell.
Parts trumpet();

}  // namespace stadion::assets
