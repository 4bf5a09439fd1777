/// The operator's cues as input: pressed for a frame, recorded, and replayed to the same samples.

#include "engine/input/operator_device.h"

#include "engine/input/input_recorder.h"
#include "tests/fresh_folder.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

class SilentVisitor final : public InputDevice {
public:
  using InputDevice::sampleAt;
  void sampleAt(Nanoseconds showTime, InputSample& sample) override {
    sample.time = showTime;
    sample.trackers.clear();
  }
};

constexpr Nanoseconds kTick = 20'000'000;

InputSample sampled(InputDevice& device, int frame) {
  InputSample sample;
  device.sampleFrame(std::max(0, frame - 1) * kTick, frame * kTick, sample);
  return sample;
}

std::uint32_t buttonsOf(const InputSample& sample) {
  const TrackerSample* t = sample.find("operator");
  return t ? t->buttons : ~0U;
}

TEST(OperatorDevice, ACalledCueIsPressedForOneFrame) {
  SilentVisitor visitor;
  OperatorDevice device(visitor);
  EXPECT_EQ(buttonsOf(sampled(device, 0)), 0u);
  EXPECT_TRUE(device.call(3));
  EXPECT_EQ(buttonsOf(sampled(device, 1)), 4u);
  EXPECT_EQ(buttonsOf(sampled(device, 2)), 0u);
  EXPECT_FALSE(device.call(0));
  EXPECT_FALSE(device.call(33));
}

TEST(OperatorDevice, ACueCalledInEachOfTwoFramesIsPressedTwice) {
  SilentVisitor visitor;
  OperatorDevice device(visitor);
  sampled(device, 0);
  device.call(1);
  EXPECT_EQ(buttonsOf(sampled(device, 1)), 1u);
  device.call(1);
  device.call(2);
  EXPECT_EQ(buttonsOf(sampled(device, 2)), 2u) << "the first one is released before it is pressed again";
  EXPECT_EQ(buttonsOf(sampled(device, 3)), 1u);
}

TEST(OperatorDevice, AReplayGivesTheVerySameSamples) {
  const FreshFolder folder;
  const std::string file = (folder.path() / "visit.input").string();
  SilentVisitor visitor;
  OperatorDevice device(visitor);
  InputRecorder recorder(file, 50);
  std::vector<InputSample> live;
  for (int frame = 0; frame < 12; ++frame) {
    if (frame == 4 || frame == 5 || frame == 9) device.call(static_cast<std::uint32_t>(frame));
    live.push_back(sampled(device, frame));
    recorder.record(live.back());
  }
  ASSERT_FALSE(recorder.commit());
  Diagnostics findings;
  const auto log = loadInputLog(file, findings);
  ASSERT_TRUE(log);
  InputReplay replay(*log);
  for (int frame = 0; frame < 12; ++frame) {
    const InputSample again = sampled(replay, frame);
    ASSERT_EQ(again.trackers.size(), 1u);
    EXPECT_EQ(again.trackers[0], live[static_cast<std::size_t>(frame)].trackers[0]) << frame;
  }
}

}  // namespace
}  // namespace stadion
