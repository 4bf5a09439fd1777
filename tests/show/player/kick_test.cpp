/// The show of the paper, as its script and its input log tell it: what the ball does from rest to rest.

#include "tests/show/player/played_show.h"

#include "dynamics/nodes/dyn_object_node.h"
#include "dynamics/nodes/field_node.h"
#include "tests/programs/program.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sstream>

namespace stadion {
namespace {

constexpr double kRadius = 0.11;  // [m] of the football

/// What holds at the end of a frame.
struct KickMoment {
  double time = 0;  ///< [s]
  Vec3 ball = Vec3::Zero(), v = Vec3::Zero();
  bool asleep = false, kickOn = false, kickHooked = false;
  double pitch = 0;   ///< of the foot [degrees]
  double lowest = 0;  ///< height of the foot's lowest point [m]
  double gap = 0;     ///< from the ball's surface to the foot's nearest corner [m]
};

struct Told {
  Event event;
  double time;  ///< [s]
};

struct PlayedKick {
  std::vector<KickMoment> moments;
  std::vector<Told> told;  ///< by the dynamics node
};

/// The corners of the foot, in a show's axes.
std::vector<Vec3> footCorners() {
  std::istringstream file(fileContent(assetFolder() + "/crude_foot.obj"));
  std::vector<Vec3> corners;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string kind;
    double x = 0, y = 0, z = 0;
    if (words >> kind >> x >> y >> z && kind == "v") corners.push_back({x, -z, y});
  }
  return corners;
}

KickMoment momentOf(const TimeSignature& now, Scene& scene, const std::vector<Vec3>& corners) {
  const auto named = [&](const char* name) { return scene.find(scene.tree().resolve(name, {1, 0})); };
  const auto& ball = dynamic_cast<const DynObjectNode&>(*named("ball"));
  const auto& leg = dynamic_cast<const PlacedNode&>(*named("dummy_leg"));
  const Affine X = scene.placements().world(leg.placement());
  const NodeRef kick = scene.tree().resolve("kick", {1, 0});
  KickMoment m;
  m.time = toSeconds(now.time);
  m.ball = ball.state().p, m.v = ball.state().v, m.asleep = ball.state().asleep();
  m.kickOn = dynamic_cast<const FieldNode&>(*named("kick")).on();
  m.kickHooked = std::ranges::count(ball.hooked(), kick) > 0;
  m.pitch = std::asin((X.linear() * Vec3::UnitY()).z()) * 180 / M_PI;
  m.lowest = m.gap = 1e9;
  for (const Vec3& corner : corners) {
    const Vec3 p = X * corner;
    m.lowest = std::min(m.lowest, p.z());
    m.gap = std::min(m.gap, (p - m.ball).norm() - kRadius);
  }
  return m;
}

PlayedKick playKick(const std::string& script, double rate, const std::string& input = {}) {
  PlayedKick played;
  ShowOptions options;
  options.script = script, options.walls = "desktop", options.size = "64x48", options.rate = rate,
  options.input = input;
  options.assetRoots = {assetFolder()};
  Diagnostics findings;
  if (!options.complete(findings)) return played;
  const auto player = Player::create(options, findings);
  printFindings(findings);
  if (!player) return played;
  const std::vector<Vec3> corners = footCorners();
  ShowParts parts = player->parts(StereoLayout::Pair);
  parts.observer = [&](const TimeSignature& now, const InputSample&, const Scene& scene) {
    played.moments.push_back(momentOf(now, player->scene(), corners));
    for (const EventRecord& e : scene.events())
      if (e.event == Event("onimpact") || e.event == Event("onrelease"))
        played.told.push_back({e.event, toSeconds(e.when)});
  };
  ShowStages stages(std::move(parts));
  FrameLoopOptions o;
  o.mode = Mode::Sequential, o.walls = 1, o.frames = player->frames(), o.rate = rate;
  const std::atomic<bool> never = false;
  FrameLoop loop(stages, o, never);
  const FrameLoopOutcome outcome = loop.run();
  EXPECT_FALSE(outcome.failure) << outcome.failure->message;
  return played;
}

std::string kickScript() {
  return STADION_SOURCE_DIR "/scripts/kick.evs";
}

/// A copy of the script that says `after` instead of `before`, with the input of the kick.
std::string copyWith(const TestFolder& folder, const std::string& name, const std::string& script,
                     const std::string& before, const std::string& after) {
  std::string text = fileContent(script);
  const std::size_t at = text.find(before);
  EXPECT_NE(at, text.npos);
  text.replace(at, before.size(), after);
  folder.write(name + ".input", fileContent(STADION_SOURCE_DIR "/scripts/kick.input"));
  return folder.write(name + ".evs", text);
}

/// The same show with a kick field that has no strength.
std::string withoutField(const TestFolder& folder, const std::string& script) {
  return copyWith(folder, "without", script, "0, 5, 0", "0, 0, 0");
}

/// The same show with the contact scheme of the paper.
std::string withPaperImpacts(const TestFolder& folder) {
  return copyWith(folder, "paper", kickScript(), "name=”sim_kick”,", "name=”sim_kick”, impact=paper,");
}

/// What the listing promises of a kick, in figures.
struct Figures {
  double firstEvent = 0, release = 0;  ///< [s]
  double stirred = 0;                  ///< how far the ball moved in the first two seconds [m]
  double pitch = 0;                    ///< of the foot when it touches the ball [degrees]
  double gap = 0;                      ///< between foot and ball after the frame of the first event [m]
  double on = 0;                       ///< first activation of the kick field [s]
  double speed = 0;                    ///< when the ball has left [m/s]
  double apex = 0;                     ///< of the ball's lowest point above the ground [m]
  double firstBounce = 0;              ///< how far from where the ball lay [m]
  int bounces = 0;                     ///< from at least 0.3 m/s down to at least 0.3 m/s up
  double asleep = 0;                   ///< since when the ball sleeps [s]
  double lowest = 0;                   ///< height of the foot's lowest point in the whole show [m]
  bool hookedUntilRelease = true, unhookedAfter = true, sleepsAtEnd = false;
};

Figures figuresOf(const PlayedKick& played) {
  Figures f;
  const std::vector<KickMoment>& all = played.moments;
  if (all.empty() || played.told.empty()) {
    ADD_FAILURE() << "nothing happened";
    return f;
  }
  f.firstEvent = played.told.front().time;
  const auto release =
      std::ranges::find_if(played.told, [](const Told& t) { return t.event == Event("onrelease"); });
  if (release == played.told.end()) {
    ADD_FAILURE() << "the ball was never released";
    return f;
  }
  f.release = release->time;
  f.lowest = 1e9;
  bool ended = false;
  const Vec3 start = all.front().ball;
  for (std::size_t n = 1; n < all.size(); ++n) {
    const KickMoment &before = all[n - 1], &m = all[n];
    const double frame = m.time - before.time;
    if (m.time <= 2) f.stirred = std::max(f.stirred, (m.ball - start).norm());
    if (before.time < f.firstEvent && f.firstEvent <= m.time) {
      const double part = (f.firstEvent - before.time) / frame;
      f.pitch = before.pitch + part * (m.pitch - before.pitch), f.gap = m.gap;
    }
    ended |= before.kickOn && !m.kickOn;
    if (m.kickOn && !ended) f.on += frame;
    if (m.time <= f.release && !m.kickHooked) f.hookedUntilRelease = false;
    if (m.time > f.release + 1.5 * frame && m.kickHooked) f.unhookedAfter = false;
    if (f.speed == 0 && m.time > f.release + 1.5 * frame) f.speed = m.v.norm();
    f.apex = std::max(f.apex, m.ball.z() - kRadius);
    f.lowest = std::min(f.lowest, m.lowest);
    if (m.time > f.release && before.v.z() < -0.3 && m.v.z() > 0.3) {
      if (++f.bounces == 1) f.firstBounce = (m.ball - start).head<2>().norm();
    }
    if (!m.asleep) f.asleep = m.time;
  }
  f.sleepsAtEnd = all.back().asleep;
  return f;
}

void tellFigures(double rate, const Figures& with, const Figures& without) {
  fmt::print("{:3.0f} Hz: foot pitched {:.1f} degrees at {:.4f} s, released at {:.4f} s, {:.2f} m/s with and "
             "{:.2f} m/s without the field, apex {:.2f} m, first bounce {:.2f} m away, {} bounces, asleep at "
             "{:.2f} s\n",
             rate, with.pitch, with.firstEvent, with.release, with.speed, without.speed, with.apex,
             with.firstBounce, with.bounces, with.asleep);
}

void expectTheKick(double rate, const std::string& script = kickScript()) {
  SCOPED_TRACE(fmt::format("at {} Hz", rate));
  const TestFolder folder;
  const Figures f = figuresOf(playKick(script, rate));
  const Figures bare = figuresOf(playKick(withoutField(folder, script), rate));
  tellFigures(rate, f, bare);
  EXPECT_LT(f.stirred, 0.001);
  EXPECT_GT(f.firstEvent, 2.0);
  EXPECT_LT(f.gap, 0.05) << "it is the leg that touches the ball first";
  EXPECT_GT(f.pitch, 20);
  EXPECT_LT(f.pitch, 50);
  EXPECT_GT(f.lowest, -0.003) << "the foot stays above the ground";
  EXPECT_GT(f.on, 0);
  EXPECT_LT(f.on, 0.5 + 1.5 / rate);
  EXPECT_TRUE(f.hookedUntilRelease);
  EXPECT_TRUE(f.unhookedAfter);
  EXPECT_GT(f.speed, 5.5);
  EXPECT_LT(f.speed, 20);
  EXPECT_GT(f.speed - bare.speed, 4.5) << "what the field gives it";
  EXPECT_GT(f.apex, 1);
  EXPECT_GT(f.firstBounce, 5.3);
  EXPECT_GE(f.bounces, 2);
  EXPECT_TRUE(f.sleepsAtEnd);
  EXPECT_LT(f.asleep, 28);
}

TEST(Kick, TheShowOfThePaperHoldsWhatItPromises) {
  expectTheKick(60);
}

TEST(Kick, ItDoesSoAtOtherFrameRates) {
  for (const double rate : {30., 96., 120., 144., 240.}) expectTheKick(rate);
}

TEST(Kick, ItPlaysWithTheContactSchemeOfThePaper) {
  const TestFolder folder;
  for (const double rate : {60., 144.}) expectTheKick(rate, withPaperImpacts(folder));
}

TEST(Kick, AtSixtyHertzTheBallComesToRestBeforeTheVisitor) {
  const PlayedKick played = playKick(kickScript(), 60);
  ASSERT_FALSE(played.moments.empty());
  const Vec3 end = played.moments.back().ball;
  EXPECT_LT(std::fabs(end.x()), 1.5);
  EXPECT_GT(end.y(), 1);
  EXPECT_LT(end.y(), 3.5);
}

TEST(Kick, WithALatencyTheBallComesToRestAtTheSamePlaceAtEveryFrameRate) {
  const std::string folder = STADION_SOURCE_DIR "/scripts/";
  Vec3 rest = Vec3::Zero();
  for (const double rate : {60., 96., 144., 240.}) {
    const PlayedKick played = playKick(folder + "kick_latency.evs", rate, folder + "kick.input");
    ASSERT_FALSE(played.moments.empty());
    const KickMoment& end = played.moments.back();
    EXPECT_TRUE(end.asleep);
    if (rate == 60) rest = end.ball;
    fmt::print("{:3.0f} Hz: at rest {:.3g} m from where it lies at 60 Hz\n", rate, (end.ball - rest).norm());
    EXPECT_LT((end.ball - rest).norm(), 1e-5) << rate;
  }
  EXPECT_GT((rest - Vec3(10, 0, 0)).norm(), 5) << "it was a kick";
}

}  // namespace
}  // namespace stadion
