#pragma once
/// A visitor at a desk: keyboard, mouse and gamepad stand in for head, wand and joypad.
///
/// The head stands on the rig's floor and looks somewhere; the hand with the wand is held before the body and
/// points where the head looks. Dragging moves the hand, and the mouse buttons are the wand's. The hand
/// follows what the mouse says within a few hundredths of a second and never faster than a throw, since a
/// pointer goes in jumps and a hand does not: what jumps would be a device that was lost (see input_log.h).
///
/// Frames   rig space: +X right, +Y forward, +Z up. Units  metres, radians, seconds.
/// Threads  what the user does comes from one thread, samples are taken on another (App).
/// Errors   none: whatever comes, poses are finite and inside the reach of an arm.

#include "engine/input/input_device.h"

#include <array>
#include <mutex>
#include <optional>
#include <string>

namespace stadion {

class DeskVisitor final : public InputDevice {
public:
  explicit DeskVisitor(double eyeHeight = 1.7);

  // What the user does.

  /// Turns the head by so much: to the right, and up [rad].
  void look(double right, double up);
  /// Moves the hand, in the direction in which the head looks: right, forward, up [m].
  void moveHand(const Vec3& by);
  /// Walks about on the rig as long as it lasts: right, forward, up, from -1 to 1.
  void setStep(const Vec3& direction);
  /// The joypad's axes: 0 turns (right is positive), 1 goes forward.
  void setAxis(std::size_t axis, double value);
  /// Presses or lets go a button of the wand, 0 to 3.
  void setButton(std::uint32_t button, bool down);
  /// A gamepad's own axes and buttons; they add to those of the keyboard.
  void setGamepad(const std::array<double, kTrackerAxes>& axes, std::uint32_t buttons);
  /// Everything that is held is let go.
  void letGo();
  /// Back to the middle, looking ahead.
  void reset();

  // InputDevice

  using InputDevice::sampleAt;
  void sampleAt(Nanoseconds showTime, InputSample& sample) override;
  /// As an input log with one record a frame says it: axes go evenly from what they were to what they are.
  void sampleFrame(Nanoseconds start, Nanoseconds end, InputSample& sample) override;
  /// Looking about goes on while the show stands still; walking and the hand do not.
  bool sampleNow(InputSample& sample) override;
  /// Let go, the head eases back to where it has been turned meanwhile. The hand follows it unfrozen.
  void freezeHead(bool frozen) override;
  void restart() override;

private:
  /// What moves at a speed of its own, carried to the sample's time.
  void advance(double seconds);
  Quat heading() const;
  Pose head() const;
  /// The one that is told of: frozen, easing back, or as it is.
  Pose headTold() const;
  void fill(Nanoseconds showTime, InputSample& sample) const;
  Vec3 handWanted() const;

  std::mutex mutex_;
  double eyeHeight_;
  Vec3 feet_ = Vec3::Zero(), step_ = Vec3::Zero();
  bool returning_ = false;      ///< to the middle
  double yaw_ = 0, pitch_ = 0;  ///< to the left, up
  Vec3 wantedHand_;             ///< from the head, in the direction in which it looks
  Vec3 hand_;                   ///< on the rig
  std::optional<Pose> frozen_;  ///< where the head stays
  Pose easesFrom_;              ///< where it stayed
  double eased_ = 1;            ///< how much of the way back it has come
  std::array<double, kTrackerAxes> axes_{}, padAxes_{};
  std::uint32_t buttons_ = 0, padButtons_ = 0;
  std::uint32_t pressed_ = 0;  ///< since the last sample: a press that is over already must be seen once
  std::uint32_t letGo_ = 0;    ///< and so must a release that is followed by another press
  std::uint32_t down_ = 0;     ///< in the last sample
  /// Let go and pressed again since then: up in this sample, down in the next.
  std::uint32_t pressedAnew() const { return down_ & letGo_ & pressed_; }
  Nanoseconds sampled_ = -1;
  std::optional<ControlKnot> told_;  ///< what the wand's buttons and axes were in the last frame; App's own
};

}  // namespace stadion
