/// C11: a football that starts slipping at 5 m/s and comes to roll, on a plane and on a mesh.

#include "bench/dynamics/cases.h"

#include <algorithm>

namespace stadion::bench {
namespace {

void roll(Outcome& out, bool mesh) {
  const double r = 0.11, mu = 0.3, v0 = 5, seconds = 2;
  Scene s(out);
  if (!mesh)
    s.engine().addGround(0, mu);
  else if (s.lacks(s.engine().addMesh(gridMesh(-5, 45, -5, 35, 80, 64, 0, mu))))
    return;
  for (int i = 0; i < 8; ++i) {
    BodySpec b;
    b.half = {r, r, r};
    b.mass = 0.43;
    b.friction = mu;
    b.p = {0, r, 2.0 * i};
    b.v = {v0, 0, 0};
    s.add(b);
  }
  const double grip = 2 * v0 / (7 * mu * kG);  // when it no longer slips
  const auto slipped = [&](double t) { return v0 * t - 0.5 * mu * kG * t * t; };
  double worst = 0, hop = 0;
  for (int i = 1; i <= framesIn(seconds); ++i) {
    s.frame();
    const double t = i * kFrame;
    const double x = t < grip ? slipped(t) : slipped(grip) + 5.0 / 7 * v0 * (t - grip);
    const V3 p = s.state().p;
    worst = std::max(worst, std::hypot(p.x - x, p.z));
    hop = std::max(hop, std::fabs(p.y - r));
  }
  out.m["err"] = worst;
  out.m["vend_relerr"] = s.state().v.x / (5.0 / 7 * v0) - 1;
  out.m["hop"] = hop;
}

}  // namespace

void addRollCases(CaseList& list) {
  list.push_back({"C11_roll_plane", [](Outcome& o) { roll(o, false); }, everyStep(), 3});
  list.push_back({"C11_roll_mesh", [](Outcome& o) { roll(o, true); }, threeSteps(), 3});
}

}  // namespace stadion::bench
