#include "engine/input/input_log.h"
#include "engine/input/input_recorder.h"
#include "tests/fresh_folder.h"

#include <gtest/gtest.h>

#include <unistd.h>

namespace stadion {
namespace {

InputLog logOf(const std::string& records) {
  Diagnostics findings;
  auto log = parseInputLog("stadion-input 1\n" + records, "test", findings);
  EXPECT_TRUE(log) << (findings.all().empty() ? "" : format(findings.all()[0]));
  return log.value_or(InputLog{});
}

TEST(InputControls, SayWhatButtonsAndAxesDidWithinTheFrame) {
  const InputLog log = logOf("key wand 0 0 0 0 axes 0.5\n"
                             "key wand 1.25 0 0 0 axes 1 buttons 1\n"
                             "key wand 1.5 0 0 0\n");
  InputSample sample;
  log.sampleFrame(fromSeconds(1), fromSeconds(2), sample);
  const auto& c = sample.trackers[0].controls;
  ASSERT_EQ(c.size(), 3u);
  EXPECT_EQ(c[0].time, fromSeconds(1));
  EXPECT_FLOAT_EQ(c[0].axes[0], 0.9f);
  EXPECT_EQ(c[1].time, fromSeconds(1.25));
  EXPECT_EQ(c[1].buttons, 1u);
  EXPECT_EQ(c[1].axes[0], 1.0f);
  EXPECT_EQ(c[2].time, fromSeconds(1.5));
  EXPECT_EQ(c[2].buttons, 0u);
}

TEST(InputControls, TheAxesOfALostDeviceJump) {
  const InputLog log = logOf("key wand 0 0 0 0 axes 1\nlost wand 0.5\n");
  InputSample sample;
  log.sampleFrame(0, fromSeconds(1), sample);
  const auto& c = sample.trackers[0].controls;
  ASSERT_EQ(c.size(), 3u);
  EXPECT_EQ(c[1].time, c[2].time);
  EXPECT_EQ(c[1].axes[0], 1.0f);
  EXPECT_EQ(c[2].axes[0], 0.0f);
}

TEST(InputControls, ARecordingKeepsWhatHappenedWithinFramesToTheBit) {
  const InputLog log = logOf("key wand 0 0 0 1 axes 0.5 buttons 3\n"
                             "key wand 0.123 0.1 0.2 1 turn 10 20 30 axes 1 -0.25 buttons 1 smooth\n"
                             "key wand 0.131 0.1 0.2 1 buttons 5\n"
                             "key wand 0.4 0.5 0.2 1 turn 0 0 90 axes 0.125\n");
  const FreshFolder folder;
  const std::string path = folder / "controls.input";
  std::vector<InputSample> first;
  {
    InputRecorder recorder(path);
    for (std::uint64_t n = 0; n < 30; ++n) {
      const TimeSignature now = signatureAt(n, 60);
      InputSample sample;
      log.sampleFrame(now.time - now.step, now.time, sample);
      recorder.record(sample);
      first.push_back(sample);
    }
    EXPECT_FALSE(recorder.commit());
  }
  Diagnostics findings;
  const auto again = loadInputLog(path, findings);
  unlink(path.c_str());
  ASSERT_TRUE(again);
  for (std::uint64_t n = 0; n < 30; ++n) {
    const TimeSignature now = signatureAt(n, 60);
    InputSample sample;
    again->sampleFrame(now.time - now.step, now.time, sample);
    ASSERT_EQ(sample.trackers.size(), 1u);
    EXPECT_EQ(sample.trackers[0], first[n].trackers[0]) << "frame " << n;
  }
}

TEST(InputControls, ADeviceWithoutAPoseHasRecordsOfItsOwn) {
  const InputLog log = logOf("controls pad 0\n"
                             "controls pad 1 buttons 0x5 axes 0 1\n"
                             "controls pad 2 smooth axes 0 0.5\n"
                             "lost pad 3\n");
  InputSample sample;
  log.sampleAt(fromSeconds(1.5), sample);
  const TrackerSample& pad = sample.trackers[0];
  EXPECT_TRUE(pad.controlsOnly && !pad.valid && pad.hasControls());
  EXPECT_EQ(pad.buttons, 5u);
  EXPECT_EQ(pad.axes[1], 0.75f);
  log.sampleAt(fromSeconds(3.5), sample);
  EXPECT_FALSE(sample.trackers[0].hasControls());
  Diagnostics findings;
  const std::string text = formatInputLog(log);
  const auto again = parseInputLog(text, "again", findings);
  ASSERT_TRUE(again);
  EXPECT_EQ(formatInputLog(*again), text);
  for (const char* wrong : {"controls pad", "controls pad 0 turn 1 2 3", "controls pad 0 1 2 3",
                            "controls pad 0 axes 2", "controls pad 0 axes"}) {
    Diagnostics told;
    EXPECT_FALSE(parseInputLog(std::string("stadion-input 1\n") + wrong, "wrong", told)) << wrong;
    EXPECT_EQ(told.errorCount(), 1u) << wrong;
  }
}

}  // namespace
}  // namespace stadion
