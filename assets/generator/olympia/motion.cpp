#include "assets/generator/olympia/motion.h"

#include "assets/generator/olympia/joints.h"

namespace stadion::assets {
namespace {

constexpr double kDegree = kPi / 180;

Vec3 vec(Point p) {
  return {p.x, p.y, p.z};
}

Quat about(const Vec3& axis, double degrees) {
  return det::expRotation(degrees * kDegree * axis);
}

/// To the left, forward, to the right side.
Quat turn(Point t) {
  return about(Vec3::UnitZ(), t.x) * about(Vec3::UnitX(), -t.y) * about(Vec3::UnitY(), t.z);
}

/// Returns the rotation with the Z axis `z` and the Y axis as near `y` as possible.
Quat facing(const Vec3& z, const Vec3& y) {
  Mat3 m;
  m.col(2) = z.normalized();
  m.col(0) = y.cross(m.col(2)).normalized();
  m.col(1) = m.col(2).cross(m.col(0));
  return Quat(m).normalized();
}

/// Two bones from `root` to `end`, bent towards `pole`: the rotations of both, which hang along -Z. Knees
/// look along their bones' +Y, elbows along -Y.
struct Limb {
  Quat upper, lower;
};

Limb bent(const Vec3& root, const Vec3& end, const Vec3& pole, double a, double b, double side) {
  const Vec3 way = end - root;
  const double d = std::clamp(way.norm(), 0.15 * (a + b), 0.9995 * (a + b));
  const Vec3 u = way.normalized();
  const Vec3 p = (pole - pole.dot(u) * u).normalized();
  const double along = (a * a - b * b + d * d) / (2 * d);
  const double off = std::sqrt(std::max(a * a - along * along, 0.0));
  const Vec3 joint = along * u + off * p;
  // Both turn about the same hinge.
  const Quat upper = facing(-joint, side * p);
  const Vec3 hinge = upper * Vec3::UnitX(), z = joint - d * u;
  return {upper, facing(z, z.cross(hinge))};
}

struct FootPose {
  Vec3 ankle;
  double yaw, pitch;  ///< pitch: heel up
};

constexpr double kBall = 0.115;  // of the foot, before the ankle

Vec3 ankleOn(Point sole, double yaw, double pitch) {
  const Quat q = about(Vec3::UnitZ(), yaw) * about(Vec3::UnitX(), -pitch);
  const Vec3 ball = vec(sole) + about(Vec3::UnitZ(), yaw) * Vec3(0, kBall, 0);
  return ball + q * Vec3(0, -kBall, joints::kSole);
}

/// A foot that stands, its heel up as far as the hip demands it.
FootPose standing(Point sole, double yaw, const Vec3& hip) {
  const double reach = 0.995 * (-joints::kKnee.z - joints::kAnkle.z);
  double pitch = 0;
  while (pitch < 75 && (hip - ankleOn(sole, yaw, pitch)).norm() > reach) pitch += 0.5;
  return {ankleOn(sole, yaw, pitch), yaw, pitch};
}

FootPose footAt(const Foot& foot, double time, const Vec3& hip) {
  Point sole = foot.start;
  double yaw = foot.yaw;
  for (const Step& step : foot.steps) {
    if (time >= step.land) {
      sole = step.to, yaw = step.yaw;
      continue;
    }
    if (time <= step.lift) break;
    const double s = (time - step.lift) / (step.land - step.lift), eased = smoothstep(0, 1, s);
    const double turning = mix(yaw, step.yaw, eased);
    const FootPose from = standing(sole, yaw, hip), to = standing(step.to, step.yaw, hip);
    if (!step.by.empty()) {
      std::vector<Track::Key> keys{{step.lift, {from.ankle.x(), from.ankle.y(), from.ankle.z()}}};
      keys.insert(keys.end(), step.by.begin(), step.by.end());
      keys.push_back({step.land, {to.ankle.x(), to.ankle.y(), to.ankle.z()}});
      return {vec(Track(keys).at(time)), turning, mix(48.0, to.pitch, smoothstep(0.75, 1, s))};
    }
    Vec3 ankle = from.ankle + eased * (to.ankle - from.ankle);
    ankle.z() += step.height * 4 * s * (1 - s) * mix(1.3, 0.7, s);
    const double swing = 260 * step.height * s * (1 - s) * (1 - s);
    return {ankle, turning, mix(from.pitch, to.pitch, eased) + std::min(swing * 1.6, 40.0)};
  }
  return standing(sole, yaw, hip);
}

class Poser {
public:
  Poser(const Performance& performance, double time) : performance_(performance), time_(time) {}

  Figure pose() {
    const Performance& p = performance_;
    X_pelvis_ = {vec(p.pelvis.at(time_)), turn(p.pelvisTurn.at(time_))};
    set(Joint::Pelvis, X_pelvis_);
    const Pose waist{vec(joints::kWaist), turn(p.chestTurn.at(time_))};
    set(Joint::Chest, waist);
    X_chest_ = X_pelvis_ * waist;
    const Point gaze = p.gaze.at(time_);
    const Quat looks = X_chest_.q.conjugate() * turn({gaze.x, gaze.y, 0});
    Vec3 neck = det::logRotation(looks);
    if (neck.norm() > 75 * kDegree) neck *= 75 * kDegree / neck.norm();
    set(Joint::Head, {vec(joints::kNeck), det::expRotation(neck)});
    arm(Joint::RightArm, 1, p.rightWrist, p.rightElbow, p.rightTwist.at(time_).x);
    arm(Joint::LeftArm, -1, p.leftWrist, p.leftElbow, 0);
    leg(Joint::RightThigh, 1, p.rightFoot);
    leg(Joint::LeftThigh, -1, p.leftFoot);
    return figure_;
  }

private:
  void set(Joint joint, const Pose& pose) { figure_.joint[static_cast<std::size_t>(joint)] = pose; }

  void arm(Joint first, double side, const Track& wrist, const Track& elbow, double twist) {
    const auto upper = static_cast<std::size_t>(first);
    const Vec3 shoulder = vec(times({side, 1, 1}, joints::kShoulder));
    const Limb limb =
        bent(shoulder, vec(wrist.at(time_)), vec(elbow.at(time_)), -joints::kElbow.z, -joints::kWrist.z, -1);
    const Quat lower = limb.lower * about(Vec3::UnitZ(), twist);
    figure_.joint[upper] = {shoulder, limb.upper};
    figure_.joint[upper + 1] = {vec(joints::kElbow), limb.upper.conjugate() * lower};
    figure_.joint[upper + 2] = {vec(joints::kWrist), Quat::Identity()};
    if (side < 0) return;
    const Pose hand = figure_.hand =
        X_chest_ * figure_.joint[upper] * figure_.joint[upper + 1] * figure_.joint[upper + 2];
    const Point aim = performance_.aim.at(time_);
    figure_.grip = {hand * Vec3(-0.028, 0.012, -0.085),
                    about(Vec3::UnitZ(), 90 + aim.y) * about(Vec3::UnitY(), -aim.x)};
  }

  void leg(Joint first, double side, const Foot& foot) {
    const auto upper = static_cast<std::size_t>(first);
    const Vec3 hip = vec(times({side, 1, 1}, joints::kHip));
    const Vec3 placed = X_pelvis_ * hip;
    const FootPose sole = footAt(foot, time_, placed);
    const Quat toes = about(Vec3::UnitZ(), sole.yaw);
    // The knee looks between where the pelvis and the toes do.
    const Vec3 ahead = (X_pelvis_.q * Vec3(0.12 * side, 1, 0.1)).normalized() + toes * Vec3(0, 1, 0.15);
    const Limb limb = bent(placed, sole.ankle, ahead, -joints::kKnee.z, -joints::kAnkle.z, 1);
    figure_.joint[upper] = {hip, X_pelvis_.q.conjugate() * limb.upper};
    figure_.joint[upper + 1] = {vec(joints::kKnee), limb.upper.conjugate() * limb.lower};
    figure_.joint[upper + 2] = {vec(joints::kAnkle),
                                limb.lower.conjugate() * toes * about(Vec3::UnitX(), -sole.pitch)};
  }

  const Performance& performance_;
  double time_;
  Pose X_pelvis_, X_chest_;
  Figure figure_;
};

}  // namespace

Point Track::slope(std::size_t k) const {
  if (k == 0 || k + 1 == keys_.size()) return {0, 0, 0};
  const Key &a = keys_[k - 1], &b = keys_[k], &c = keys_[k + 1];
  const double h0 = b.time - a.time, h1 = c.time - b.time;
  // The harmonic mean of both sides' slopes where they agree in sign (Fritsch and Butland), else flat.
  const auto one = [&](double u, double v, double w) {
    const double d0 = (v - u) / h0, d1 = (w - v) / h1;
    if (d0 * d1 <= 0) return 0.0;
    const double w0 = 2 * h1 + h0, w1 = h1 + 2 * h0;
    return (w0 + w1) / (w0 / d0 + w1 / d1);
  };
  return {one(a.value.x, b.value.x, c.value.x), one(a.value.y, b.value.y, c.value.y),
          one(a.value.z, b.value.z, c.value.z)};
}

Point Track::at(double time) const {
  if (time <= keys_.front().time) return keys_.front().value;
  if (time >= keys_.back().time) return keys_.back().value;
  std::size_t k = 0;
  while (keys_[k + 1].time <= time) ++k;
  const double h = keys_[k + 1].time - keys_[k].time, s = (time - keys_[k].time) / h, s2 = s * s, s3 = s2 * s;
  return (2 * s3 - 3 * s2 + 1) * keys_[k].value + (s3 - 2 * s2 + s) * h * slope(k) +
         (-2 * s3 + 3 * s2) * keys_[k + 1].value + (s3 - s2) * h * slope(k + 1);
}

Figure figureAt(const Performance& performance, double time) {
  return Poser(performance, time).pose();
}

}  // namespace stadion::assets
