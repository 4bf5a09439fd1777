#pragma once
/// An athlete's motion: the places of his pelvis, hands and feet over time, and the resulting turns of the
/// joints.
///
/// Frames   of the athlete's place: he looks +Y, right is +X, +Z is up, the earth at z = 0. Wrists are given
///          in the chest's frame (about the waist), so that they move with the trunk.
/// Units    metres, seconds, degrees.

#include "assets/generator/craft/geometry.h"

#include "engine/maths/maths.h"

namespace stadion::assets {

/// A value over time: through its keys without overshooting, flat at the highest and the lowest.
class Track {
public:
  struct Key {
    double time;
    Point value;
  };
  Track(std::vector<Key> keys) : keys_(std::move(keys)) {}
  Point at(double time) const;

private:
  Point slope(std::size_t key) const;
  std::vector<Key> keys_;
};

/// A foot leaves the ground and comes down elsewhere.
struct Step {
  double lift, land;
  Point to;        ///< of the sole below the ankle
  double yaw = 0;  ///< where the toes point, to the left
  double height = 0.12;
  std::vector<Track::Key> by = {};  ///< instead of an arc: places of the ankle
};

struct Foot {
  Point start;
  double yaw;
  std::vector<Step> steps;
};

struct Performance {
  double duration, release;
  Track pelvis;      ///< place
  Track pelvisTurn;  ///< to the left, forward, to the right side
  Track chestTurn;   ///< likewise, relative to the pelvis
  Track gaze;        ///< of the head: to the left, down; relative to the place
  Track rightWrist, leftWrist;
  Track rightElbow, leftElbow;  ///< their directions, in the chest's frame
  Track rightTwist;             ///< of the forearm: x to the left, seen from the elbow
  Foot rightFoot, leftFoot;
  Track aim;  ///< of the held object: elevation, to the left
};

enum class Joint {
  Pelvis,
  Chest,
  Head,
  RightArm,
  RightForearm,
  RightHand,
  LeftArm,
  LeftForearm,
  LeftHand,
  RightThigh,
  RightShin,
  RightFoot,
  LeftThigh,
  LeftShin,
  LeftFoot
};
constexpr int kJoints = 15;

/// Every joint's pose in that of the joint before it (of the pelvis: in the place).
struct Figure {
  std::array<Pose, kJoints> joint;
  Pose hand;  ///< the right one, in the place
  Pose grip;  ///< its palm in the place: +X as it aims
};

Figure figureAt(const Performance& performance, double time);

}  // namespace stadion::assets
