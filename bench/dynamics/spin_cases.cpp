/// C03, C04: rotation that no torque acts on.

#include "bench/dynamics/cases.h"
#include "bench/dynamics/reference_solutions.h"

#include <algorithm>

namespace stadion::bench {
namespace {

V3 scaled(V3 a, V3 b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}

void spin(Outcome& out, V3 half, Form form, double mass, V3 omega0, double seconds) {
  Scene s(out, {0, 0, 0});
  BodySpec b;
  b.form = form;
  b.half = half;
  b.mass = mass;
  b.omega = omega0;
  const V3 inertia = b.inertia();
  for (int i = 0; i < kCopies; ++i) {
    b.p = {0, 0, 5.0 * i};
    s.add(b);
  }
  if (out.unsupported) return;
  const int frames = framesIn(seconds);
  const SpinReference exact(inertia, omega0, {}, kFrame, frames);
  const V3 L0 = scaled(inertia, omega0);
  const double E0 = 0.5 * dot(omega0, L0);
  double dE = 0, dL = 0, after1 = 0, after10 = 0, greatest = 0;
  for (int i = 1; i <= frames; ++i) {
    s.frame();
    const State st = s.state();
    const V3 inBody = rotate(conj(st.q), st.omega), L = scaled(inertia, inBody);
    dE = std::max(dE, std::fabs(0.5 * dot(inBody, L) / E0 - 1));
    dL = std::max(dL, norm(rotate(st.q, L) - L0) / norm(L0));
    const double angle = angleBetween(st.q, exact.q[static_cast<std::size_t>(i)]);
    greatest = std::max(greatest, angle);
    if (i == 60) after1 = angle;
    if (i == 600) after10 = angle;
  }
  out.m["err"] = after10;
  out.m["ang_1s"] = after1;
  out.m["ang_10s"] = after10;
  out.m["ang_max"] = greatest;
  out.m["dE"] = dE;
  out.m["dL"] = dL;
}

}  // namespace

void addSpinCases(CaseList& list) {
  const V3 disc{0.11, 0.023, 0.11};
  list.push_back({"C03_dzhanibekov_60s",
                  [](Outcome& o) {
                    spin(o, {0.15, 0.10, 0.025}, Form::Box, 1, {0.01, 5, 0.01}, 60);
                  },
                  everyStep(), 1});
  list.push_back({"C04_discus_40rad",
                  [disc](Outcome& o) {
                    spin(o, disc, Form::Cylinder, 2, {2, 40, 0}, 10);
                  },
                  everyStep(), 3});
  list.push_back({"C04_spinner_300rad",
                  [disc](Outcome& o) {
                    spin(o, disc, Form::Cylinder, 2, {30, 300, 0}, 10);
                  },
                  everyStep(), 3});
}

}  // namespace stadion::bench
