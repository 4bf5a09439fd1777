/// C14: a thousand balls fall into a bowl of 4 x 4 m; C15: five thousand spinning boxes fly with drag.

#include "bench/dynamics/cases.h"
#include "bench/dynamics/reference_solutions.h"

#include <algorithm>
#include <random>

namespace stadion::bench {
namespace {

constexpr int kBalls = 1000;
constexpr double kBallRadius = 0.1, kBallMass = 0.1;

void addBowl(Scene& s) {
  s.engine().addGround(0.3, 0.5);
  BodySpec wall;
  wall.form = Form::Box;
  wall.fixed = true;
  wall.restitution = 0.3;
  wall.friction = 0.5;
  for (int k = 0; k < 4; ++k) {
    const double d = (k & 1 ? 1 : -1) * 2.25;
    wall.half = k < 2 ? V3{0.25, 6, 2.5} : V3{2.5, 6, 0.25};
    wall.p = k < 2 ? V3{d, 6, 0} : V3{0, 6, d};
    s.add(wall);
  }
}

void addBalls(Scene& s) {
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> u(-0.03, 0.03);
  for (int i = 0; i < kBalls; ++i) {
    BodySpec b;
    b.mass = kBallMass;
    b.restitution = 0.3;
    b.friction = 0.5;
    const double x = u(generator), z = u(generator);
    b.p = {-1.35 + 0.3 * (i % 10) + x, 0.5 + 0.3 * (i / 100), -1.35 + 0.3 * (i / 10 % 10) + z};
    s.add(b);
  }
}

struct Energy {
  double moving = 0, all = 0;
};

Energy energyOf(Scene& s, std::vector<V3>& places) {
  Energy e;
  for (int j = 0; j < kBalls; ++j) {
    const State st = s.state(j);
    places[static_cast<std::size_t>(j)] = st.p;
    const double inertia = 0.4 * kBallMass * kBallRadius * kBallRadius;
    const double moving = 0.5 * kBallMass * dot(st.v, st.v) + 0.5 * inertia * dot(st.omega, st.omega);
    e.moving += moving;
    e.all += moving + kBallMass * kG * st.p.y;
  }
  return e;
}

/// How deep balls are in each other and, as `deepest` counts too, in the ground.
std::vector<double> overlaps(const std::vector<V3>& places, double& deepest) {
  std::vector<double> all;
  deepest = 0;
  for (std::size_t a = 0; a < places.size(); ++a) {
    for (std::size_t b = a + 1; b < places.size(); ++b) {
      const V3 d = places[a] - places[b];
      const double square = dot(d, d);
      if (square >= 4 * kBallRadius * kBallRadius) continue;
      all.push_back(2 * kBallRadius - std::sqrt(square));
      deepest = std::max(deepest, all.back());
    }
    deepest = std::max(deepest, kBallRadius - places[a].y);
  }
  std::sort(all.begin(), all.end());
  return all;
}

void pile(Outcome& out) {
  Scene s(out, {0, -kG, 0}, 1100);
  if (s.lacks(s.engine().canBounce())) return;
  addBowl(s);
  addBalls(s);
  std::vector<V3> places(kBalls);
  double pen = 0, penEnd = 0, rise = 0, E0 = 0, before = 1e30;
  Energy energy;
  for (int i = 1; i <= 600; ++i) {
    s.frame();
    energy = energyOf(s, places);
    if (i == 1) E0 = energy.all;
    rise = std::max(rise, (energy.all - before) / E0);
    before = energy.all;
    if (i % 20 != 0) continue;
    const std::vector<double> all = overlaps(places, penEnd);
    pen = std::max(pen, penEnd);
    if (i == 600) out.m["pen_p99_end"] = all.empty() ? 0 : all[all.size() * 99 / 100];
  }
  int escaped = 0;
  double fastest = 0;
  for (int j = 0; j < kBalls; ++j) {
    const State st = s.state(j);
    if (std::fabs(st.p.x) > 2.1 || std::fabs(st.p.z) > 2.1 || st.p.y < -0.1 || !std::isfinite(st.p.y))
      ++escaped;
    else
      fastest = std::max(fastest, norm(st.v));
  }
  out.m["max_pen"] = pen;
  out.m["pen_end"] = penEnd;
  out.m["escaped"] = escaped;
  out.m["E_rise_max"] = rise;
  out.m["vmax_end"] = fastest;
  out.m["ke_end"] = energy.moving;
  out.m["worst_frame_ms"] = out.worst * 1e3;
  out.m["err"] = pen;
}

void swarm(Outcome& out) {
  Scene s(out, {0, -kG, 0}, 5100);
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> u(-1, 1);
  const double k = 0.0132;
  const int frames = 120;
  std::vector<BodySpec> bodies;
  for (int i = 0; i < 5000; ++i) {
    BodySpec b;
    b.form = Form::Box;
    b.half = {0.15, 0.1, 0.025};
    b.p = {4.0 * (i % 71), 300, 4.0 * (i / 71)};
    b.v = {0.5 * u(generator), 10 + 0.5 * u(generator), 0.5 * u(generator)};
    b.omega = {3 * u(generator), 3 * u(generator), 3 * u(generator)};
    const int id = s.add(b);
    s.drag(id, k, b.mass);
    bodies.push_back(b);
  }
  for (int i = 0; i < frames; ++i) s.frame();
  double place = 0, angle = 0;
  for (int i = 0; i < 5000; i += 250) {
    const BodySpec& b = bodies[static_cast<std::size_t>(i)];
    const DragReference flight(b.p, b.v, {0, -kG, 0}, k, kFrame, frames, 50);
    const SpinReference spin(b.inertia(), b.omega, {}, kFrame, frames, 2);
    const State st = s.state(i);
    place = std::max(place, norm(st.p - flight.p.back()));
    angle = std::max(angle, angleBetween(st.q, spin.q.back()));
  }
  out.m["err"] = place;
  out.m["ang_err"] = angle;
  out.m["worst_frame_ms"] = out.worst * 1e3;
}

}  // namespace

void addCrowdCases(CaseList& list) {
  list.push_back({"C14_pile1000", pile, {1, 4}, 1});
  list.push_back({"C15_swarm5000", swarm, {1, 4}, 3});
}

}  // namespace stadion::bench
