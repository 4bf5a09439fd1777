/// The same motion at 30, 60, 96, 144 and 240 frames a second, at the times that all of them show. Parameters
/// as in the published cases C05, C09 and C15; limits ten times the error that is allowed there.

#include "tests/dynamics/world/watch.h"

#include <functional>
#include <gtest/gtest.h>

namespace stadion {
namespace {

using namespace scenes;

constexpr std::array kRates{30., 60., 96., 144., 240.};

struct Seen {
  Vec3 p;
  Quat q;
};

/// Where every body is at each sixth of a second: a time that each rate shows.
template <class Build>
std::vector<Seen> sixths(double seconds, double rate, Build build) {
  World w;
  const std::vector<BodyId> bodies = build(w);
  std::vector<Seen> seen;
  const auto frames = static_cast<std::uint64_t>(seconds * rate + 0.5),
             every = static_cast<std::uint64_t>(rate / 6);
  for (std::uint64_t n = 1; n <= frames; ++n) {
    const TimeSignature s = signatureAt(n, rate);
    w.advance(s.time - s.step, s.time);
    if (n % every != 0) continue;
    for (const BodyId b : bodies) seen.push_back({w.state(b).p, w.state(b).q});
  }
  return seen;
}

struct Apart {
  double place = 0, angle = 0;
};

template <class Build>
Apart greatestDifference(double seconds, Build build) {
  Apart worst;
  std::vector<Seen> first;
  for (const double rate : kRates) {
    const std::vector<Seen> seen = sixths(seconds, rate, build);
    if (first.empty()) first = seen;
    EXPECT_EQ(seen.size(), first.size());
    for (std::size_t i = 0; i < seen.size(); ++i) {
      worst.place = std::max(worst.place, (seen[i].p - first[i].p).norm());
      worst.angle = std::max(worst.angle, 2 * (seen[i].q.coeffs() - first[i].q.coeffs()).norm());
    }
  }
  return worst;
}

TEST(FrameRate, ABallBouncesAlike) {
  for (const double e : {1.0, 0.8, 0.5}) {
    const auto build = [&](World& w) {
      const FieldId g = addGravity(w);
      addFloor(w, 0, e);
      return std::vector{addBall(w, g, {.p = {0, 0, 1.1}, .restitution = e}),
                         addBall(w, g, {.p = {3, 0, 1.1}, .v = {1, 0.5, 0}, .restitution = e})};
    };
    EXPECT_LE(greatestDifference(e > 0.9 ? 20 : 6, build).place, 1e-8) << e;
  }
}

TEST(FrameRate, ThinWallsTurnBulletsAndDiscsAwayAlike) {
  for (const bool mesh : {false, true})
    for (const double v : {5., 10., 20., 50., 100., 200., 500., 1000.}) {
      const auto build = [&](World& w) {
        const Mesh sheet =
            meshOf({{0, -10, -10}, {0, 10, -10}, {0, 10, 30}, {0, -10, 30}}, {{0, 2, 1}, {0, 3, 2}});
        w.addCollider({mesh ? w.addShape(MeshShape(TriangleTree(sheet)))
                            : w.addShape(BoxShape{{{0, 0, 10}, Quat::Identity()}, {0.0005, 10, 20}}),
                       {},
                       {0.0, 0.5, 0.0}});
        std::vector<BodyId> all;
        for (int phase = 0; phase < 8; ++phase)
          all.push_back(addBall(w, 0,
                                {.radius = 0.02,
                                 .mass = 0.05,
                                 .p = {-1 - v / 60 * phase / 8, 0.3, 2.0 * phase},
                                 .v = {v, 0, 0},
                                 .restitution = 0.5}));
        return all;
      };
      EXPECT_LE(greatestDifference(0.5, build).place, 1e-5) << v << mesh;
    }
}

TEST(FrameRate, ThinWallsTurnTumblingDiscsAwayAlike) {
  for (const Vec3& omega : {Vec3(0, 40, 0), Vec3(0, 0, 40)}) {
    const auto build = [&](World& w) {
      w.addCollider(
          {w.addShape(BoxShape{{{0, 0, 10}, Quat::Identity()}, {0.0005, 10, 20}}), {}, {0.0, 0.5, 0.0}});
      std::vector<BodyId> all;
      for (int phase = 0; phase < 8; ++phase) {
        BodyDef d;
        const double r = 0.11, h = 0.012, m = 2;
        d.shape = w.addShape(
            CylinderShape{{Vec3::Zero(), Quat::FromTwoVectors(Vec3::UnitZ(), Vec3::UnitY())}, r, h});
        d.mass.mass = m;
        d.mass.inertia = {m * (3 * r * r + 4 * h * h) / 12, 0.5 * m * r * r,
                          m * (3 * r * r + 4 * h * h) / 12};
        d.pose.p = {-1 - 0.5 * phase / 8, 0.3, 2.0 * phase}, d.v = {30, 0, 0}, d.omega = omega;
        d.surface = {0.0, 0.5, 0.0};
        all.push_back(w.addBody(d));
      }
      return all;
    };
    const Apart a = greatestDifference(1, build);
    EXPECT_LE(a.place, 1e-3) << omega.transpose();
    EXPECT_LE(a.angle, 1e-2) << omega.transpose();
  }
}

TEST(FrameRate, ManySpinningBoxesFlyThroughAirAlike) {
  const auto build = [](World& w) {
    const FieldId g = addGravity(w);
    ForceField air;
    air.law = MediumField{1.0, 0.0, Vec3::Zero()};
    const FieldId medium = w.addField(air, true);
    Chance chance(3);
    std::vector<BodyId> all;
    for (int i = 0; i < 300; ++i) {
      BodyDef d;
      const Vec3 half(0.15, 0.1, 0.025);
      d.shape = w.addShape(BoxShape{{}, half});
      d.mass = massOfBox({}, half, 1).withMass(1);
      d.pose.p = {4.0 * (i % 18), 4.0 * (i / 18), 300};
      d.v = Vec3(0, 0, 10) + 0.5 * chance.vector(), d.omega = 3 * chance.vector();
      d.dragArea = 2 * 0.0132 * d.mass.mass;
      all.push_back(addSolid(w, g, d));
      w.hook(all.back(), medium, 0);
    }
    return all;
  };
  const Apart a = greatestDifference(2, build);
  std::printf("  swarm: %.1e m, %.1e rad\n", a.place, a.angle);
  EXPECT_LE(a.place, 1e-5);
  EXPECT_LE(a.angle, 1e-3);
}

}  // namespace
}  // namespace stadion
