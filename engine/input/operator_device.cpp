#include "engine/input/operator_device.h"

#include "engine/input/tracker_names.h"

#include <algorithm>
#include <utility>

namespace stadion {
namespace {

constexpr std::size_t kRecordsKept = 2;

}  // namespace

OperatorDevice::OperatorDevice(InputDevice& inner) : inner_(&inner) {
  log_.tracks.push_back({kOperatorTracker, {}});
}

bool OperatorDevice::call(std::uint32_t cue) {
  if (cue < 1 || cue > kMostCues) return false;
  called_ |= 1U << (cue - 1);
  return true;
}

void OperatorDevice::restart() {
  called_ = 0;
  log_.tracks.front().stamps.clear();
  inner_->restart();
}

/// A cue that was pressed in the frame before is released first.
void OperatorDevice::press(Nanoseconds time) {
  std::vector<InputStamp>& stamps = log_.tracks.front().stamps;
  const std::uint32_t before = stamps.empty() ? 0 : stamps.back().buttons;
  const std::uint32_t pressed = called_.load() & ~before;
  called_ &= ~pressed;
  InputStamp now;
  now.time = time;
  now.buttons = pressed;
  now.valid = false;
  now.controlsOnly = true;
  if (!stamps.empty() && time <= stamps.back().time) {  // the same frame again
    stamps.back().buttons |= pressed;
    return;
  }
  stamps.push_back(now);
  if (stamps.size() > kRecordsKept) stamps.erase(stamps.begin());
}

void OperatorDevice::sampleFrame(Nanoseconds start, Nanoseconds end, InputSample& sample) {
  inner_->sampleFrame(start, end, sample);
  press(end);
  log_.sampleFrame(start, end, own_);
  TrackerSample& ours = own_.trackers.front();
  const auto there = std::ranges::find(sample.trackers, ours.name, &TrackerSample::name);
  if (there == sample.trackers.end())
    sample.trackers.push_back(ours);
  else
    there->buttons |= ours.buttons;
}

}  // namespace stadion
