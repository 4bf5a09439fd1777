/// C10: boxes of half a metre on each other, awake for a minute; a heavy box on a light one.

#include "bench/dynamics/cases.h"

#include <algorithm>

namespace stadion::bench {
namespace {

void stack(Outcome& out, int boxes, double ratio, double seconds) {
  Scene s(out);
  s.engine().addGround(0, 0.5);
  for (int i = 0; i < boxes; ++i) {
    BodySpec b;
    b.form = Form::Box;
    b.half = {0.25, 0.25, 0.25};
    b.friction = 0.5;
    b.mass = ratio > 1 && i == boxes - 1 ? ratio : 1;
    b.p = {0, 0.25 + 0.5 * i, 0};
    s.add(b);
  }
  const int frames = framesIn(seconds), top = boxes - 1;
  double deepest = 0, fastest = 0;
  for (int i = 1; i <= frames; ++i) {
    s.frame();
    double below = -0.25;
    for (int j = 0; j < boxes; ++j) {
      const State st = s.state(j);
      deepest = std::max(deepest, 0.5 - (st.p.y - below));
      below = st.p.y;
      if (i > frames - 60) fastest = std::max(fastest, norm(st.v));
    }
    if (!(deepest < 1e9)) {
      out.m["err"] = 99;
      return;
    }
  }
  const State st = s.state(top);
  const double sink = 0.25 + 0.5 * top - st.p.y, drift = std::hypot(st.p.x, st.p.z);
  out.m["max_pen"] = deepest;
  out.m["top_sink"] = sink;
  out.m["drift"] = drift;
  out.m["tilt"] = angleBetween(st.q, {});
  out.m["res_speed"] = fastest;
  out.m["err"] = std::max(std::fabs(sink), drift);
  out.m["fell"] = sink > 0.25;
}

}  // namespace

void addStackCases(CaseList& list) {
  list.push_back({"C10_stack10_60s", [](Outcome& o) { stack(o, 10, 1, 60); }, threeSteps(), 1});
  list.push_back({"C10_ratio100", [](Outcome& o) { stack(o, 2, 100, 10); }, everyStep(), 1});
  list.push_back({"C10_ratio1000", [](Outcome& o) { stack(o, 2, 1000, 10); }, everyStep(), 1});
}

}  // namespace stadion::bench
