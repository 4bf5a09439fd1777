/// C05, C06: a ball dropped from 1 m, on a plane and, flying sideways, on a flat mesh of 10 240 triangles.

#include "bench/dynamics/cases.h"
#include "bench/dynamics/reference_solutions.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>

namespace stadion::bench {
namespace {

constexpr double kRadius = 0.1, kDrop = 1;

/// What is noted of copy 0 while it bounces.
struct Bounces {
  double e;
  double sum = 0, worstTime = 0, lateral = 0, jitter = 0, highest = 0, before = 0;
  int counted = 0, bounces = 0;
  std::vector<std::vector<double>> energy =
      std::vector<std::vector<double>>(64);  ///< heights it would rise to, by the number of bounces

  void see(double t, double h, double v) {
    int k = 0;
    const double exact = bounceHeight(kDrop, e, kG, t, &k);
    const double speed = std::sqrt(2 * kG * kDrop) * std::pow(e, k);
    const bool live = 2 * speed / kG > 3 * kFrame;  // hops of fewer frames are not seen well enough
    if (live) {
      sum += (h - exact) * (h - exact);
      ++counted;
    }
    if (before < -0.3 * speed && v > 0.02) {
      ++bounces;
      const double since = (-v + std::sqrt(std::max(0.0, v * v + 2 * kG * h))) / kG;
      if (live && bounces <= 20)
        worstTime = std::max(worstTime, std::fabs(t - since - bounceTime(kDrop, e, kG, bounces)));
    }
    const double rise = h + v * v / (2 * kG);
    if (bounces < 64) energy[static_cast<std::size_t>(bounces)].push_back(rise);
    highest = std::max(highest, rise);
    before = v;
  }

  /// Relative error of the apex after q bounces.
  double apex(std::size_t q) const {
    if (energy[q].size() < 3) return std::numeric_limits<double>::quiet_NaN();
    std::vector<double> sorted = energy[q];
    std::sort(sorted.begin(), sorted.end());
    return sorted[sorted.size() / 2] / (kDrop * std::pow(e, 2 * static_cast<double>(q))) - 1;
  }
};

void bounce(Outcome& out, double e, double seconds, bool mesh, V3 sideways) {
  Scene s(out);
  if (s.lacks(s.engine().canBounce())) return;
  if (!mesh)
    s.engine().addGround(e, 0);
  else if (s.lacks(s.engine().addMesh(gridMesh(-5, 45, -5, 35, 80, 64, e, 0))))
    return;
  const int copies = mesh ? 8 : kCopies;
  for (int i = 0; i < copies; ++i) {
    BodySpec b;
    b.half = {kRadius, kRadius, kRadius};
    b.restitution = e;
    b.p = {0, kDrop + kRadius, 2.0 * i};
    b.v = sideways;
    s.add(b);
  }
  Bounces seen{e};
  const int frames = framesIn(seconds);
  for (int i = 1; i <= frames; ++i) {
    s.frame();
    const State st = s.state();
    const double h = st.p.y - kRadius, t = i * kFrame;
    if (!(std::fabs(h) < 1e9)) {
      out.m["nan"] = 1;
      return;
    }
    seen.see(t, h, st.v.y);
    seen.lateral = std::max(seen.lateral, std::hypot(st.p.x - sideways.x * t, st.p.z - sideways.z * t));
    if (seconds - t < 1) seen.jitter = std::max(seen.jitter, std::fabs(st.v.y));
  }
  out.m["err"] = std::sqrt(seen.sum / std::max(1, seen.counted));
  out.m["time_err_max"] = seen.worstTime;
  out.m["apex1"] = seen.apex(1);
  out.m["apex3"] = seen.apex(3);
  if (e > 0.7) {
    out.m["apex5"] = seen.apex(5);
    out.m["apex10"] = seen.apex(10);
  }
  if (e > 0.9) out.m["apex20"] = seen.apex(20);
  out.m["lateral"] = seen.lateral;
  out.m["bounces"] = seen.bounces;
  out.m["maxE_over_E0"] = seen.highest / kDrop;
  if (e < 0.9 && !mesh) {
    out.m["rest_h"] = s.state().p.y - kRadius;
    out.m["rest_jitter"] = seen.jitter;
  }
}

}  // namespace

void addBounceCases(CaseList& list) {
  for (const double e : {1.0, 0.8, 0.5})
    list.push_back({fmt::format("C05_bounce_e{:.1f}", e),
                    [e](Outcome& o) { bounce(o, e, e > 0.9 ? 20 : 6, false, {}); }, everyStep(), 3});
  list.push_back({"C06_bounce_mesh_e0.8",
                  [](Outcome& o) {
                    bounce(o, 0.8, 3, true, {5, 0, 1.3});
                  },
                  everyStep(), 3});
}

}  // namespace stadion::bench
