#include "engine/input/input_recorder.h"

#include <cmath>

namespace stadion {
namespace {

/// What the log can hold of the tracker at that time.
InputStamp stampOf(const TrackerSample& tracker, Nanoseconds time) {
  InputStamp stamp;
  stamp.time = time;
  const double squared = tracker.X_RT.q.squaredNorm();
  stamp.valid = tracker.valid && tracker.X_RT.finite() && tracker.X_RT.p.cwiseAbs().maxCoeff() <= 1e6 &&
                squared > 0.25 && squared < 4;
  stamp.controlsOnly = tracker.controlsOnly && !tracker.valid;
  stamp.X_RT = tracker.X_RT;
  if (std::fabs(squared - 1) > 1e-12) stamp.X_RT.q.normalize();
  stamp.buttons = tracker.buttons;
  stamp.axes = tracker.axes;
  for (float& axis : stamp.axes) axis = axis > 1 ? 1.0f : axis < -1 ? -1.0f : axis == axis ? axis : 0.0f;
  return stamp;
}

/// A device may give a tracker any name; a log has names of one plain word.
std::string logName(const std::string& name) {
  std::string plain = name.substr(0, 32);
  for (char& c : plain) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    if (!letter && c != '-' && c != '_' && c != '.') c = '_';
  }
  if (plain.empty() || plain[0] == '-' || plain[0] == '.') plain.insert(plain.begin(), '_');
  return plain.substr(0, 32);
}

}  // namespace

InputRecorder::InputRecorder(const std::string& path, double rate)
    : file_(path, AtomicFile::Unfinished::KeepsLines), rate_(rate) {
  file_.write(inputLogHeading(rate));
}

void InputRecorder::frame(const TimeSignature& now) {
  if (rate_ == 0) return;
  if (!expected_) expected_.emplace(rate_);
  const bool onTick = expected_->next().time == now.time;
  if (!onTick) {
    file_.write(formatFrameTime(now.frame, now.time));
    expected_.emplace(rate_, now);
  }
  for (const DegradationDecision& d : now.decisions) file_.write(formatDegradation(now.frame, d));
  lastFrame_ = now;
  lastIsWritten_ = !onTick || now.frame == 0;
}

void InputRecorder::lateLoad(std::uint32_t number, Nanoseconds time) {
  if (rate_ != 0) file_.write(formatLateLoad(number, time));
}

void InputRecorder::order(std::uint64_t frame, const OperatorCommand& order) {
  if (rate_ != 0) file_.write(formatOrder(frame, order));
}

std::optional<Diagnostic> InputRecorder::commit() {
  // Lets a replay end with the run, whatever the trackers sent.
  if (!lastIsWritten_) file_.write(formatFrameTime(lastFrame_.frame, lastFrame_.time));
  lastIsWritten_ = true;
  return file_.commit();
}

void InputRecorder::record(const InputSample& sample) {
  for (const TrackerSample& tracker : sample.trackers) record(tracker, sample.time);
}

void InputRecorder::record(const TrackerSample& tracker, Nanoseconds time) {
  for (const PoseKnot& knot : tracker.knots) recordKnot(tracker, knot, time);
  if (tracker.controlsOnly) recordControls(tracker, time);
  write(tracker, time);
}

/// Of a corner only the pose is known; buttons and axes are as the controls of that time say, else as they
/// were.
void InputRecorder::recordKnot(TrackerSample tracker, const PoseKnot& knot, Nanoseconds end) {
  if (const auto last = last_.find(logName(tracker.name)); last != last_.end()) {
    tracker.buttons = last->second.buttons;
    tracker.axes = last->second.axes;
    tracker.valid = tracker.controlsOnly = false;
    if (knot.jump && last->second.valid) write(tracker, knot.time - 1);
  }
  for (const ControlKnot& c : tracker.controls)
    if (c.time == knot.time) {
      tracker.buttons = c.buttons;
      tracker.axes = c.axes;
    }
  tracker.X_RT = knot.X;
  tracker.valid = true;
  if (knot.time < end) write(tracker, knot.time);
}

/// Without a pose there are no corners that the changes inside the frame could be written with.
void InputRecorder::recordControls(TrackerSample tracker, Nanoseconds end) {
  const std::vector<ControlKnot> controls = std::move(tracker.controls);
  for (std::size_t i = 0; i < controls.size() && controls[i].time < end; ++i) {
    const bool jumps = i + 1 < controls.size() && controls[i + 1].time == controls[i].time;
    if (jumps) continue;  // the later one says what is from then on
    tracker.buttons = controls[i].buttons;
    tracker.axes = controls[i].axes;
    write(tracker, controls[i].time);
  }
}

void InputRecorder::write(const TrackerSample& tracker, Nanoseconds time) {
  const std::string name = logName(tracker.name);
  if (time < 0 || (last_.size() == InputLog::kMaxTrackers && !last_.contains(name))) return;
  Last& last = last_[name];
  if (time <= last.time) return;
  const InputStamp stamp = stampOf(tracker, time);
  // A tracker that stays lost needs no second line.
  const bool hasControls = stamp.valid || stamp.controlsOnly;
  if (hasControls || last.hasControls) file_.write(formatRecord(name, stamp));
  last = {time, stamp.valid, hasControls, stamp.buttons, stamp.axes};
}

}  // namespace stadion
