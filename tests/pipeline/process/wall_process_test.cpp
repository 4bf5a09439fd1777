// Walls drawn by processes of their own: what travels, that the pixels are the same, and what becomes of a
// wall whose process dies or hangs.
#include "engine/asset/mesh_checks.h"
#include "pipeline/process/list_bytes.h"
#include "pipeline/process/per_view_process_renderer.h"
#include "tests/engine/environment/surroundings.h"
#include "tests/fresh_folder.h"
#include "tests/pipeline/gl_draw/renderer_scene.h"
#include "tests/proc.h"

#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <set>
#include <thread>
#include <unistd.h>

namespace stadion {
namespace {

using namespace wall_process;
using Clock = std::chrono::steady_clock;

constexpr std::uint32_t kWidth = 48, kHeight = 36;

std::filesystem::path program() {
  return std::filesystem::path(STADION_BINARY_DIR) / "bin" / "stadion-wall";
}

std::filesystem::path spinningLibrary() {
  return program().parent_path() / "libspinning-library.so";
}

PerWallProcessParts partsFor(const MeshStore& meshes, std::size_t walls = 1) {
  PerWallProcessParts parts{.meshes = meshes, .walls = {}, .names = {}};
  for (std::size_t i = 0; i < walls; ++i) {
    parts.walls.push_back({kWidth, kHeight});
    parts.names.push_back("w" + std::to_string(i + 1));
  }
  parts.program = program();
  return parts;
}

std::vector<std::uint8_t> pictureOf(WallRenderer& drawing, std::size_t wall, std::uint32_t eye = 0) {
  std::vector<std::uint8_t> rgba(kWidth * kHeight * 4);
  const Failure failure = drawing.read(wall, eye, rgba);
  EXPECT_FALSE(failure) << failure->message;
  return rgba;
}

std::vector<std::uint8_t> drawnHere(const MeshStore& meshes, const DrawList& list, std::uint32_t eye = 0) {
  test::Stage stage(meshes, kWidth, kHeight);
  EXPECT_FALSE(stage.renderer().draw(list));
  std::vector<std::uint8_t> rgba(kWidth * kHeight * 4);
  EXPECT_FALSE(stage.renderer().read(eye, rgba));
  return rgba;
}

DrawList stereoList(MeshStore& meshes) {
  DrawList list = test::richList(meshes, double{kWidth} / kHeight);
  list.viewCount = 2;
  list.views[1] = list.views[0];
  list.views[1].view(0, 3) += 0.5;
  return list;
}

void addShadows(DrawList& list) {
  list.shadows.light = 0;
  list.shadows.axes = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  for (std::size_t i = 0; i < kShadowRings; ++i) {
    list.shadows.rings[i].still = std::make_shared<std::vector<DrawItem>>(list.opaque);
    list.shadows.rings[i].stillKey = 7 + i;
    list.shadows.rings[i].moving = list.opaque;
  }
}

bool same(const std::vector<DrawItem>& a, const std::vector<DrawItem>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const DrawItem& x, const DrawItem& y) {
    return x.model == y.model && x.mesh == y.mesh && x.owner == y.owner && x.distance == y.distance &&
           x.level == y.level;
  });
}

TEST(WallProcessBytes, ListsArriveAsTheyWere) {
  MeshStore meshes;
  DrawList list = stereoList(meshes);
  addShadows(list);
  list.ticket.signature.frame = 1234, list.wall = 3, list.origin = Vec3(1, -2, 1e6);
  list.figures.resize(3);
  list.figures[2].layerCount = 1;
  list.figures[2].layers[0] = {4, 0.5f, 1.25};
  list.opaque[0].figure = 3;
  list.paints = {{}, {{1, 0, 0.5f}, 0.25f, {0, 0.125f, 1}}};
  list.opaque[0].paint = 2;
  list.sky.environment = {1, 77, 1, 2.5f, 0.6f, 0.8f};
  list.sky.tones = {0.5f, ToneCurve::Aces};
  SharedSegment segment("test", kListReserve);
  StillKeys known;
  const ListNews news{{{5, 4096, 77}}, {9, 8}};
  const std::size_t bytes = write(list, news, known, segment);

  DrawList got;
  ListNews gotNews;
  ASSERT_TRUE(read({segment.data(), bytes}, got, gotNews));
  EXPECT_EQ(got.ticket.signature.frame, 1234u);
  EXPECT_EQ(got.wall, 3u);
  EXPECT_EQ(got.origin, list.origin);
  EXPECT_EQ(got.viewCount, 2u);
  EXPECT_EQ(got.views[1].view, list.views[1].view);
  EXPECT_EQ(got.views[0].projection, list.views[0].projection);
  EXPECT_TRUE(same(got.opaque, list.opaque));
  EXPECT_TRUE(same(got.transparent, list.transparent));
  EXPECT_EQ(got.lights.size(), list.lights.size());
  EXPECT_EQ(got.figures, list.figures);
  EXPECT_EQ(got.paints, list.paints);
  EXPECT_EQ(got.sky.environment.picture, 77u);
  EXPECT_EQ(got.sky.environment.turnSin, 0.8f);
  EXPECT_EQ(got.sky.tones.curve, ToneCurve::Aces);
  EXPECT_TRUE(same(got.shadows.rings[2].moving, list.opaque));
  ASSERT_TRUE(got.shadows.rings[3].still);
  EXPECT_TRUE(same(*got.shadows.rings[3].still, list.opaque));
  ASSERT_EQ(gotNews.meshes.size(), 1u);
  EXPECT_EQ(gotNews.meshes[0].offset, 4096u);
  EXPECT_EQ(gotNews.gone, (std::vector<MeshId>{9, 8}));
}

TEST(WallProcessBytes, WhatStandsStillTravelsOnce) {
  MeshStore meshes;
  DrawList list = stereoList(meshes);
  addShadows(list);
  SharedSegment segment("test", kListReserve);
  StillKeys known;
  const std::size_t first = write(list, {}, known, segment);
  DrawList got;
  ListNews news;
  ASSERT_TRUE(read({segment.data(), first}, got, news));
  const auto still = got.shadows.rings[1].still;
  const std::size_t second = write(list, {}, known, segment);
  EXPECT_EQ(first - second, kShadowRings * list.opaque.size() * sizeof(DrawItem));
  ASSERT_TRUE(read({segment.data(), second}, got, news));
  EXPECT_EQ(got.shadows.rings[1].still, still);
  ++list.shadows.rings[1].stillKey;
  EXPECT_EQ(write(list, {}, known, segment) - second, list.opaque.size() * sizeof(DrawItem));
}

TEST(WallProcessBytes, ListsThatAreCutShortAreRefused) {
  MeshStore meshes;
  DrawList list = stereoList(meshes);
  addShadows(list);
  SharedSegment segment("test", kListReserve);
  StillKeys known;
  const std::size_t bytes = write(list, {}, known, segment);
  DrawList got;
  ListNews news;
  for (std::size_t cut = 0; cut < bytes; cut += 61)
    EXPECT_FALSE(read({segment.data(), cut}, got, news)) << cut;
}

TEST(WallProcessBytes, MeshesArriveWithTheirLevels) {
  MeshStore meshes;
  auto ball = test::MeshMaker(test::matt(1, 0, 0)).sphere(1, 8).seal();
  ball->levels.push_back({{0, 1, 2}, {{0, 3, 0}}, 0.25});
  const Mesh& was = *ball;
  const std::uint64_t hash = was.hash;
  const MeshId id = meshes.add(std::move(ball));
  SharedMeshes shared(meshes);
  const auto place = shared.take(id, hash);
  ASSERT_TRUE(place);
  SharedSegment mapped(dup(shared.descriptor()), kMeshReserve, SharedSegment::Access::Read);
  const auto got = meshOf({mapped.data() + place->offset, place->bytes});
  ASSERT_TRUE(got);
  EXPECT_EQ(got->positions, was.positions);
  EXPECT_EQ(got->indices, was.indices);
  ASSERT_EQ(got->levels.size(), 1u);
  EXPECT_EQ(got->levels[0].indices, was.levels[0].indices);
  EXPECT_EQ(got->levels[0].error, 0.25);
  EXPECT_FALSE(shared.take(id + 1, hash));
}

TEST(WallProcessBytes, AMeshIsWrittenOnceAndItsPlaceIsFreeAfterItsLastUse) {
  MeshStore meshes;
  const auto add = [&](double radius) {
    auto mesh = test::MeshMaker(test::matt(1, 0, 0)).sphere(radius, 8).seal();
    const std::uint64_t hash = mesh->hash;
    return std::pair(meshes.add(std::move(mesh)), hash);
  };
  const auto [one, oneHash] = add(1);
  const auto [two, twoHash] = add(2);
  SharedMeshes shared(meshes);
  const auto first = shared.take(one, oneHash), again = shared.take(one, oneHash);
  EXPECT_EQ(first->offset, again->offset);
  shared.giveBack(*first);
  EXPECT_NE(shared.take(two, twoHash)->offset, first->offset);
  shared.giveBack(*again);
  const auto [three, threeHash] = add(3);
  EXPECT_EQ(shared.take(three, threeHash)->offset, first->offset);
}

TEST(ProgramWallProcesses, DrawTheSamePictures) {
  MeshStore meshes;
  const DrawList list = stereoList(meshes);
  PerWallProcessRenderer drawing(partsFor(meshes, 2));
  for (std::size_t wall = 0; wall < 2; ++wall) {
    const Failure failure = drawing.open(wall);
    ASSERT_FALSE(failure) << failure->message;
    const DrawOutcome outcome = drawing.draw(wall, list, false);
    ASSERT_FALSE(outcome.failure) << outcome.failure->message;
    EXPECT_TRUE(outcome.drawn);
  }
  for (std::uint32_t eye = 0; eye < 2; ++eye)
    for (std::size_t wall = 0; wall < 2; ++wall)
      EXPECT_EQ(pictureOf(drawing, wall, eye), drawnHere(meshes, list, eye));
  EXPECT_NE(pictureOf(drawing, 0, 0), pictureOf(drawing, 0, 1));
  EXPECT_EQ(drawing.totals(0)[0].frames, 1u);
  EXPECT_NE(drawing.drawnBy(0).find("llvmpipe"), std::string::npos);
}

TEST(ProgramWallProcesses, HaveTheLightFromAllAround) {
  MeshStore meshes;
  DrawList list = stereoList(meshes);
  auto hall = std::make_unique<Mesh>();
  hall->materials.emplace_back();
  hall->environment =
      std::make_shared<const EnvironmentLight>(environmentLight(test::surroundingsOf(64, test::hallAt)));
  finish(*hall);
  list.sky.environment = {1, meshes.add(std::move(hall)), 1, 1, 0.8f, 0.6f};
  PerWallProcessRenderer drawing(partsFor(meshes));
  ASSERT_FALSE(drawing.open(0));
  for (int frame = 0; frame < 2; ++frame) ASSERT_FALSE(drawing.draw(0, list, false).failure);
  EXPECT_EQ(pictureOf(drawing, 0), drawnHere(meshes, list));
  list.sky.environment.lit = 0;
  EXPECT_NE(pictureOf(drawing, 0), drawnHere(meshes, list));
}

TEST(ProgramWallProcesses, AProcessForEachEyeDrawsTheSamePictures) {
  MeshStore meshes;
  DrawList list = stereoList(meshes);
  list.opaque.front().views = 1, list.opaque.back().views = 2;
  DrawList mono = list;
  mono.viewCount = 1;
  PerViewProcessRenderer drawing(partsFor(meshes, 2), {2, 1});
  for (std::size_t wall = 0; wall < 2; ++wall) {
    const Failure failure = drawing.open(wall);
    ASSERT_FALSE(failure) << failure->message;
  }
  for (int frame = 0; frame < 3; ++frame) {
    for (std::size_t wall = 0; wall < 2; ++wall) {
      const DrawOutcome outcome = drawing.draw(wall, wall == 0 ? list : mono, true);
      ASSERT_FALSE(outcome.failure) << outcome.failure->message;
    }
    for (std::uint32_t eye = 0; eye < 2; ++eye)
      EXPECT_EQ(pictureOf(drawing, 0, eye), drawnHere(meshes, list, eye));
    EXPECT_EQ(pictureOf(drawing, 1), drawnHere(meshes, list));
  }
  EXPECT_EQ(drawing.totals(0)[1].frames, 3u);
  EXPECT_EQ(drawing.totals(1)[1].frames, 0u);
  drawing.close(0), drawing.close(1);
}

TEST(ProgramWallProcesses, NoWallIsDrawnOfWhichOneEyeIsMissing) {
  MeshStore meshes;
  const DrawList list = stereoList(meshes);
  auto parts = partsFor(meshes);
  parts.everyFrame = false, parts.rate = 1;
  PerViewProcessRenderer drawing(std::move(parts), {2});
  ASSERT_FALSE(drawing.open(0));
  for (int frame = 0; frame < 8; ++frame) ASSERT_TRUE(drawing.draw(0, list, false).drawn);
  for (const std::uint32_t eye : {1u, 0u}) {
    const int before = drawing.pid(0, eye), other = drawing.pid(0, 1 - eye);
    kill(before, SIGSTOP);
    const DrawOutcome outcome = drawing.draw(0, list, false);
    EXPECT_FALSE(outcome.failure);
    EXPECT_FALSE(outcome.drawn) << "without eye " << eye;
    const auto began = Clock::now();
    while (!drawing.draw(0, list, false).drawn && Clock::now() - began < std::chrono::seconds(60))
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    EXPECT_NE(drawing.pid(0, eye), before);
    EXPECT_EQ(drawing.pid(0, 1 - eye), other);
    for (std::uint32_t e = 0; e < 2; ++e) EXPECT_EQ(pictureOf(drawing, 0, e), drawnHere(meshes, list, e));
  }
  drawing.close(0);
}

TEST(ProgramWallProcesses, AFrameWhoseProcessIsStoppedIsDrawnByAnother) {
  MeshStore meshes;
  const DrawList list = stereoList(meshes);
  PerWallProcessRenderer drawing(partsFor(meshes));
  ASSERT_FALSE(drawing.open(0));
  ASSERT_TRUE(drawing.draw(0, list, false).drawn);
  const int before = drawing.pid(0);
  kill(before, SIGSTOP);
  ASSERT_TRUE(drawing.draw(0, list, false).drawn);
  EXPECT_NE(drawing.pid(0), before);
  EXPECT_EQ(pictureOf(drawing, 0), drawnHere(meshes, list));
}

TEST(ProgramWallProcesses, AnEyeWhoseProcessHasNoProgramFailsTheWall) {
  MeshStore meshes;
  auto parts = partsFor(meshes);
  parts.program = "/nowhere/stadion-wall";
  PerViewProcessRenderer drawing(std::move(parts), {2});
  const Failure failure = drawing.open(0);
  ASSERT_TRUE(failure);
  EXPECT_NE(failure->message.find("left eye"), std::string::npos) << failure->message;
}

TEST(ProgramWallProcesses, ForgetMeshesThatAreGoneAndDrawOthersInTheirPlace) {
  MeshStore meshes;
  DrawList list = test::plainList();
  PerWallProcessRenderer drawing(partsFor(meshes));
  ASSERT_FALSE(drawing.open(0));
  std::vector<std::vector<std::uint8_t>> pictures;
  for (std::uint64_t frame = 0; frame < 4; ++frame) {
    const float red = 0.2f * static_cast<float>(frame % 3);
    const MeshId id =
        meshes.add(test::MeshMaker(test::matt(red, 0.5f, 0)).box({-1, -1, -1}, {1, 1, 1}).seal());
    list.ticket.signature.frame = frame;
    list.opaque = {test::place(id)};
    const DrawOutcome outcome = drawing.draw(0, list, false);
    ASSERT_FALSE(outcome.failure) << outcome.failure->message;
    pictures.push_back(pictureOf(drawing, 0));
    EXPECT_EQ(pictures.back(), drawnHere(meshes, list));
    meshes.release(id, frame);
    meshes.collect(frame);
  }
  EXPECT_NE(pictures[0], pictures[1]);
  EXPECT_EQ(pictures[0], pictures[3]);
}

TEST(ProgramWallProcesses, AFrameWhoseProcessIsKilledIsDrawnAgain) {
  MeshStore meshes;
  const DrawList list = stereoList(meshes);
  auto parts = partsFor(meshes);
  std::vector<std::string> told;
  parts.tell = [&](const std::string& what) { told.push_back(what); };
  PerWallProcessRenderer drawing(std::move(parts));
  ASSERT_FALSE(drawing.open(0));
  for (int frame = 0; frame < 3; ++frame) {
    ASSERT_FALSE(drawing.draw(0, list, false).failure);
    EXPECT_EQ(pictureOf(drawing, 0), drawnHere(meshes, list));
    if (frame < 2) kill(drawing.pid(0), SIGKILL);
  }
  ASSERT_EQ(told.size(), 2u);
  EXPECT_NE(told[0].find("wall w1: the process that draws it was killed by signal 9"), std::string::npos)
      << told[0];
  EXPECT_EQ(drawing.totals(0)[1].frames, 3u);
}

TEST(ProgramWallProcesses, AProcessThatDiesBeforeItsPictureIsTakenLosesNothing) {
  MeshStore meshes;
  const DrawList list = stereoList(meshes);
  PerWallProcessRenderer drawing(partsFor(meshes));
  ASSERT_FALSE(drawing.open(0));
  for (int frame = 0; frame < 3; ++frame) {
    ASSERT_FALSE(drawing.draw(0, list, true).failure);
    kill(drawing.pid(0), SIGKILL);
    for (const std::uint32_t eye : {0u, 1u})
      EXPECT_EQ(pictureOf(drawing, 0, eye), drawnHere(meshes, list, eye)) << frame;
  }
}

/// A program whose file can be exchanged while others start it.
class Exchangeable {
public:
  Exchangeable() { become(program()); }
  void become(const std::filesystem::path& program) {
    std::filesystem::remove(link_);
    std::filesystem::create_symlink(program, link_);
  }
  const std::filesystem::path& path() const { return link_; }

private:
  FreshFolder folder_;
  std::filesystem::path link_ = folder_ / "stadion-wall";
};

TEST(ProgramWallProcesses, ProcessesThatDieOneAfterTheOtherAreToldOfTwiceAndEndNoLiveRun) {
  MeshStore meshes;
  const DrawList list = stereoList(meshes);
  Exchangeable program;
  auto parts = partsFor(meshes);
  parts.everyFrame = false, parts.program = program.path();
  parts.rate = 0.1;  // a wall that is waited for is in time
  std::vector<std::string> told;
  parts.tell = [&](const std::string& what) { told.push_back(what); };
  PerWallProcessRenderer drawing(std::move(parts));
  ASSERT_FALSE(drawing.open(0));
  for (int frame = 0; frame < 8; ++frame) ASSERT_TRUE(drawing.draw(0, list, false).drawn);
  program.become("/bin/true");
  kill(drawing.pid(0), SIGKILL);
  std::set<int> processes;
  while (processes.size() < 5) {  // at once, then after 0.25 s, 0.5 s, 1 s
    ASSERT_FALSE(drawing.draw(0, list, false).failure);
    if (const int pid = drawing.pid(0)) processes.insert(pid);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  ASSERT_EQ(told.size(), 2u) << told.back();
  EXPECT_NE(told[0].find("was killed by signal 9"), std::string::npos) << told[0];
  EXPECT_NE(told[1].find("ended with exit code 0 again"), std::string::npos) << told[1];

  std::filesystem::remove(program.path());  // cannot even be started
  while (drawing.pid(0) != 0) drawing.draw(0, list, false);
  program.become(stadion::program());
  bool drawn = false;
  const auto end = Clock::now() + std::chrono::seconds(60);
  while (!drawn && Clock::now() < end) {
    const DrawOutcome outcome = drawing.draw(0, list, false);
    ASSERT_FALSE(outcome.failure) << outcome.failure->message;
    drawn = outcome.drawn;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_TRUE(drawn);
  EXPECT_EQ(pictureOf(drawing, 0), drawnHere(meshes, list));
}

TEST(ProgramWallProcesses, AFrameThatKillsEveryProcessEndsTheRunWithItsNumberAndTheWall) {
  MeshStore meshes;
  DrawList list = stereoList(meshes);
  list.ticket.signature.frame = 77;
  Exchangeable program;
  auto parts = partsFor(meshes);
  parts.program = program.path();
  PerWallProcessRenderer drawing(std::move(parts));
  ASSERT_FALSE(drawing.open(0));
  program.become("/bin/false");
  kill(drawing.pid(0), SIGKILL);
  const DrawOutcome outcome = drawing.draw(0, list, true);
  ASSERT_TRUE(outcome.failure);
  EXPECT_EQ(outcome.failure->message,
            "wall w1, frame 77: 4 processes died of it; the last one ended with exit code 1");
}

/// Draws until the wall's picture is new again; how long that took.
double secondsUntilDrawn(PerWallProcessRenderer& drawing, const DrawList& list, double& longestCall) {
  const auto began = Clock::now();
  longestCall = 0;
  for (;;) {
    const auto call = Clock::now();
    const DrawOutcome outcome = drawing.draw(0, list, false);
    const auto now = Clock::now();
    EXPECT_FALSE(outcome.failure);
    longestCall = std::max(longestCall, std::chrono::duration<double>(now - call).count());
    const double seconds = std::chrono::duration<double>(now - began).count();
    if (outcome.drawn || outcome.failure || seconds > 60) return seconds;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

TEST(ProgramWallProcesses, WhereTheNewestFrameCountsNoWallWaitsForAProcessThatIsGoneOrStopped) {
  MeshStore meshes;
  const DrawList list = stereoList(meshes);
  auto parts = partsFor(meshes);
  parts.everyFrame = false, parts.rate = 1;
  PerWallProcessRenderer drawing(std::move(parts));
  ASSERT_FALSE(drawing.open(0));
  for (int frame = 0; frame < 8; ++frame) ASSERT_TRUE(drawing.draw(0, list, false).drawn);
  for (const int signal : {SIGKILL, SIGSTOP}) {
    const int before = drawing.pid(0);
    kill(before, signal);
    double longestCall = 0;
    const double seconds = secondsUntilDrawn(drawing, list, longestCall);
    // No bound that a busy machine could break, but one that a wait for the process would.
    EXPECT_LT(seconds, 30) << signal;
    EXPECT_LT(longestCall, 10) << signal;
    EXPECT_NE(drawing.pid(0), before);
    EXPECT_EQ(pictureOf(drawing, 0), drawnHere(meshes, list));
  }
}

/// Gone, or not yet taken leave of; it may take a moment.
bool isDead(int pid) {
  for (int i = 0; i < 6000 && procRuns(pid); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  return !procRuns(pid);
}

/// Busy it is all the same.
TEST(ProgramWallProcesses, AProcessThatGoesRoundInCirclesIsReplaced) {
  if (!std::filesystem::exists(spinningLibrary())) GTEST_SKIP() << "sanitizers let nothing be preloaded";
  MeshStore meshes;
  const DrawList list = stereoList(meshes);
  auto parts = partsFor(meshes);
  parts.everyFrame = false, parts.rate = 1;
  PerWallProcessRenderer drawing(std::move(parts));
  setenv("LD_PRELOAD", spinningLibrary().c_str(), 1);
  const Failure failure = drawing.open(0);
  unsetenv("LD_PRELOAD");
  ASSERT_FALSE(failure);
  for (int frame = 0; frame < 8; ++frame) ASSERT_TRUE(drawing.draw(0, list, false).drawn);
  const int before = drawing.pid(0);
  kill(before, SIGUSR1);
  double longestCall = 0;
  EXPECT_LT(secondsUntilDrawn(drawing, list, longestCall), 40);
  EXPECT_NE(drawing.pid(0), before);
  EXPECT_TRUE(isDead(before));
  EXPECT_EQ(pictureOf(drawing, 0), drawnHere(meshes, list));
}

TEST(ProgramWallProcesses, AProcessIsDeadWhenTheThreadThatDrawsIsThoughOthersLinger) {
  MeshStore meshes;
  auto parts = partsFor(meshes);
  parts.program = program().parent_path() / "lingering-program";
  PerWallProcessRenderer drawing(std::move(parts));
  const Failure failure = drawing.open(0);
  ASSERT_TRUE(failure);
  EXPECT_NE(failure->message.find("ended with exit code 0 before it was ready"), std::string::npos)
      << failure->message;
}

TEST(ProgramWallProcesses, WhereTheNewestFrameCountsNoWallWaitsForANewProcessFirstFrame) {
  MeshStore meshes;
  const DrawList list = stereoList(meshes);
  auto parts = partsFor(meshes);
  parts.everyFrame = false, parts.rate = 0.01;  // a wall that is waited for is in time
  PerWallProcessRenderer drawing(std::move(parts));
  ASSERT_FALSE(drawing.open(0));
  for (int frame = 0; frame < 8; ++frame) ASSERT_TRUE(drawing.draw(0, list, false).drawn);
  kill(drawing.pid(0), SIGKILL);
  double longestCall = 0;
  secondsUntilDrawn(drawing, list, longestCall);
  EXPECT_EQ(drawing.totals(0)[0].frames, 8u + 2u) << "the first one was not waited for, the second one was";
  EXPECT_EQ(pictureOf(drawing, 0), drawnHere(meshes, list));
}

TEST(ProgramWallProcesses, WhereTheNewestFrameCountsAViewThatTakesLongerFromNowOnIsSoonWaitedForAgain) {
  MeshStore meshes;
  const DrawList list = stereoList(meshes);
  DrawList dear = list;
  while (dear.opaque.size() < 500)
    dear.opaque.insert(dear.opaque.end(), list.opaque.begin(), list.opaque.end());
  auto parts = partsFor(meshes);
  parts.everyFrame = false, parts.rate = 1000;
  PerWallProcessRenderer drawing(std::move(parts));
  ASSERT_FALSE(drawing.open(0));
  double longestCall = 0;
  for (int frame = 0; frame < 40; ++frame) ASSERT_LT(secondsUntilDrawn(drawing, list, longestCall), 30);
  EXPECT_LT(secondsUntilDrawn(drawing, dear, longestCall), 30);
  EXPECT_EQ(pictureOf(drawing, 0), drawnHere(meshes, dear));
}

TEST(ProgramWallProcesses, AProgramThatIsMissingOrEndsAtOnceIsAFailureThatNamesTheWall) {
  MeshStore meshes;
  for (const char* name : {"/nowhere/stadion-wall", "/bin/true"}) {
    auto parts = partsFor(meshes);
    parts.program = name;
    PerWallProcessRenderer drawing(std::move(parts));
    const Failure failure = drawing.open(0);
    ASSERT_TRUE(failure) << name;
    EXPECT_NE(failure->message.find("wall w1: "), std::string::npos) << failure->message;
  }
}

}  // namespace
}  // namespace stadion
