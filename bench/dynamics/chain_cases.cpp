/// C12: five balls in a row, the first hits the others; 27 balls in a closed box. Nothing is lost (e = 1).

#include "bench/dynamics/cases.h"

#include <algorithm>
#include <random>

namespace stadion::bench {
namespace {

void cradle(Outcome& out, double gap) {
  Scene s(out, {0, 0, 0});
  if (s.lacks(s.engine().canBounce())) return;
  for (int i = 0; i < 5; ++i) {
    BodySpec b;
    b.half = {0.05, 0.05, 0.05};
    b.restitution = 1;
    b.p = {i == 0 ? -0.3 : (0.1 + gap) * i, 0, 0};
    if (i == 0) b.v = {1, 0, 0};
    s.add(b);
  }
  for (int i = 0; i < 90; ++i) s.frame();
  double worst = 0, momentum = 0, energy = 0;
  for (int i = 0; i < 5; ++i) {
    const double v = s.state(i).v.x;
    worst = std::max(worst, std::fabs(v - (i == 4 ? 1 : 0)));
    momentum += v;
    energy += v * v;
  }
  out.m["err"] = worst;
  out.m["P_err"] = momentum - 1;
  out.m["E_err"] = energy - 1;
}

double& along(V3& v, int axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

/// Six thick walls around a room of 1 m.
void addRoom(Scene& s, V3 centre) {
  for (int k = 0; k < 6; ++k) {
    BodySpec wall;
    wall.form = Form::Box;
    wall.fixed = true;
    wall.restitution = 1;
    wall.half = {0.75, 0.75, 0.75};
    wall.p = centre;
    along(wall.half, k / 2) = 0.15;
    along(wall.p, k / 2) += (k & 1 ? 1 : -1) * 0.65;
    s.add(wall);
  }
}

void cluster(Outcome& out) {
  constexpr int kBalls = 27;
  Scene s(out, {0, 0, 0});
  if (s.lacks(s.engine().canBounce())) return;
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> u(-1, 1);
  for (int i = 0; i < kBalls; ++i) {
    BodySpec b;
    b.half = {0.05, 0.05, 0.05};
    b.restitution = 1;
    b.p = {0.12 * (i % 3), 0.12 * (i / 3 % 3), 0.12 * (i / 9)};
    b.v = {3 * u(generator), 3 * u(generator), 3 * u(generator)};
    s.add(b);
  }
  const V3 centre{0.12, 0.12, 0.12};
  addRoom(s, centre);
  const auto energy = [&] {
    double E = 0;
    for (int i = 0; i < kBalls; ++i) {
      const V3 v = s.state(i).v;
      E += 0.5 * dot(v, v);
    }
    return E;
  };
  const double E0 = energy();
  double worst = 0;
  for (int i = 0; i < 300; ++i) {
    s.frame();
    worst = std::max(worst, std::fabs(energy() / E0 - 1));
  }
  int escaped = 0;
  for (int i = 0; i < kBalls; ++i) {
    const V3 p = s.state(i).p - centre;
    if (std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)}) > 0.5) ++escaped;
  }
  out.m["err"] = std::fabs(energy() / E0 - 1);
  out.m["E_maxdev"] = worst;
  out.m["E_final_ratio"] = energy() / E0;
  out.m["escaped"] = escaped;
}

}  // namespace

void addChainCases(CaseList& list) {
  list.push_back({"C12_cradle_touch", [](Outcome& o) { cradle(o, 0); }, everyStep(), 3});
  list.push_back({"C12_cradle_gap1mm", [](Outcome& o) { cradle(o, 1e-3); }, everyStep(), 3});
  list.push_back({"C12_cluster27", cluster, everyStep(), 1});
}

}  // namespace stadion::bench
