#include "pipeline/platform/child_process.h"
#include "pipeline/record/video.h"
#include "tests/fresh_folder.h"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sys/stat.h>
#include <unistd.h>

namespace stadion {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;

struct VideoScratch {
  fs::path folder = makeFreshFolder();
  ~VideoScratch() { fs::remove_all(folder); }
  std::string file(const char* name) const { return (folder / name).string(); }
  std::size_t count() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
  }
  /// A program that stands in for ffmpeg or ffprobe.
  std::string program(const char* name, const std::string& script) const {
    std::ofstream(folder / name) << "#!/bin/sh\n" << script << "\n";
    chmod(file(name).c_str(), 0755);
    return file(name);
  }
};

VideoOptions options(std::uint32_t w = 64, std::uint32_t h = 48) {
  VideoOptions o;
  o.width = w;
  o.height = h;
  o.rate = 30;
  return o;
}

/// Offers frames as a run does that draws every one.
int feed(VideoWriter& video, const VideoOptions& o, int frames) {
  int taken = 0;
  for (int i = 0; i < frames && video.waitForRoom(milliseconds(60000)); ++i)
    taken +=
        video.offer(Picture(o.width, o.height, static_cast<std::uint8_t>(i))) == VideoWriter::Offer::Taken;
  return taken;
}

bool installed(const char* program) {
  ChildProcess child;
  if (child.start({program, "-version"}, {})) return false;
  return child.wait(milliseconds(120000)).value_or(1) == 0;
}

TEST(ThreadsVideo, HoldsEveryFrameThatWasOffered) {
  if (!installed("ffmpeg") || !installed("ffprobe")) GTEST_SKIP() << "ffmpeg is not installed";
  const VideoScratch scratch;
  const VideoOptions o = options(65, 47);  // odd sides are padded
  VideoWriter video(scratch.file("run.mp4"), o);
  EXPECT_EQ(feed(video, o, 40), 40);
  const auto report = video.finish();
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_EQ(report.value().frames, 40u);
  EXPECT_EQ(report.value().bytes, fs::file_size(scratch.file("run.mp4")));
  EXPECT_EQ(scratch.count(), 1u);
}

TEST(ThreadsVideo, SaysThatFfmpegIsMissingAndRefusesFrames) {
  const VideoScratch scratch;
  VideoOptions o = options();
  o.ffmpeg = "no-such-ffmpeg";
  VideoWriter video(scratch.file("run.mp4"), o);
  feed(video, o, 3);
  const auto report = video.finish();
  ASSERT_FALSE(report);
  EXPECT_NE(report.error().message.find("ffmpeg is not installed"), std::string::npos)
      << report.error().message;
  EXPECT_EQ(video.offer(Picture(64, 48)), VideoWriter::Offer::Refused);
}

TEST(ThreadsVideo, SurvivesAnEncoderThatDiesAndRepeatsItsLastWords) {
  const VideoScratch scratch;
  VideoOptions o = options(320, 240);
  o.ffmpeg = scratch.program("dies", "echo first >&2; echo 'no encoder today' >&2; exit 3");
  VideoWriter video(scratch.file("run.mp4"), o);
  feed(video, o, 50);
  const auto report = video.finish();
  ASSERT_FALSE(report);
  EXPECT_NE(report.error().message.find("no encoder today"), std::string::npos) << report.error().message;
  EXPECT_FALSE(fs::exists(scratch.file("run.mp4")));
}

TEST(ThreadsVideo, NeverKeepsTheCallerWaitingForAnEncoderThatStalls) {
  const VideoScratch scratch;
  VideoOptions o = options(320, 240);
  o.queue = 2;
  o.patience = milliseconds(3000);
  o.ffmpeg = scratch.program("stalls", "exec sleep 60");
  VideoWriter video(scratch.file("run.mp4"), o);
  VideoWriter::Offer last = VideoWriter::Offer::Taken;
  for (int i = 0; i < 10; ++i) last = video.offer(Picture(320, 240));
  EXPECT_EQ(last, VideoWriter::Offer::Full)
      << "if it waited, the patience would be over and the offer refused";
  const auto report = video.finish();
  ASSERT_FALSE(report);
  EXPECT_NE(report.error().message.find("stalled"), std::string::npos) << report.error().message;
}

TEST(ThreadsVideo, CountsTheFramesThatCanBeReadBack) {
  const VideoScratch scratch;
  VideoOptions o = options();
  // An encoder that exits well but keeps only part, as on a full disk.
  o.ffmpeg = scratch.program("loses", "cat > /dev/null; for last; do :; done; echo part > \"${last#file:}\"");
  o.ffprobe = scratch.program("counts", "echo 7");
  VideoWriter video(scratch.file("run.mp4"), o);
  EXPECT_EQ(feed(video, o, 9), 9);
  const auto report = video.finish();
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().message, "the video has 7 of 9 frames");
  EXPECT_FALSE(fs::exists(scratch.file("run.mp4")));
}

TEST(ThreadsVideo, RefusesAPictureOfAnotherSize) {
  const VideoScratch scratch;
  VideoOptions o = options();
  o.ffmpeg = scratch.program("takes", "cat > /dev/null");
  VideoWriter video(scratch.file("run.mp4"), o);
  EXPECT_EQ(video.offer(Picture(65, 48)), VideoWriter::Offer::Refused);
  const auto report = video.finish();
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().message, "no frame was drawn for it");
}

TEST(ThreadsVideo, LeavesNothingBehindWhenItIsGivenUp) {
  const VideoScratch scratch;
  const auto begin = std::chrono::steady_clock::now();
  {
    VideoOptions o = options(320, 240);
    o.ffmpeg = scratch.program("stalls", "exec sleep 600");
    VideoWriter video(scratch.file("run.mp4"), o);
    feed(video, o, 4);
  }
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::minutes(5))
      << "the encoder would take ten";
  EXPECT_EQ(scratch.count(), 1u);  // the stand-in program
}

TEST(ChildProcess, GivesBackTheExitStatusAndWhatWasSaid) {
  const FileDescriptor said = makeMemoryFile();
  ChildProcess child;
  ASSERT_FALSE(child.start({"sh", "-c", "echo hello; exit 5"}, {-1, said.get(), -1}));
  EXPECT_EQ(child.wait(milliseconds(120000)), 5);
  EXPECT_EQ(contentOf(said), "hello\n");
}

TEST(ChildProcess, ThatIsMissingIsAnErrno) {
  ChildProcess child;
  EXPECT_EQ(child.start({"no-such-program-at-all"}, {}), ENOENT);
  EXPECT_FALSE(child.running());
}

}  // namespace
}  // namespace stadion
