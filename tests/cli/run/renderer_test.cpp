/// --renderer: the CPU renderer draws the same pixels however its work is divided, nearly those of OpenGL,
/// and loads no OpenGL.

#include "pipeline/picture/picture.h"
#include "pipeline/target/graphics_card.h"
#include "tests/programs/program.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace stadion {
namespace {

using Options = std::vector<std::string>;

const std::string kKickToDraw = STADION_SOURCE_DIR "/scripts/kick.evs";
const std::string kOlympiaToDraw = STADION_SOURCE_DIR "/scripts/olympia.evs";

Options runOf(const std::string& show, const std::string& frames, const Options& more) {
  Options words{"run", show, "--asset-root", assetFolder(), "--frames", frames};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

/// A line for each picture.
std::string pictureHashes(const std::string& show, const Options& more) {
  Options how{"--renderer", "cpu", "--walls", "cave4", "--size", "96x72", "--hashes"};
  how.insert(how.end(), more.begin(), more.end());
  const ProgramResult r = stadionProgram(runOf(show, "6", how));
  EXPECT_EQ(r.status, 0) << fmt::format("{}\n{}", fmt::join(more, " "), r.err);
  return r.out;
}

void expectSameHashes(const std::string& show, const std::string& look) {
  const std::string one =
      pictureHashes(show, {"--look", look, "--draw-threads", "1", "--mode", "sequential"});
  EXPECT_EQ(std::ranges::count(one, '\n'), 6 * 4 * 2);
  const Options ways[] = {{"--draw-threads", "1"},
                          {"--draw-threads", "2"},
                          {"--draw-threads", "3"},
                          {"--draw-threads", "8"},
                          {"--draw-threads", "3", "--mode", "sequential"},
                          {"--wall-workers", "process"},
                          {"--wall-workers", "process", "--draw-threads", "8", "--mode", "sequential"},
                          {"--wall-workers", "process", "--pin", "on"}};
  for (Options how : ways) {
    how.insert(how.end(), {"--look", look});
    EXPECT_EQ(pictureHashes(show, how), one) << fmt::format("{} {}", show, fmt::join(how, " "));
  }
}

TEST(ProgramRenderer, CpuPicturesAreTheSameForAllThreadsModesAndProcesses) {
  expectSameHashes(testShow("moving.evs"), "full");
}
TEST(ProgramRenderer, CpuPicturesOfThePlainLookAreTheSameForAllThreadsModesAndProcesses) {
  expectSameHashes(testShow("moving.evs"), "plain");
}
TEST(ProgramFullRenderer, CpuPicturesOfOlympiaAreTheSameForAllThreadsModesAndProcesses) {
  expectSameHashes(kOlympiaToDraw, "full");
}

/// The report of the dynamic linker, and the summary.
ProgramResult runWatchingLibraries(const Options& more) {
  Options how{"--walls", "desktop", "--size", "32x24", "--json"};
  how.insert(how.end(), more.begin(), more.end());
  Options words = runOf(kKickToDraw, "2", how);
  words.insert(words.begin(), stadionPath());
  const ProgramResult r = runProgram({words, {"LD_DEBUG=files"}});
  EXPECT_EQ(r.status, 0) << fmt::format("{}", fmt::join(more, " "));
  return r;
}

bool loadsOpenGl(const std::string& report) {
  return has(report, "libOSMesa") || has(report, "libEGL") || has(report, "libGL.so") ||
         has(report, "libLLVM");
}

TEST(ProgramRenderer, CpuLoadsNoOpenGl) {
  EXPECT_FALSE(loadsOpenGl(runWatchingLibraries({"--renderer", "cpu"}).err));
  EXPECT_FALSE(loadsOpenGl(runWatchingLibraries({"--renderer", "cpu", "--wall-workers", "process"}).err));
  EXPECT_TRUE(loadsOpenGl(runWatchingLibraries({"--gl", "osmesa"}).err)) << "else this test sees nothing";
}

TEST(ProgramRenderer, TheSummaryNamesWhatDraws) {
  const auto howDrawn = [](const Options& more) {
    Options how{"--walls", "desktop", "--size", "32x24", "--json"};
    how.insert(how.end(), more.begin(), more.end());
    const ProgramResult r = stadionProgram(runOf(kKickToDraw, "2", how));
    EXPECT_EQ(r.status, 0) << r.err;
    return nlohmann::json::parse(r.out)["how_drawn"];
  };
  const auto cpu = howDrawn({"--renderer", "cpu", "--draw-threads", "3"});
  EXPECT_EQ(cpu["renderer"], "cpu");
  EXPECT_EQ(cpu["draw_threads"], 3);
  EXPECT_EQ(cpu["renderer_why"], "");
  EXPECT_EQ(howDrawn({"--gl", "osmesa"})["renderer"], "gl");
  if (!graphicsCardFile()) {
    const auto chosen = howDrawn({});
    EXPECT_EQ(chosen["renderer"], "cpu");
    EXPECT_TRUE(has(chosen["renderer_why"], "no graphics card")) << chosen;
  }
  EXPECT_EQ(howDrawn({"--renderer", "gl", "--gl", "osmesa"})["renderer"], "gl");
}

TEST(ProgramRenderer, ContradictionsAreRefused) {
  const std::pair<Options, std::string> wrong[] = {
      {{"--renderer", "cpu", "--gl", "osmesa"}, "--renderer cpu draws without OpenGL"},
      {{"--renderer", "cpu", "--gl", "none", "--pictures", "none"}, "--gl none draws nothing"},
      {{"--renderer", "gl", "--draw-threads", "2"}, "--draw-threads is for --renderer cpu"},
      {{"--gl", "osmesa", "--draw-threads", "2"}, "--draw-threads is for --renderer cpu"},
      {{"--renderer", "vulkan"}, "--renderer"},
      {{"--draw-threads", "0"}, "--draw-threads"}};
  for (const auto& [more, why] : wrong) {
    const ProgramResult r = stadionProgram(runOf(kKickToDraw, "2", more));
    EXPECT_EQ(r.status, 2) << fmt::format("{}", fmt::join(more, " "));
    EXPECT_TRUE(has(r.err, why)) << r.err;
  }
}

/// By file name.
std::map<std::string, Picture> picturesDrawnBy(const Options& renderer, const std::string& show) {
  const TestFolder folder;
  Options how{"--walls", "cave4", "--size", "800x600", "--out", folder.path().string()};
  how.insert(how.end(), renderer.begin(), renderer.end());
  const ProgramResult r = stadionProgram(runOf(show, "2", how));
  EXPECT_EQ(r.status, 0) << r.err;
  std::map<std::string, Picture> pictures;
  for (const auto& file : std::filesystem::directory_iterator(folder.path())) {
    const std::string name = file.path().filename().string();
    if (file.path().extension() != ".png" || has(name, "contact-sheet")) continue;
    auto picture = readPng(file.path().string());
    EXPECT_TRUE(picture) << name;
    if (picture) pictures.emplace(name, std::move(picture.value()));
  }
  return pictures;
}

/// The mean is that of all walls. A single picture may have more: on the floor of the kick most texels are
/// one step off, since the filters round differently. Larger differences lie at edges: corners are not moved
/// to a grid.
void expectNearOpenGl(const std::string& show) {
  constexpr double kMeanLimit = 0.3, kAlikePart = 0.995;
  constexpr int kAlike = 8;
  const auto cpu = picturesDrawnBy({"--renderer", "cpu"}, show),
             gl = picturesDrawnBy({"--gl", "osmesa"}, show);
  ASSERT_EQ(cpu.size(), gl.size());
  ASSERT_EQ(cpu.size(), 8U);
  double sum = 0, all = 0;
  for (const auto& [name, picture] : cpu) {
    ASSERT_TRUE(gl.contains(name)) << name;
    const Picture& other = gl.at(name);
    ASSERT_EQ(picture.rgba.size(), other.rgba.size()) << name;
    double unlike = 0;
    for (std::size_t i = 0; i < picture.rgba.size(); ++i) {
      const int by = std::abs(int{picture.rgba[i]} - int{other.rgba[i]});
      sum += by, unlike += by > kAlike ? 1 : 0;
    }
    const double channels = 0.75 * static_cast<double>(picture.rgba.size());  // without alpha
    all += channels;
    EXPECT_GE(1 - unlike / channels, kAlikePart) << show << " " << name;
  }
  EXPECT_LE(sum / all, kMeanLimit) << show;
}

TEST(ProgramRenderer, KickIsNearlyAsOpenGlDrawsIt) {
  expectNearOpenGl(kKickToDraw);
}
TEST(ProgramRenderer, OlympiaIsNearlyAsOpenGlDrawsIt) {
  expectNearOpenGl(kOlympiaToDraw);
}

}  // namespace
}  // namespace stadion
