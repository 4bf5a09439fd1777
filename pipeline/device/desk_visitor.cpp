#include "pipeline/device/desk_visitor.h"

#include "engine/input/tracker_names.h"
#include "engine/maths/angles.h"
#include "engine/maths/functions.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

const Vec3 kHandAtRest{0.22, 0.45, -0.4};  ///< from the head [m]
constexpr double kReach = 0.9;             ///< of an arm, from the head [m]
constexpr double kHandTime = 0.03;         ///< time constant of the hand's motion [s]
constexpr double kHandSpeed = 14;          ///< at most [m/s]
constexpr double kEaseBack = 0.5;          ///< duration, after the head was frozen [s]
constexpr double kStepSpeed = 1.2;         ///< [m/s]
constexpr double kReturnSpeed = 5;         ///< [m/s]
constexpr double kRoom = 20;               ///< walking distance from the rig's middle, at most [m]
constexpr double kLowest = 0.2;            ///< height of the head at least [m]
constexpr double kSteepest = 1.5;          ///< [rad]

double orZero(double x) {
  return std::isfinite(x) ? x : 0;
}

Vec3 orZero(const Vec3& v) {
  return v.allFinite() ? v : Vec3(Vec3::Zero());
}

/// Limits the length of a way to `most` metres.
Vec3 notFarther(const Vec3& way, double most) {
  const double far = way.norm();
  return far > most ? Vec3(most / far * way) : way;
}

TrackerSample tracker(const char* name, const Pose& X_RT, Nanoseconds time) {
  TrackerSample t;
  t.name = name;
  t.X_RT = X_RT;
  t.stamp = time;
  return t;
}

}  // namespace

DeskVisitor::DeskVisitor(double eyeHeight)
    : eyeHeight_(eyeHeight), wantedHand_(kHandAtRest), hand_(handWanted()) {}

void DeskVisitor::turn(double right, double up) {
  const std::lock_guard lock(mutex_);
  constexpr double kWhole = 2 * kPi;
  yaw_ -= std::clamp(orZero(right), -kWhole, kWhole);
  if (std::fabs(yaw_) > kWhole) yaw_ -= std::copysign(kWhole, yaw_);
  pitch_ = std::clamp(pitch_ + orZero(up), -kSteepest, kSteepest);
}

void DeskVisitor::moveHand(const Vec3& by) {
  const std::lock_guard lock(mutex_);
  wantedHand_ += orZero(by);
  if (const double far = wantedHand_.norm(); far > kReach) wantedHand_ *= kReach / far;
}

void DeskVisitor::setStep(const Vec3& direction) {
  const std::lock_guard lock(mutex_);
  step_ = orZero(direction).cwiseMax(-1).cwiseMin(1);
  if (!step_.isZero()) returning_ = false;
}

void DeskVisitor::setAxis(std::size_t axis, double value) {
  const std::lock_guard lock(mutex_);
  if (axis < axes_.size()) axes_[axis] = std::clamp(orZero(value), -1.0, 1.0);
}

void DeskVisitor::setButton(std::uint32_t button, bool down) {
  if (button > 31) return;
  const std::lock_guard lock(mutex_);
  const std::uint32_t bit = 1u << button;
  buttons_ = down ? buttons_ | bit : buttons_ & ~bit;
  (down ? pressed_ : letGo_) |= bit;
}

void DeskVisitor::setGamepad(const std::array<double, kTrackerAxes>& axes, std::uint32_t buttons) {
  const std::lock_guard lock(mutex_);
  for (std::size_t i = 0; i < axes.size(); ++i) padAxes_[i] = std::clamp(orZero(axes[i]), -1.0, 1.0);
  pressed_ |= buttons & ~padButtons_;
  letGo_ |= padButtons_ & ~buttons;
  padButtons_ = buttons;
}

void DeskVisitor::letGo() {
  const std::lock_guard lock(mutex_);
  buttons_ = 0;
  axes_ = {};
  step_ = Vec3::Zero();
}

void DeskVisitor::reset() {
  const std::lock_guard lock(mutex_);
  returning_ = true;
  yaw_ = pitch_ = 0;
  wantedHand_ = kHandAtRest;
}

Quat DeskVisitor::heading() const {
  return det::expRotation(Vec3(0, 0, yaw_));
}

Pose DeskVisitor::head() const {
  const Vec3 p = feet_ + Vec3(0, 0, eyeHeight_);
  return {p, (heading() * det::expRotation(Vec3(pitch_, 0, 0))).normalized()};
}

Pose DeskVisitor::headTold() const {
  if (frozen_) return *frozen_;
  return eased_ < 1 ? det::interpolate(easesFrom_, head(), eased_ * eased_ * (3 - 2 * eased_)) : head();
}

void DeskVisitor::freezeHead(bool frozen) {
  const std::lock_guard lock(mutex_);
  if (frozen == frozen_.has_value()) return;
  if (frozen) {
    frozen_ = headTold();
  } else {
    easesFrom_ = *frozen_;
    eased_ = 0;
    frozen_.reset();
  }
}

void DeskVisitor::restart() {
  const std::lock_guard lock(mutex_);
  sampled_ = -1;
  pressed_ = letGo_ = down_ = 0;
  eased_ = 1;
  frozen_.reset();
  told_.reset();
}

Vec3 DeskVisitor::handWanted() const {
  return head().p + heading() * wantedHand_;
}

void DeskVisitor::advance(double seconds) {
  eased_ = std::min(1.0, eased_ + seconds / kEaseBack);
  feet_ += returning_ ? notFarther(-feet_, kReturnSpeed * seconds)
                      : Vec3(kStepSpeed * seconds * (heading() * step_));
  feet_ = feet_.cwiseMax(Vec3(-kRoom, -kRoom, kLowest - eyeHeight_)).cwiseMin(Vec3(kRoom, kRoom, 1));
  const double share = 1 - det::exp(-seconds / kHandTime);
  hand_ += notFarther(share * (handWanted() - hand_), kHandSpeed * seconds);
}

void DeskVisitor::sampleAt(Nanoseconds showTime, InputSample& sample) {
  const std::lock_guard lock(mutex_);
  // Time in a long halt does not count, since the visitor could not walk.
  if (sampled_ >= 0 && showTime > sampled_) advance(std::min(toSeconds(showTime - sampled_), 0.25));
  sampled_ = showTime;
  fill(showTime, sample);
  pressed_ = newlyPressed();
  letGo_ = 0;
  down_ = sample.trackers[1].buttons;
}

void DeskVisitor::fill(Nanoseconds showTime, InputSample& sample) const {
  sample.time = showTime;
  sample.trackers = {tracker(kHeadTracker, headTold(), showTime),
                     tracker(kWandTracker, {hand_, head().q}, showTime)};
  TrackerSample& wand = sample.trackers[1];
  wand.buttons = (buttons_ | padButtons_ | pressed_) & ~newlyPressed();
  for (std::size_t i = 0; i < axes_.size(); ++i)
    wand.axes[i] = static_cast<float>(std::clamp(axes_[i] + padAxes_[i], -1.0, 1.0));
}

bool DeskVisitor::sampleNow(InputSample& sample) {
  const std::lock_guard lock(mutex_);
  fill(std::max<Nanoseconds>(sampled_, 0), sample);
  return true;
}

void DeskVisitor::sampleFrame(Nanoseconds start, Nanoseconds end, InputSample& sample) {
  sampleAt(end, sample);
  TrackerSample& wand = sample.trackers[1];
  const ControlKnot now{start, wand.buttons, wand.axes};
  wand.controls = {told_.value_or(now)};
  wand.controls.front().time = start;
  told_ = now;
}

}  // namespace stadion
