#include "engine/base/plain_file.h"
#include "engine/input/input_log.h"
#include "engine/input/input_recorder.h"
#include "engine/input/scripted_input.h"
#include "engine/maths/functions.h"
#include "engine/plain_text/text_line.h"
#include "tests/fresh_folder.h"
#include "tests/mutations.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <sys/stat.h>
#include <unistd.h>

namespace stadion {
namespace {

namespace fs = std::filesystem;

struct Scratch {
  fs::path folder = makeFreshFolder();
  ~Scratch() { fs::remove_all(folder); }
  std::string file(const char* name) const { return (folder / name).string(); }
};

std::optional<InputLog> parsedLog(const std::string& records) {
  Diagnostics out;
  auto log = parseInputLog("stadion-input 1\n" + records, "t.input", out);
  for (const Diagnostic& d : out.all()) ADD_FAILURE() << format(d);
  return log;
}

/// "LINE:COLUMN: MESSAGE" of the first error.
std::string firstError(const std::string& text) {
  Diagnostics out;
  EXPECT_FALSE(parseInputLog(text, "t.input", out));
  if (out.all().empty()) return "no error";
  const Diagnostic& d = out.all()[0];
  return std::to_string(d.where.line) + ":" + std::to_string(d.where.column) + ": " + d.message;
}

TEST(InputLog, HoldsBeforeTheFirstAndAfterTheLastRecordAndInterpolatesBetween) {
  const auto log = parsedLog("pose head 1  0 0 1.7  1 0 0 0  buttons 1  axes 0 1\n"
                             "pose head 2  4 0 1.7  0 0 0 1  buttons 2  axes 1 0\n");
  ASSERT_TRUE(log);
  InputReplay replay(*log);
  EXPECT_EQ(replay.sampleAt(0).find("head")->X_RT.p, Vec3(0, 0, 1.7));
  EXPECT_EQ(replay.sampleAt(fromSeconds(5)).find("head")->X_RT.p, Vec3(4, 0, 1.7));
  const InputSample between = replay.sampleAt(fromSeconds(1.25));
  const TrackerSample& head = *between.find("head");
  EXPECT_LE((head.X_RT.p - Vec3(1, 0, 1.7)).norm(), 1e-12);
  EXPECT_LE((det::logRotation(head.X_RT.q) - Vec3(0, 0, 3.14159265358979 / 4)).norm(), 1e-9);
  EXPECT_EQ(head.buttons, 1u);  // they change at the record
  EXPECT_FLOAT_EQ(head.axes[0], 0.25f);
  EXPECT_FLOAT_EQ(head.axes[1], 0.75f);
  EXPECT_EQ(replay.sampleAt(fromSeconds(2)).find("head")->buttons, 2u);
  EXPECT_EQ(replay.end(), fromSeconds(2));
  EXPECT_EQ(between.find("wand"), nullptr);
}

TEST(InputLog, EasesSmoothRecords) {
  const auto log = parsedLog("key foot 0  0 0 0\nkey foot 1  0 8 0  turn 90 0 0  smooth\n");
  ASSERT_TRUE(log);
  InputReplay replay(*log);
  EXPECT_LE((replay.sampleAt(fromSeconds(0.25)).trackers[0].X_RT.p - Vec3(0, 8 * 0.15625, 0)).norm(), 1e-12);
  EXPECT_LE((replay.sampleAt(fromSeconds(0.5)).trackers[0].X_RT.p - Vec3(0, 4, 0)).norm(), 1e-12);
  EXPECT_LE((replay.sampleAt(fromSeconds(1)).trackers[0].X_RT * Vec3(0, 1, 0) - Vec3(0, 8, 1)).norm(), 1e-12);
}

TEST(InputLog, TellsTheSameWayHoweverItIsCutIntoFrames) {
  const auto log = parsedLog(
      "key foot 0.011  0 0 0\nkey foot 0.1037  0 1 0  turn 0 0 30\nkey foot 0.3  0 2 1  turn 40 0 0  smooth\n"
      "lost foot 0.31\nkey foot 0.4111  5 5 5\nkey foot 0.6  5 6 5\n");
  ASSERT_TRUE(log);
  InputReplay replay(*log);
  const auto wayAt = [&](double rate) {
    PoseTrack way;
    for (std::uint64_t n = 0; n <= static_cast<std::uint64_t>(rate); ++n) {
      const TimeSignature now = signatureAt(n, rate);
      InputSample sample;
      replay.sampleFrame(now.time - now.step, now.time, sample);
      const TrackerSample& foot = sample.trackers[0];
      for (const PoseKnot& k : foot.knots) way.push_back(k);
      if (foot.valid && (way.empty() || way.back().time < now.time))
        way.push_back({now.time, foot.X_RT, false});
    }
    return way;
  };
  const PoseTrack slow = wayAt(7), fast = wayAt(240);
  for (const double t : {0.005, 0.05, 0.1036, 0.1038, 0.2001, 0.2998, 0.305, 0.4110, 0.4112, 0.5}) {
    const Pose a = poseOn(slow, fromSeconds(t), Limit::After), b = poseOn(fast, fromSeconds(t), Limit::After);
    EXPECT_LE((a.p - b.p).norm(), 1e-12) << t;
    EXPECT_LE((a.q.coeffs() - b.q.coeffs()).norm(), 1e-12) << t;
  }
  EXPECT_EQ(poseOn(slow, fromSeconds(0.41), Limit::After).p, Vec3(0, 2, 1)) << "lost, it stays where it was";
  EXPECT_EQ(poseOn(slow, fromSeconds(0.4111), Limit::After).p, Vec3(5, 5, 5)) << "and is found elsewhere";
}

TEST(InputLog, KeepsALostTrackerWhereItWasSeenLast) {
  const auto log = parsedLog("pose wand 0  1 2 3  1 0 0 0\nlost wand 1\npose wand 3  5 2 3  1 0 0 0\n");
  ASSERT_TRUE(log);
  InputReplay replay(*log);
  EXPECT_TRUE(replay.sampleAt(fromSeconds(0.5)).trackers[0].valid);
  for (const double t : {1.0, 2.5}) {
    const InputSample s = replay.sampleAt(fromSeconds(t));
    EXPECT_FALSE(s.trackers[0].valid);
    EXPECT_EQ(s.trackers[0].X_RT.p, Vec3(1, 2, 3));
  }
  EXPECT_TRUE(replay.sampleAt(fromSeconds(3)).trackers[0].valid);
}

TEST(InputLog, NamesTheLineOfWhatIsWrong) {
  const std::string h = "stadion-input 1\n";
  EXPECT_EQ(firstError(""), "1:1: the file is empty; an input log begins with the line: stadion-input 1");
  EXPECT_EQ(firstError("pose head 0 0 0 0 1 0 0 0\n"),
            "1:1: this is not an input log; one begins with the line: stadion-input 1");
  EXPECT_EQ(firstError("stadion-input 3\n"),
            "1:15: version 3 of the format is newer than this program, which reads 2");
  EXPECT_EQ(firstError(h + "psoe head 0  0 0 0  1 0 0 0\n"),
            "2:1: \"psoe\" does not begin a statement; did you mean \"pose\"?");
  EXPECT_EQ(firstError(h + "\n# x\nsignature 5\n"),
            "4:1: \"signature\" does not begin a statement; known are pose, key, controls, lost");
  EXPECT_EQ(
      firstError(h +
                 "pose head 1  0 0 0  1 0 0 0\npose wand 0.5 0 0 0 1 0 0 0\npose head 1  0 0 0  1 0 0 0\n"),
      "4:11: time must increase, but 1 s comes after 1 s of the same tracker");
  EXPECT_EQ(firstError(h + "pose head 0  0 nan 0  1 0 0 0\n"),
            "2:16: \"nan\" is not a finite number in range (y of the position)");
  EXPECT_EQ(firstError(h + "pose head 0  0 0 0  1 1 0 0\n"),
            "2:21: the quaternion must have length 1, not 1.41421");
  EXPECT_EQ(firstError(h + "pose head 0  0 0 0  0 0 0 0\n"),
            "2:21: the quaternion must have length 1, not 0");
  EXPECT_EQ(firstError(h + "pose head 0  0 0 0  1 0 0\n"),
            "2:26: z of the unit quaternion w, x, y, z is missing");
  EXPECT_EQ(firstError(h + "pose head -1  0 0 0  1 0 0 0\n"),
            "2:11: the time must be seconds, such as 1.25, not \"-1\"");
  EXPECT_EQ(firstError(h + "pose head 0.0000000001  0 0 0  1 0 0 0\n"),
            "2:11: the time \"0.0000000001\" is finer than a nanosecond; keep nine decimals");
  EXPECT_EQ(firstError(h + "pose head 0  0 0 0  1 0 0 0  buttons 0x1ffffffff\n"),
            "2:38: the buttons must be a bit mask of 32 bits, such as 5 or 0x5, not \"0x1ffffffff\"");
  EXPECT_EQ(firstError(h + "pose head 0  0 0 0  1 0 0 0  axes 2\n"),
            "2:35: an axis must be from -1 to 1, not \"2\"");
  EXPECT_EQ(firstError(h + "pose head 0  0 0 0  1 0 0 0  axes 0 0 0 0 0 0 0 0 0\n"),
            "2:51: a tracker has at most 8 axes");
  EXPECT_EQ(firstError(h + "pose head 0  0 0 0  1 0 0 0  turn 0 0 0\n"),
            "2:30: \"turn\" is not a field of a record; known are smooth, buttons, axes");
  EXPECT_EQ(firstError(h + "key head 0  0 0 0  smooth smooth\n"),
            "2:27: \"smooth\" is given twice for this record; keep one of them");
  EXPECT_EQ(firstError(h + "lost head 0 1\n"), "2:13: \"1\" is one word too many here");
  EXPECT_EQ(
      firstError(h + "lost -head 0\n"),
      "2:6: \"-head\" is not a good name for a tracker; use up to 32 letters, digits, '-', '_' and '.'");
  EXPECT_EQ(firstError(h + "pose head 0  1e7 0 0  1 0 0 0\n"),
            "2:14: a position must be within 1000 km of the rig (metres)");
}

TEST(InputLog, BytesThatAreNoTextAreShownAsOneMarkForEachCharacter) {
  Diagnostics out;
  EXPECT_FALSE(parseInputLog("stadion-input 1\n\xff\xfe\x80x \xc2\x9b[2J\n", "t.input", out));
  ASSERT_FALSE(out.all().empty());
  EXPECT_EQ(out.all()[0].excerpt, "??x ?[2J");
  EXPECT_EQ(out.all()[0].where.column, 1U);
  EXPECT_NE(out.all()[0].message.find("\"??x\""), std::string::npos) << out.all()[0].message;
  EXPECT_EQ(printable("T\u00fcr \u201ca\u201d \U0001F600", 80), "T\u00fcr \u201ca\u201d \U0001F600");
  EXPECT_EQ(printable("\xc0\xaf \xed\xa0\x80 \xf4\x90\x80\x80 \xe2\x80", 80), "? ? ? ?");
}

TEST(InputLog, NormalisesAQuaternionThatIsNearlyUnit) {
  const auto log = parsedLog("pose head 0  0 0 0  0.7071 0.7071 0 0\n");
  ASSERT_TRUE(log);
  EXPECT_NEAR(log->tracks[0].stamps[0].X_RT.q.norm(), 1, 1e-15);
}

TEST(InputLog, CarriesAsManyTrackersAsItSays) {
  std::string text = "stadion-input 1\n";
  for (int i = 0; i < 64; ++i) text += "lost t" + std::to_string(i) + " 0\n";
  Diagnostics out;
  EXPECT_TRUE(parseInputLog(text, "t.input", out));
  EXPECT_EQ(firstError(text + "lost more 0\n"), "66:6: an input log has at most 64 trackers");
}

InputSample randomSample(std::mt19937_64& random, Nanoseconds time) {
  std::uniform_real_distribution<> u(-3, 3);
  InputSample s;
  s.time = time;
  for (const char* name : {"head", "wand", "left_foot"}) {
    TrackerSample t;
    t.name = name;
    t.X_RT = {{u(random), u(random) * 1e-9, u(random) * 1e5},
              det::expRotation({u(random), u(random), u(random)})};
    t.buttons = static_cast<std::uint32_t>(random());
    for (float& a : t.axes) a = static_cast<float>(u(random) / 3);
    t.stamp = time;
    s.trackers.push_back(t);
  }
  return s;
}

TEST(InputRecorder, ReplaysEverySampleToTheBit) {
  const Scratch scratch;
  std::mt19937_64 random(3);
  std::vector<InputSample> samples;
  InputRecorder recorder(scratch.file("a.input"));
  for (std::uint64_t frame = 0; frame < 300; ++frame) {
    samples.push_back(randomSample(random, signatureAt(frame, 60).time));
    recorder.record(samples.back());
  }
  EXPECT_FALSE(fs::exists(scratch.file("a.input")));
  ASSERT_FALSE(recorder.commit());
  Diagnostics out;
  const auto log = loadInputLog(scratch.file("a.input"), out);
  ASSERT_TRUE(log);
  InputReplay replay(*log);
  InputSample back;
  for (const InputSample& s : samples) {
    replay.sampleAt(s.time, back);
    ASSERT_EQ(back.trackers, s.trackers);
  }
  // And the log as text once more.
  Diagnostics again;
  const auto copy = parseInputLog(formatInputLog(*log), "t.input", again);
  ASSERT_TRUE(copy);
  EXPECT_EQ(formatInputLog(*copy), formatInputLog(*log));
}

TEST(InputRecorder, KeepsWhatHappenedInsideTheFrames) {
  const Scratch scratch;
  const auto log =
      parsedLog("key foot 0.011  0 0 0\nkey foot 0.1037  0 1 0  turn 0 0 30  buttons 2\nkey foot "
                "0.3  0 2 1  turn 40 0 0  smooth\n"
                "lost foot 0.31\nkey foot 0.4111  5 5 5\nkey foot 0.6  5 6 5\n");
  ASSERT_TRUE(log);
  InputReplay replay(*log);
  InputRecorder recorder(scratch.file("a.input"));
  std::vector<InputSample> samples(31);
  for (std::uint64_t n = 0; n <= 30; ++n) {
    const TimeSignature now = signatureAt(n, 30);
    replay.sampleFrame(now.time - now.step, now.time, samples[n]);
    recorder.record(samples[n]);
  }
  ASSERT_FALSE(recorder.commit());
  Diagnostics out;
  const auto copy = loadInputLog(scratch.file("a.input"), out);
  ASSERT_TRUE(copy);
  InputSample back;
  for (std::uint64_t n = 0; n <= 30; ++n) {
    const TimeSignature now = signatureAt(n, 30);
    copy->sampleFrame(now.time - now.step, now.time, back);
    EXPECT_EQ(back.trackers, samples[n].trackers) << n;
  }
}

TEST(InputRecorder, KeepsWhatAClockDecidedAndWhereTheRunEnded) {
  const Scratch scratch;
  InputRecorder recorder(scratch.file("a.input"), 60);
  std::vector<TimeSignature> run;
  FrameClock live(60);
  for (const std::uint64_t ticks : {1, 1, 1, 4, 1, 1, 9, 1})
    recorder.frame(run.emplace_back(live.next(ticks)));
  recorder.lateLoad(2, run[5].time);
  ASSERT_FALSE(recorder.commit());
  EXPECT_EQ(readPlainFile(scratch.file("a.input"), 1000).value(),
            "stadion-input 2\nrate 60\nframe 3 0.1\nframe 6 0.283333333\nload 2 0.133333333\n"
            "frame 7 0.3\n");
  Diagnostics out;
  const auto log = loadInputLog(scratch.file("a.input"), out);
  ASSERT_TRUE(log);
  EXPECT_EQ(log->decisions.rate, 60);
  EXPECT_EQ(log->end(), run.back().time);
  EXPECT_EQ(log->decisions.loads.at(2), run[5].time);
  FrameClock replay(60, log->decisions.frames);
  for (const TimeSignature& then : run) {
    const TimeSignature now = replay.next();
    EXPECT_EQ(now.frame, then.frame);
    EXPECT_EQ(now.time, then.time);
    EXPECT_EQ(now.step, then.step);
  }
  Diagnostics again;
  EXPECT_EQ(formatInputLog(*parseInputLog(formatInputLog(*log), "t.input", again)), formatInputLog(*log));
}

TEST(InputLog, DecisionsThatMakeNoSenseAreNamed) {
  const std::string h = "stadion-input 2\n";
  EXPECT_EQ(firstError("stadion-input 1\nframe 3 0.1\n"),
            "2:1: \"frame\" does not begin a statement; known are pose, key, controls, lost");
  EXPECT_EQ(firstError(h + "rate nan\n"), "2:6: \"nan\" is not a finite number in range (frames a second)");
  EXPECT_EQ(firstError(h + "rate 0\n"), "2:6: frames a second must be from 1 to 1000, not 0");
  EXPECT_EQ(firstError(h + "frame 3 0.1\nframe 4 0.1\n"),
            "3:7: the frame's number must increase, and the time with it");
  EXPECT_EQ(firstError(h + "load 2\n"), "2:7: the time in seconds is missing");
  EXPECT_EQ(firstError(h + "load 2 1\nload 2 2\n"), "3:6: the load's number is there already");
}

TEST(InputRecorder, WritesBadPosesAsLostAndOddNamesPlain) {
  const Scratch scratch;
  InputSample s;
  s.trackers.resize(3);
  s.trackers[0].name = "head";
  s.trackers[0].X_RT.p.x() = NAN;
  s.trackers[1].name = "my wand/2";
  s.trackers[1].X_RT.q.coeffs() *= 1.01;
  s.trackers[1].axes = {2, NAN, -7};
  s.trackers[2].name = "zero";
  s.trackers[2].X_RT.q.coeffs().setZero();
  InputRecorder recorder(scratch.file("a.input"));
  recorder.record(s);
  recorder.record(s);  // the same time again
  ASSERT_FALSE(recorder.commit());
  Diagnostics out;
  const auto log = loadInputLog(scratch.file("a.input"), out);
  ASSERT_TRUE(log) << (out.all().empty() ? "" : format(out.all()[0]));
  EXPECT_FALSE(log->find("head")->stamps[0].valid);
  EXPECT_FALSE(log->find("zero")->stamps[0].valid);
  const InputTrack* wand = log->find("my_wand_2");
  ASSERT_NE(wand, nullptr);
  EXPECT_EQ(wand->stamps.size(), 1u);
  EXPECT_EQ(wand->stamps[0].axes[0], 1);
  EXPECT_EQ(wand->stamps[0].axes[1], 0);
  EXPECT_EQ(wand->stamps[0].axes[2], -1);
}

TEST(InputRecorder, LosesTheRecordingNotTheShowOnAFullDisk) {
  std::mt19937_64 random(3);
  InputRecorder recorder("/dev/full");
  for (int i = 0; i < 200; ++i) recorder.record(randomSample(random, i));
  const auto problem = recorder.commit();
  ASSERT_TRUE(problem);
  EXPECT_NE(problem->message.find("No space left"), std::string::npos) << problem->message;
}

TEST(InputRecorder, WithoutCommitLeavesNothingBehindAndTheOldFileAlone) {
  const Scratch scratch;
  std::ofstream(scratch.file("a.input")) << "old";
  {
    std::mt19937_64 random(3);
    InputRecorder recorder(scratch.file("a.input"));
    recorder.record(randomSample(random, 0));
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(scratch.folder), fs::directory_iterator()), 1);
  EXPECT_EQ(readPlainFile(scratch.file("a.input"), 100).value(), "old");
}

TEST(InputRecorder, SaysWhyItCannotWrite) {
  InputRecorder recorder("/nonexistent/folder/a.input");
  recorder.record(InputSample{});
  const auto problem = recorder.commit();
  ASSERT_TRUE(problem);
  EXPECT_EQ(problem->where.file, "/nonexistent/folder/a.input");
}

TEST(ScriptedInput, RunsThroughItsKeysAndRefusesWhatIsOutOfOrder) {
  ScriptedInput foot;
  foot.key("foot", 0, {0, 0, 0}).key("foot", 2, {0, 2, 0}, {25, 0, 0}, false, 1).key("foot", 1, {9, 9, 9});
  foot.key("foot", 3, {NAN, 0, 0});
  EXPECT_EQ(foot.log().tracks[0].stamps.size(), 2u);
  EXPECT_LE((foot.sampleAt(fromSeconds(1)).find("foot")->X_RT.p - Vec3(0, 1, 0)).norm(), 1e-12);
  EXPECT_EQ(foot.end(), fromSeconds(2));
  // What a program makes, the format can hold.
  Diagnostics out;
  const auto log = parseInputLog(formatInputLog(foot.log()), "t.input", out);
  ASSERT_TRUE(log);
  EXPECT_EQ(log->tracks[0].stamps[1].X_RT.q.coeffs(), foot.log().tracks[0].stamps[1].X_RT.q.coeffs());
}

TEST(Teleport, IsFasterThanSixtyMetresASecond) {
  const Pose a, b{{0.99, 0, 0}, Quat::Identity()}, c{{1.01, 0, 0}, Quat::Identity()};
  const Nanoseconds frame = fromSeconds(1.0 / 60);
  EXPECT_FALSE(teleported(a, b, frame));
  EXPECT_TRUE(teleported(a, c, frame));
  EXPECT_FALSE(teleported(a, a, 0));
  EXPECT_TRUE(teleported(a, b, 0));
  EXPECT_TRUE(teleported(a, {{NAN, 0, 0}, Quat::Identity()}, frame));
}

/// A wand that is at these heights every 10 ms.
InputLog wandAt(const std::vector<double>& heights) {
  InputLog log;
  log.tracks.push_back({"wand", {}});
  for (std::size_t i = 0; i < heights.size(); ++i)
    log.tracks[0].stamps.push_back(
        {fromSeconds(0.01 * static_cast<double>(i)), {{0, 0, heights[i]}, Quat::Identity()}});
  return log;
}

TEST(InputLog, AStepThatIsFasterThanBeforeAndAfterIsAJumpAFastSwingIsNone) {
  InputSample sample;
  wandAt({0, 0, 0.4, 0.4, 0.4}).sampleFrame(fromSeconds(0.005), fromSeconds(0.018), sample);
  EXPECT_EQ(sample.trackers[0].X_RT.p.z(), 0) << "it stays until it is seen elsewhere";
  wandAt({0, 0, 0.4, 0.4, 0.4}).sampleFrame(fromSeconds(0.015), fromSeconds(0.02), sample);
  ASSERT_EQ(sample.trackers[0].knots.size(), 1u);
  EXPECT_TRUE(sample.trackers[0].knots[0].jump);
  EXPECT_EQ(sample.trackers[0].knots[0].X.p.z(), 0.4);
  // 30 m/s, steadily; and a swing that gains 10 m/s a step.
  for (const std::vector<double>& swing :
       {std::vector<double>{0, 0, 0.3, 0.6, 0.9}, {0, 0, 0.1, 0.3, 0.6, 1.0, 1.3, 1.5, 1.6, 1.6}}) {
    wandAt(swing).sampleFrame(fromSeconds(0.005), fromSeconds(0.085), sample);
    for (const PoseKnot& k : sample.trackers[0].knots) EXPECT_FALSE(k.jump) << k.time;
  }
}

TEST(InputLog, ThatIsMutatedNeverCrashesAndWhatIsAcceptedStaysFinite) {
  const auto [count, start] = test::mutations(3000);
  std::mt19937 random(static_cast<std::uint32_t>(11 + start));
  const std::string seed =
      "stadion-input 1\n# x\npose head 0  0 0 1.7  1 0 0 0  buttons 0x3  axes 0.5 -1\n"
      "pose head 0.5  0.25 0 1.7  0.6 0 0.8 0 smooth\nkey foot 1 0 0 0.1 turn 10 20 30 smooth buttons 1\n"
      "lost head 2.5\nkey foot 1.25 0 1 0.1\npose head 3.000000001  0 0 1.7  1 0 0 0\n";
  static const std::vector<std::string> kPieces{
      "nan",  "inf",    "-",    "1e308", "1e-320", ".", "\xff",
      "pose", "lost",   "turn", "axes",  "\n",     "#", "99999999999999999999",
      "0x",   "smooth "};
  int good = 0;
  for (int i = 0; i < count; ++i) {
    std::string text = seed;
    for (unsigned k = 1 + random() % 3; k > 0; --k) {
      const std::size_t at = random() % (text.size() + 1);
      switch (random() % 4) {
      case 0: text.insert(at, kPieces[random() % kPieces.size()]); break;
      case 1: text.erase(at, random() % 9); break;
      case 2:
        if (at < text.size()) text[at] = static_cast<char>(random());
        break;
      default: text.insert(at, text.substr(random() % (text.size() + 1), random() % 50));
      }
    }
    Diagnostics out;
    const auto log = parseInputLog(text, "t.input", out);
    ASSERT_EQ(log.has_value(), !out.hasErrors());
    if (!log) continue;
    ++good;
    InputSample sample;
    for (int t = 0; t < 40; ++t) {
      log->sampleAt(fromSeconds(t * 0.1), sample);
      for (const TrackerSample& s : sample.trackers) {
        ASSERT_TRUE(s.X_RT.finite()) << text;
        ASSERT_NEAR(s.X_RT.q.norm(), 1, 1e-9) << text;
      }
    }
    ASSERT_TRUE(parseInputLog(formatInputLog(*log), "again", out)) << text;
  }
  EXPECT_GT(good, count / 30);
}

}  // namespace
}  // namespace stadion
