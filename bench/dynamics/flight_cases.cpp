/// C01, C02: a football (m 0.43 kg, r 0.11 m) thrown without and with quadratic drag.

#include "bench/dynamics/cases.h"
#include "bench/dynamics/reference_solutions.h"

#include <algorithm>

namespace stadion::bench {
namespace {

void projectile(Outcome& out, double k, V3 v0, double seconds) {
  Scene s(out);
  const V3 p0{0, 1.5, 0};
  for (int i = 0; i < kCopies; ++i) {
    BodySpec b;
    b.half = {0.11, 0.11, 0.11};
    b.mass = 0.43;
    b.p = p0 + V3{0, 0, 20.0 * i};
    b.v = v0;
    const int id = s.add(b);
    if (k > 0) s.drag(id, k, b.mass);
  }
  const int frames = framesIn(seconds);
  const DragReference exact(p0, v0, {0, -kG, 0}, k, kFrame, frames);
  double place = 0, speed = 0;
  for (int i = 1; i <= frames; ++i) {
    s.frame();
    const State st = s.state();
    const auto at = static_cast<std::size_t>(i);
    place = std::max(place, norm(st.p - exact.p[at]));
    speed = std::max(speed, norm(st.v - exact.v[at]));
  }
  out.m["err"] = place;
  out.m["err_end"] = norm(s.state().p - exact.p.back());
  out.m["verr"] = speed;
}

}  // namespace

void addFlightCases(CaseList& list) {
  list.push_back({"C01_ballistic", [](Outcome& o) { projectile(o, 0, {20, 15, 3}, 2.5); }, everyStep(), 3});
  list.push_back({"C02_drag_football",
                  [](Outcome& o) {
                    projectile(o, 0.0132, {25, 12, 3}, 2.5);
                  },
                  everyStep(), 3});
  list.push_back({"C02_drag_beachball",
                  [](Outcome& o) {
                    projectile(o, 0.354, {25, 12, 0}, 2.5);
                  },
                  everyStep(), 3});
}

}  // namespace stadion::bench
