/// Friction of flat contacts: as if pressure were even over their area, in spin, in slide and in both.

#include "dynamics/contact/flat_friction.h"
#include "engine/maths/functions.h"
#include "tests/dynamics/world/watch.h"

#include <gtest/gtest.h>

#include <functional>

namespace stadion {
namespace {

using namespace scenes;

constexpr double kMu = 0.1;

/// A prism over a polygon with an optional hole of as many corners.
Mesh prism(const std::vector<Vec2>& outer, const std::vector<Vec2>& inner, double half) {
  const auto n = static_cast<std::uint32_t>(outer.size());
  std::vector<Vec3> p;
  std::vector<std::array<std::uint32_t, 3>> t;
  for (const double z : {-half, half})
    for (const auto* ring : {&outer, &inner})
      for (const Vec2& x : *ring) p.emplace_back(x.x(), x.y(), z);
  const std::uint32_t layer = static_cast<std::uint32_t>(p.size()) / 2;
  const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    t.push_back({a, b, c}), t.push_back({a, c, d});
  };
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t k = (i + 1) % n;
    quad(i, k, layer + k, layer + i);
    if (inner.empty()) {
      if (i > 0 && i + 1 < n) t.push_back({0, k, i}), t.push_back({layer, layer + i, layer + k});
      continue;
    }
    quad(n + k, n + i, layer + n + i, layer + n + k);
    quad(i, n + i, n + k, k), quad(layer + i, layer + k, layer + n + k, layer + n + i);
  }
  return meshOf(p, t);
}

std::vector<Vec2> circle(double radius, int corners) {
  std::vector<Vec2> c;
  for (int i = 0; i < corners; ++i) {
    const double a = 2 * M_PI * i / corners;
    c.emplace_back(radius * std::cos(a), radius * std::sin(a));
  }
  return c;
}

std::vector<Vec2> rectangle(double x, double y) {
  return {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
}

/// Mean distance from its middle of the points of a rectangle with sides 2x and 2y.
double meanRadius(double x, double y) {
  const double d = std::hypot(x, y);
  return (2 * x * y * d + y * y * y * std::asinh(x / y) + x * x * x * std::asinh(y / x)) / (6 * x * y);
}

struct Plate {
  std::string name;
  std::function<Shape()> shape;
  double inertia;  ///< about the vertical, per kg [m2]
  double radius;   ///< mean distance from the middle [m]
};

std::vector<Plate> plates() {
  const double h = 0.05;
  const auto meshOfPrism = [=](std::vector<Vec2> outer, std::vector<Vec2> inner) {
    return [=] { return MeshShape(TriangleTree(prism(outer, inner, h))); };
  };
  std::vector<Plate> all;
  all.push_back({"disc", [=] { return CylinderShape{{}, 0.5, h}; }, 0.125, 1.0 / 3});
  all.push_back({"mesh disc", meshOfPrism(circle(0.5, 48), {}), 0.125, 1.0 / 3});
  std::vector<Vec3> corners;
  for (const Vec2& x : circle(0.5, 48))
    for (const double z : {-h, h}) corners.emplace_back(x.x(), x.y(), z);
  all.push_back({"convex disc", [=] { return *convexHull(corners); }, 0.125, 1.0 / 3});
  all.push_back({"ring", meshOfPrism(circle(0.5, 48), circle(0.3, 48)), 0.5 * (0.25 + 0.09),
                 2.0 / 3 * (0.125 - 0.027) / (0.25 - 0.09)});
  all.push_back({"square", [=] { return BoxShape{{}, {0.5, 0.5, h}}; }, 1.0 / 6, meanRadius(0.5, 0.5)});
  all.push_back({"mesh square", meshOfPrism(rectangle(0.5, 0.5), {}), 1.0 / 6, meanRadius(0.5, 0.5)});
  all.push_back({"rectangle",
                 [=] {
                   return BoxShape{{}, {0.6, 0.2, h}};
                 },
                 (0.36 + 0.04) / 3, meanRadius(0.6, 0.2)});
  all.push_back({"frame", meshOfPrism(rectangle(0.5, 0.5), rectangle(0.25, 0.25)),
                 (0.5 - 0.25 * 0.125) / 3 / 0.75,
                 (meanRadius(0.5, 0.5) - 0.25 * meanRadius(0.25, 0.25)) / 0.75});
  return all;
}

BodyId addPlate(World& w, FieldId g, const Plate& plate, double mass, const Vec3& p, const Vec3& v,
                double spin, double friction = kMu) {
  BodyDef d;
  d.shape = w.addShape(plate.shape());
  d.mass.mass = mass, d.mass.inertia = mass * plate.inertia * Vec3(0.5, 0.5, 1);
  d.surface = {friction, 0.0, 0.0};
  d.pose.p = p, d.v = v, d.omega = {0, 0, spin};
  return addSolid(w, g, d);
}

/// When it has turned for the last time, and how far.
std::pair<double, double> spinDown(World& w, BodyId b, double rate, double most = 3) {
  double angle = 0, until = 0, before = w.state(b).omega.z();
  play(w, most, rate, [&](double t) {
    const double now = w.state(b).omega.z();
    angle += 0.5 * (before + now) / rate;
    if (std::fabs(now) > 1e-6) until = t;
    before = now;
  });
  return {until, angle};
}

TEST(FlatFriction, ASpinningPlateStopsAsEvenPressureSays) {
  for (const Plate& plate : plates())
    for (const double rate : {30., 60., 144.}) {
      if (rate != 60 && plate.name != "disc" && plate.name != "ring") continue;
      World w;
      const FieldId g = addGravity(w);
      addFloor(w, kMu);
      const BodyId b = addPlate(w, g, plate, 3, {0, 0, 0.05}, Vec3::Zero(), 2);
      const double alpha = kMu * kG * plate.radius / plate.inertia;
      const auto [time, angle] = spinDown(w, b, rate, 1.5);
      EXPECT_NEAR(time, 2 / alpha, 1 / rate + 0.005) << plate.name << rate;
      EXPECT_NEAR(angle / (2 / alpha), 1, 0.01) << plate.name << rate;
      EXPECT_LT(w.state(b).p.head<2>().norm(), 1e-4) << plate.name << rate << ": it stays where it is";
    }
}

/// Points that share an area evenly.
std::vector<Vec2> samplesOf(const std::string& name) {
  std::vector<Vec2> points;
  constexpr int n = 40;
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) {
      const double x = (i + 0.5) / n, y = (k + 0.5) / n;
      if (name == "disc") {
        const double r = 0.5 * std::sqrt(x), a = 2 * M_PI * y;
        points.emplace_back(r * std::cos(a), r * std::sin(a));
      } else if (name == "square") {
        points.emplace_back(x - 0.5, y - 0.5);
      } else {
        points.emplace_back(1.2 * (x - 0.5), 0.4 * (y - 0.5));
      }
    }
  return points;
}

struct Stop {
  double time = 0, way = 0, angle = 0, ratio = 0;  ///< ratio: v / w shortly before the end
};

/// The same from a sum over the area, step by step.
Stop expected(const std::string& name, double inertia, double slide, double spin) {
  const std::vector<Vec2> points = samplesOf(name);
  Stop s;
  Vec2 v(slide, 0), p(0, 0);
  double w = spin;
  const double h = 4e-3;
  const auto pull = [&](const Vec2& u, double turn, double angle) {
    Vec3 sum = Vec3::Zero();
    const double c = std::cos(angle), d = std::sin(angle);
    for (const Vec2& x : points) {
      const Vec2 y(c * x.x() - d * x.y(), d * x.x() + c * x.y());
      const Vec2 at(u.x() - turn * y.y(), u.y() + turn * y.x());
      const Vec2 f = -at / (at.norm() + 1e-9);
      sum += Vec3(y.x() * f.y() - y.y() * f.x(), f.x(), f.y());
    }
    return Vec3(sum * (kMu * kG / static_cast<double>(points.size())));
  };
  while (v.norm() + 0.3 * std::fabs(w) > 2e-3 && s.time < 20) {
    const Vec3 k = pull(v, w, s.angle), half = 0.5 * h * k;
    const Vec3 m = pull(v + half.tail<2>(), w + half[0] / inertia, s.angle + 0.5 * h * w);
    if (v.norm() > 0.02) s.ratio = v.norm() / w;
    p += h * v + 0.5 * h * h * m.tail<2>(), s.angle += h * w + 0.5 * h * h * m[0] / inertia;
    v += h * m.tail<2>(), w += h * m[0] / inertia, s.time += h;
  }
  s.way = p.norm();
  return s;
}

TEST(FlatFriction, SlideAndSpinAreBrakedTogether) {
  // With even pressure they end at the same moment, however they begin (Farkas, Bartels, Unger, Wolf,
  // Frictional coupling between sliding and spinning motion, Phys. Rev. Lett. 90, 248302, 2003).
  for (const Plate& plate : plates()) {
    if (plate.name != "disc" && plate.name != "square" && plate.name != "rectangle") continue;
    for (const auto& [slide, spin] : {std::pair(0.5, 8.0), std::pair(2.0, 8.0), std::pair(3.0, 2.0)}) {
      World w;
      const FieldId g = addGravity(w);
      addFloor(w, kMu);
      const BodyId b = addPlate(w, g, plate, 3, {0, 0, 0.05}, {slide, 0, 0}, spin);
      const Stop truth = expected(plate.name, plate.inertia, slide, spin);
      double slides = 0, spins = 0, angle = 0, before = spin;
      play(w, truth.time + 0.3, 120, [&](double t) {
        const BodyState s = w.state(b);
        if (s.v.norm() > 1e-3) slides = t;
        if (std::fabs(s.omega.z()) > 3e-3) spins = t;
        angle += 0.5 * (before + s.omega.z()) / 120, before = s.omega.z();
      });
      const std::string what = plate.name + std::to_string(slide);
      EXPECT_NEAR(slides, spins, 0.02) << what;
      EXPECT_NEAR(slides / truth.time, 1, 0.005) << what;
      EXPECT_NEAR(w.state(b).p.head<2>().norm() / truth.way, 1, 0.005) << what;
      EXPECT_NEAR(angle / truth.angle, 1, 0.005) << what;
    }
  }
}

TEST(FlatFriction, ADiscEndsWithTheRatioOfTheory) {
  World w;
  const FieldId g = addGravity(w);
  addFloor(w, kMu);
  const BodyId b = addPlate(w, g, plates()[0], 3, {0, 0, 0.05}, {2, 0, 0}, 8);
  double ratio = 0;
  play(w, 4, 240, [&](double) {
    const BodyState s = w.state(b);
    if (s.v.norm() > 0.01) ratio = s.v.norm() / (0.5 * s.omega.z());
  });
  EXPECT_NEAR(ratio, 0.653, 0.01);
}

TEST(FlatFriction, APlateOnAMovingBodySpinsItAndKeepsTheMomentum) {
  World w;
  const FieldId g = addGravity(w);
  addFloor(w, 0);
  const BodyId low = addBox(w, g,
                            {.half = {2, 2, 0.1},
                             .mass = 50,
                             .pose = {{0, 0, 0.1}, Quat::Identity()},
                             .v = {0.3, 0, 0},
                             .friction = kMu});
  const Plate square = plates()[4];
  const BodyId high = addPlate(w, g, square, 3, {0, 0, 0.25}, {0.3, 0, 0}, 2);
  const double before = w.state(high).L.z();
  double until = 0;
  play(w, 1.5, 60, [&](double t) {
    if (std::fabs(w.state(high).omega.z() - w.state(low).omega.z()) > 1e-4) until = t;
  });
  const double lower = 50 * (4 + 4) / 3.0, upper = 3 * square.inertia;
  const double alpha = 3 * kMu * kG * square.radius * (1 / lower + 1 / upper);
  EXPECT_NEAR(until, 2 / alpha, 0.02);
  EXPECT_NEAR(w.state(high).omega.z(), before / (lower + upper), 1e-6);
  EXPECT_NEAR(w.state(high).v.x(), 0.3, 1e-6);
}

TEST(FlatFriction, OnTwoBeamsTheAreaIsWhatLiesOnThem) {
  World w;
  const FieldId g = addGravity(w);
  for (const double side : {-1.0, 1.0})
    w.addCollider(
        {w.addShape(BoxShape{{}, {1, 3, 0.1}}), {{side * 1.2, 0, -0.1}, Quat::Identity()}, {kMu, 0.0, 0.0}});
  // From x = -0.2 to 0.2 nothing is below it.
  const Plate square = plates()[4];
  const BodyId b = addPlate(w, g, square, 3, {0, 0, 0.05}, Vec3::Zero(), 0.2);
  const double radius = (meanRadius(0.5, 0.5) - 0.4 * meanRadius(0.2, 0.5)) / 0.6;
  const double alpha = kMu * kG * radius / square.inertia;
  // How the load is shared out among the eight points of two contacts is not determined.
  EXPECT_NEAR(spinDown(w, b, 120, 0.5).second / (0.02 / alpha), 1, 0.1);
}

TEST(FlatFriction, WhatLiesHalfOverAnEdgeIsHeldByItsLoadAndNoMore) {
  for (const double over : {0.1, 0.3, 0.45}) {
    World w;
    const FieldId g = addGravity(w);
    w.addCollider(
        {w.addShape(BoxShape{{}, {3, 3, 0.1}}), {{-3, 0, -0.1}, Quat::Identity()}, {kMu, 0.0, 0.0}});
    const Plate square = plates()[4];
    const BodyId b = addPlate(w, g, square, 3, {over - 0.5, 0, 0.05}, {0, 0.2, 0}, 1);
    Watch watch(w, {b});
    Vec3 v = w.state(b).v;
    double strongest = 0;
    play(w, 1.5, 120, [&](double) {
      watch.look();
      strongest = std::max(strongest, (w.state(b).v - v).head<2>().norm() * 120), v = w.state(b).v;
    });
    EXPECT_LE(strongest, kMu * kG * 1.001) << over;
    EXPECT_LE(watch.greatestGain, 1e-9) << over;
    EXPECT_NEAR(w.state(b).p.z(), 0.05, 2e-5) << over;
    EXPECT_LT(w.state(b).omega.norm(), 1e-9) << over << ": it has stopped";
  }
}

TEST(FlatFriction, ACrowdBrakesSpinLikeASinglePlate) {
  World w;
  const FieldId g = addGravity(w);
  addFloor(w, 0.8);
  addBox(w, g, {.half = {5, 5, 0.1}, .mass = 1e4, .pose = {{0, 0, 0.1}, Quat::Identity()}, .friction = 0.8});
  std::vector<BodyId> all;
  const std::vector<Plate> kinds = plates();
  for (int i = 0; i < 16; ++i)
    all.push_back(addPlate(w, g, kinds[i % 2 == 0 ? 0 : 4], 3, {2.0 * (i % 4) - 3, 2.0 * (i / 4) - 3, 0.25},
                           Vec3::Zero(), 2, 0.0125));
  std::vector<double> until(all.size());
  play(w, 1.2, 60, [&](double t) {
    for (std::size_t i = 0; i < all.size(); ++i)
      if (std::fabs(w.state(all[i]).omega.z()) > 1e-3) until[i] = t;
  });
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Plate& kind = kinds[i % 2 == 0 ? 0 : 4];
    EXPECT_NEAR(until[i], 2 * kind.inertia / (kMu * kG * kind.radius), 0.035) << i;
  }
}

TEST(FlatFriction, APlateThatLandsFlatLosesSpinAsItsAreaSays) {
  // A fall of 0.2 m ends at once: friction takes mu m v times the mean radius.
  for (const Plate& plate : plates()) {
    World w;
    const FieldId g = addGravity(w);
    addFloor(w, kMu);
    const BodyId b = addPlate(w, g, plate, 3, {0, 0, 0.25}, Vec3::Zero(), 4);
    double after = 0;
    const double lands = std::sqrt(2 * 0.2 / kG), speed = kG * lands;
    play(w, 0.4, 240, [&](double t) {
      if (t > lands + 0.001 && after == 0)
        after = w.state(b).omega.z() + kMu * kG * plate.radius / plate.inertia * (t - lands);
    });
    EXPECT_NEAR(4 - after, kMu * speed * plate.radius / plate.inertia, 0.01) << plate.name;
  }
}

TEST(ContactArea, ResistsLikeTheSumOverItsPoints) {
  const auto against = [](const ContactArea& area, const std::vector<Vec2>& points, const Vec3& slip) {
    Vec3 sum = Vec3::Zero();
    for (const Vec2& p : points) {
      const Vec2 y = (p - area.middle()) / area.radius();
      const Vec2 u = Vec2(slip[1] - slip[0] * y.y(), slip[2] + slip[0] * y.x()).normalized();
      sum += Vec3(y.x() * u.y() - y.y() * u.x(), u.x(), u.y());
    }
    return Vec3(sum / static_cast<double>(points.size()));
  };
  // An L of two rectangles that share an edge.
  ContactArea area;
  const Vec2 low[] = {{0, 0}, {2, 0}, {2, 1}, {0, 1}}, high[] = {{0, 1}, {1, 1}, {1, 3}, {0, 3}};
  area.addPolygon(low, 4), area.addPolygon(high, 4);
  ASSERT_TRUE(area.close());
  std::vector<Vec2> points;
  constexpr int n = 150;
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) {
      const Vec2 x(2.0 * (i + 0.5) / n, 3.0 * (k + 0.5) / n);
      if (x.y() < 1 || x.x() < 1) points.push_back(x);
    }
  EXPECT_NEAR(area.size(), 4, 1e-12);
  Chance chance(9);
  for (int i = 0; i < 30; ++i) {
    const Vec3 slip(chance.scale(1e-5, 1) * (i % 2 == 0 ? 1 : -1), chance.signedUnit(), chance.signedUnit());
    const ContactArea::Resistance r = area.against(slip);
    EXPECT_LT((r.force - against(area, points, slip)).norm(), 1e-3) << i;
    EXPECT_NEAR(r.loss, r.force.dot(slip), 1e-9 * slip.norm()) << i;
    EXPECT_LT((r.slope * slip).norm(), 1e-3 * slip.norm())
        << i << ": its strength is the same at every speed";
    const ContactArea::Need need = area.needFor(0.5 * r.force);
    EXPECT_NEAR(need.share, 0.5, 1e-7) << i;
  }
}

}  // namespace
}  // namespace stadion
