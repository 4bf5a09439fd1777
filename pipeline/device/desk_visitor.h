#pragma once
/// A visitor at a desk: keyboard, mouse and gamepad replace head, wand and joypad.
///
/// The head stands on the rig's floor and looks in some direction. The hand holds the wand before the body
/// and points where the head looks. Dragging moves the hand, and the mouse buttons are the wand's. The hand
/// follows the mouse within a few hundredths of a second and never faster than a throw. A mouse pointer
/// jumps, but a hand does not: a jump would look like a lost device (see input_log.h).
///
/// Frames   rig space: +X right, +Y forward, +Z up.
/// Units    metres, radians, seconds.
/// Threads  the user's input comes from one thread, samples are taken on another (App).
/// Errors   none: for any input, poses are finite and inside the reach of an arm.

#include "engine/input/input_device.h"

#include <array>
#include <mutex>
#include <optional>
#include <string>

namespace stadion {

class DeskVisitor final : public InputDevice {
public:
  explicit DeskVisitor(double eyeHeight = 1.7);

  // The user's input.

  /// Turns the head: to the right, and up [rad].
  void turn(double right, double up);
  /// Moves the hand, relative to the direction of the head: right, forward, up [m].
  void moveHand(const Vec3& by);
  /// Walks on the rig until it is set to zero: right, forward, up, from -1 to 1.
  void setStep(const Vec3& direction);
  /// The joypad's axes: 0 turns (right is positive), 1 goes forward.
  void setAxis(std::size_t axis, double value);
  /// Presses or releases a button of the wand, 0 to 3.
  void setButton(std::uint32_t button, bool down);
  /// A gamepad's own axes and buttons; they add to those of the keyboard.
  void setGamepad(const std::array<double, kTrackerAxes>& axes, std::uint32_t buttons);
  /// Releases all that is held.
  void letGo();
  /// Returns to the middle, looking ahead.
  void reset();

  // InputDevice

  using InputDevice::sampleAt;
  void sampleAt(Nanoseconds showTime, InputSample& sample) override;
  /// Samples like an input log with one record a frame: axes change evenly from their last values.
  void sampleFrame(Nanoseconds start, Nanoseconds end, InputSample& sample) override;
  /// Looking around goes on while the show stands still; walking and the hand do not.
  bool sampleNow(InputSample& sample) override;
  /// When the head is released, it eases to its current direction. The hand follows the unfrozen head.
  void freezeHead(bool frozen) override;
  void restart() override;

private:
  /// Advances the motions that have a speed of their own to the sample's time.
  void advance(double seconds);
  Quat heading() const;
  Pose head() const;
  /// Returns the reported head pose: frozen, easing back, or the true one.
  Pose headTold() const;
  void fill(Nanoseconds showTime, InputSample& sample) const;
  Vec3 handWanted() const;

  std::mutex mutex_;
  double eyeHeight_;
  Vec3 feet_ = Vec3::Zero(), step_ = Vec3::Zero();
  bool returning_ = false;      ///< to the middle
  double yaw_ = 0, pitch_ = 0;  ///< to the left, up
  Vec3 wantedHand_;             ///< from the head, relative to its direction
  Vec3 hand_;                   ///< on the rig
  std::optional<Pose> frozen_;  ///< the frozen head pose
  Pose easesFrom_;              ///< the last frozen pose
  double eased_ = 1;            ///< fraction of easing that is done
  std::array<double, kTrackerAxes> axes_{}, padAxes_{};
  std::uint32_t buttons_ = 0, padButtons_ = 0;
  std::uint32_t pressed_ = 0;  ///< since the last sample: a short press must be seen once
  /// Buttons released since the last sample: a short release must be seen once, too.
  std::uint32_t letGo_ = 0;
  std::uint32_t down_ = 0;  ///< in the last sample
  /// Returns the buttons released and pressed again since then: up in this sample, down in the next.
  std::uint32_t newlyPressed() const { return down_ & letGo_ & pressed_; }
  Nanoseconds sampled_ = -1;
  std::optional<ControlKnot> told_;  ///< the wand's buttons and axes in the last frame; used by App only
};

}  // namespace stadion
