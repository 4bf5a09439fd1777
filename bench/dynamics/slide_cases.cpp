/// C07: a box slides to a stop, and sticks or slips on a slope; C08: a block just stands or just tips.

#include "bench/dynamics/cases.h"

#include "engine/maths/angles.h"

#include <algorithm>
#include <array>
#include <limits>

namespace stadion::bench {
namespace {

constexpr double kMu = 0.5;

BodySpec slidingBox() {
  BodySpec b;
  b.form = Form::Box;
  b.half = {0.15, 0.05, 0.15};
  b.friction = kMu;
  return b;
}

/// Starts at 3 m/s, 30 degrees from the box's axes.
void slideToAStop(Outcome& out) {
  const double v0 = 3, way = kPi / 6;
  Scene s(out);
  s.engine().addGround(0, kMu);
  BodySpec b = slidingBox();
  for (int i = 0; i < kCopies; ++i) {
    b.p = {0, 0.05, 4.0 * i};
    b.v = {v0 * std::cos(way), 0, v0 * std::sin(way)};
    s.add(b);
  }
  double worst = 0;
  for (int i = 1; i <= 120; ++i) {
    s.frame();
    const double t = std::min(i * kFrame, v0 / (kMu * kG)), d = v0 * t - 0.5 * kMu * kG * t * t;
    const V3 p = s.state().p;
    worst = std::max(worst, norm({p.x - d * std::cos(way), 0, p.z - d * std::sin(way)}));
  }
  const V3 p = s.state().p;
  out.m["err"] = worst;
  out.m["stop_dist_relerr"] = std::hypot(p.x, p.z) / (v0 * v0 / (2 * kMu * kG)) - 1;
  out.m["dir_err_deg"] = (std::atan2(p.z, p.x) - way) * 180 / kPi;
}

void onASlope(Outcome& out, bool slips) {
  const double slope = std::atan(kMu * (slips ? 1.02 : 0.98));
  Scene s(out, {kG * std::sin(slope), -kG * std::cos(slope), 0});
  s.engine().addGround(0, kMu);
  BodySpec b = slidingBox();
  for (int i = 0; i < kCopies; ++i) {
    b.p = {0, 0.05, 4.0 * i};
    s.add(b);
  }
  const int frames = slips ? 180 : 600;
  for (int i = 0; i < frames; ++i) s.frame();
  const double t = frames * kFrame, x = s.state().p.x;
  const double exact = slips ? 0.5 * kG * (std::sin(slope) - kMu * std::cos(slope)) * t * t : 0;
  out.m[slips ? "slip_abserr" : "creep_10s"] = x - exact;
  if (slips) out.m["slip_expected"] = exact;
}

void slide(Outcome& out) {
  slideToAStop(out);
  onASlope(out, false);
  onASlope(out, true);
}

/// Time until a block of diagonal 2 r on its lower edge has turned by half a radian.
double tippingTime(double r, double beyond) {
  const auto pull = [&](double angle) { return 0.75 * kG / r * std::sin(angle + beyond); };
  double angle = 0, before = 0, w = 0, t = 0;
  const double h = 1e-5;
  while (angle < 0.5) {
    before = angle;
    const double k1 = w, l1 = pull(angle), k2 = w + h / 2 * l1, l2 = pull(angle + h / 2 * k1);
    const double k3 = w + h / 2 * l2, l3 = pull(angle + h / 2 * k2), k4 = w + h * l3,
                 l4 = pull(angle + h * k3);
    angle += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    w += h / 6 * (l1 + 2 * l2 + 2 * l3 + l4);
    t += h;
  }
  return t - (angle - 0.5) / (angle - before) * h;
}

/// Time at which copy 0 has turned by half a radian; NaN if it never does. Between frames by the cubic
/// through four of them: a straight line would be 1.2e-4 s early here, more than what is to be measured.
double timeToTip(Scene& s) {
  std::array<double, 4> angle{};  // of the last four frames
  for (int i = 1; i <= 300; ++i) {
    s.frame();
    angle = {angle[1], angle[2], angle[3], angleBetween(s.state().q, {})};
    if (angle[2] < 0.5) continue;
    double low = -2, high = -1;  // frames before this one
    for (int k = 0; k < 50; ++k) {
      const double x = 0.5 * (low + high);
      const double at = -angle[0] * (x + 2) * (x + 1) * x / 6 + angle[1] * (x + 3) * (x + 1) * x / 2 -
                        angle[2] * (x + 3) * (x + 2) * x / 2 + angle[3] * (x + 3) * (x + 2) * (x + 1) / 6;
      (at < 0.5 ? low : high) = x;
    }
    return (i + low) * kFrame;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

void tip(Outcome& out) {
  const double threshold = std::atan2(0.1, 0.3), r = std::hypot(0.1, 0.3), beyond = 0.02;
  BodySpec b;
  b.form = Form::Box;
  b.half = {0.1, 0.3, 0.1};
  b.friction = 1;
  for (const double side : {-1.0, 1.0}) {
    const double slope = threshold + side * beyond;
    Scene s(out, {kG * std::sin(slope), -kG * std::cos(slope), 0});
    s.engine().addGround(0, 1);
    for (int i = 0; i < kCopies; ++i) {
      b.p = {0, 0.3, 3.0 * i};
      s.add(b);
    }
    if (side < 0) {
      double tilt = 0;
      for (int i = 0; i < 300; ++i) {
        s.frame();
        tilt = std::max(tilt, angleBetween(s.state().q, {}));
      }
      out.m["stable_tilt"] = tilt;
    } else {
      const double exact = tippingTime(r, beyond), seen = timeToTip(s);
      out.m["tip_time_ref"] = exact;
      out.m["err"] = std::isfinite(seen) ? std::fabs(seen - exact) : 99;
    }
  }
}

}  // namespace

void addSlideCases(CaseList& list) {
  list.push_back({"C07_slide", slide, everyStep(), 3});
  list.push_back({"C08_tip", tip, everyStep(), 3});
}

}  // namespace stadion::bench
