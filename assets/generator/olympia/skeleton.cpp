#include "assets/generator/olympia/skeleton.h"

#include "assets/generator/olympia/joints.h"

namespace stadion::assets {
namespace {

constexpr double kClipSample = 1.0 / 30;  // [s]

struct BoneName {
  const char *name, *parent;
};
// "root", then in the order of Joint.
constexpr BoneName kBoneNames[] = {{"root", ""},
                                   {"pelvis", "root"},
                                   {"chest", "pelvis"},
                                   {"head", "chest"},
                                   {"right_arm", "chest"},
                                   {"right_forearm", "right_arm"},
                                   {"right_hand", "right_forearm"},
                                   {"left_arm", "chest"},
                                   {"left_forearm", "left_arm"},
                                   {"left_hand", "left_forearm"},
                                   {"right_thigh", "pelvis"},
                                   {"right_shin", "right_thigh"},
                                   {"right_foot", "right_shin"},
                                   {"left_thigh", "pelvis"},
                                   {"left_shin", "left_thigh"},
                                   {"left_foot", "left_shin"}};

struct HelperName {
  const char* name;
  Joint joint;
};
constexpr HelperName kHelpers[] = {{"waist", Joint::Chest},
                                   {"neck", Joint::Head},
                                   {"right_shoulder", Joint::RightArm},
                                   {"right_elbow", Joint::RightForearm},
                                   {"right_wrist", Joint::RightHand},
                                   {"left_shoulder", Joint::LeftArm},
                                   {"left_elbow", Joint::LeftForearm},
                                   {"left_wrist", Joint::LeftHand},
                                   {"right_hip", Joint::RightThigh},
                                   {"right_knee", Joint::RightShin},
                                   {"right_ankle", Joint::RightFoot},
                                   {"left_hip", Joint::LeftThigh},
                                   {"left_knee", Joint::LeftShin},
                                   {"left_ankle", Joint::LeftFoot}};
constexpr std::size_t kHelperCount = std::size(kHelpers), kFirstHelper = std::size(kBoneNames);
constexpr std::size_t kGrip = kFirstHelper + kHelperCount;

Quat tilt(const Vec3& axis, double degrees) {
  return det::expRotation(degrees * kPi / 180 * axis);
}

Vec3 sided(Point p, double side) {
  return {side * p.x, p.y, p.z};
}

/// Of the joints, in the frame of the joint before.
Figure restFigure() {
  Figure f;
  const auto set = [&](Joint joint, const Vec3& p, const Quat& q = Quat::Identity()) {
    f.joint[static_cast<std::size_t>(joint)] = {p, q};
  };
  set(Joint::Pelvis, {0, 0, joints::kHipHeight});
  set(Joint::Chest, sided(joints::kWaist, 1)), set(Joint::Head, sided(joints::kNeck, 1));
  for (const double side : {1.0, -1.0}) {
    const bool right = side > 0;
    const Quat out = tilt(Vec3::UnitY(), -40 * side), apart = tilt(Vec3::UnitY(), -7 * side);
    set(right ? Joint::RightArm : Joint::LeftArm, sided(joints::kShoulder, side), out);
    set(right ? Joint::RightForearm : Joint::LeftForearm, sided(joints::kElbow, 1), tilt(Vec3::UnitX(), 18));
    set(right ? Joint::RightHand : Joint::LeftHand, sided(joints::kWrist, 1));
    set(right ? Joint::RightThigh : Joint::LeftThigh, sided(joints::kHip, side), apart);
    set(right ? Joint::RightShin : Joint::LeftShin, sided(joints::kKnee, 1));
    set(right ? Joint::RightFoot : Joint::LeftFoot, sided(joints::kAnkle, 1), apart.conjugate());
  }
  return f;
}

/// Turns what a forearm turns about itself over to the hand.
void untwist(Figure& f, Joint forearm) {
  Pose& arm = f.joint[static_cast<std::size_t>(forearm)];
  Pose& hand = f.joint[static_cast<std::size_t>(forearm) + 1];
  const double w = arm.q.w() < 0 ? -arm.q.w() : arm.q.w(), z = arm.q.w() < 0 ? -arm.q.z() : arm.q.z();
  const double norm = std::sqrt(w * w + z * z);
  if (norm < 1e-6) return;
  const Quat twist(w / norm, 0, 0, z / norm);
  arm.q = (arm.q * twist.conjugate()).normalized();
  hand.q = (twist * hand.q).normalized();
}

/// Half of a turn; `last` keeps the sign from one moment to the next.
Quat half(Quat q, Quat& last) {
  if (q.dot(last) < 0) q.coeffs() = -q.coeffs();
  last = q;
  const Quat sum(q.w() + 1, q.x(), q.y(), q.z());
  return sum.norm() > 1e-4 ? sum.normalized() : Quat::Identity();
}

/// All bones' poses, one moment after the other.
class BonePoser {
public:
  std::vector<Pose> pose(Figure f) {
    const Pose grip = f.hand.inverse() * f.grip;
    untwist(f, Joint::RightForearm), untwist(f, Joint::LeftForearm);
    std::vector<Pose> all{Pose()};
    all.insert(all.end(), f.joint.begin(), f.joint.end());
    for (std::size_t k = 0; k < kHelperCount; ++k) {
      const auto joint = static_cast<std::size_t>(kHelpers[k].joint);
      const Quat rest = rest_.joint[joint].q;
      const Quat turned = (f.joint[joint].q * rest.conjugate()).normalized();
      all.push_back({f.joint[joint].p, (half(turned, last_[k]) * rest).normalized()});
    }
    all.push_back(grip);
    return all;
  }

private:
  const Figure rest_ = restFigure();
  std::array<Quat, kHelperCount> last_ = [] {
    std::array<Quat, kHelperCount> all;
    all.fill(Quat::Identity());
    return all;
  }();
};

std::size_t parentOf(Joint joint) {
  for (std::size_t k = 0; k < kFirstHelper; ++k)
    if (kBoneNames[static_cast<std::size_t>(boneOf(joint))].parent == std::string(kBoneNames[k].name))
      return k;
  return 0;
}

}  // namespace

std::vector<BoneModel> personBones() {
  const Figure rest = restFigure();
  std::vector<BoneModel> bones{{"root", -1, {}}};
  for (std::size_t k = 1; k < kFirstHelper; ++k)
    bones.push_back(
        {kBoneNames[k].name, static_cast<int>(parentOf(static_cast<Joint>(k - 1))), rest.joint[k - 1]});
  for (const HelperName& helper : kHelpers)
    bones.push_back({helper.name, static_cast<int>(parentOf(helper.joint)),
                     rest.joint[static_cast<std::size_t>(helper.joint)]});
  bones.push_back({"grip", boneOf(Joint::RightHand), {}});
  return bones;
}

std::vector<Pose> personAtRest() {
  std::vector<Pose> all;
  for (const BoneModel& bone : personBones())
    all.push_back(bone.parent < 0 ? bone.rest : all[static_cast<std::size_t>(bone.parent)] * bone.rest);
  return all;
}

Carriers carriersOf(std::vector<double> shares) {
  shares.resize(kGrip + 1);
  for (std::size_t k = 0; k < kHelperCount; ++k) {
    double &outer = shares[parentOf(kHelpers[k].joint)],
           &inner = shares[static_cast<std::size_t>(boneOf(kHelpers[k].joint))];
    const double both = std::min(outer, inner);
    shares[kFirstHelper + k] += 2 * both;
    outer -= both, inner -= both;
  }
  Carriers c;
  double sum = 0;
  for (std::size_t n = 0; n < 4; ++n) {
    std::size_t most = 0;
    for (std::size_t k = 1; k < shares.size(); ++k)
      if (shares[k] > shares[most]) most = k;
    c.bone[n] = shares[most] > 0 ? static_cast<int>(most) : 0;
    c.weight[n] = std::max(shares[most], 0.0);
    sum += c.weight[n];
    shares[most] = 0;
  }
  for (double& w : c.weight) w /= sum;
  return c;
}

Carriers carriersAt(const Clay& clay, Point p, double over) {
  static const std::vector<Pose> rest = personAtRest();
  std::vector<double> shares = clay.pulls(p, kFirstHelper, over);
  double sum = 0;
  for (double& s : shares) {
    if (s < 0.02) s = 0;
    sum += s;
  }
  for (double& s : shares) s /= sum;
  for (const Joint forearm : {Joint::RightForearm, Joint::LeftForearm}) {
    const auto bone = static_cast<std::size_t>(boneOf(forearm));
    const double along = -(rest[bone].inverse() * Vec3(p.x, p.y, p.z)).z();
    const double moved = shares[bone] * smoothstep(0.03, 0.25, along);
    shares[bone] -= moved, shares[bone + 1] += moved;
  }
  return carriersOf(std::move(shares));
}

ClipModel clipOf(const std::string& name, const Performance& performance, const Change& change) {
  ClipModel clip{name, {}, {}};
  BonePoser poser;
  const int count = static_cast<int>(performance.duration / kClipSample + 0.5);
  for (int i = 0; i <= count; ++i) {
    const double time = std::min(i * kClipSample, performance.duration);
    Figure figure = figureAt(performance, time);
    if (change) change(figure, time);
    clip.times.push_back(time);
    clip.poses.push_back(poser.pose(figure));
  }
  return clip;
}

}  // namespace stadion::assets
