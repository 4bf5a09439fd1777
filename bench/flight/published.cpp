#include "bench/flight/published.h"

#include "bench/flight/objects.h"

#include <array>
#include <cmath>

namespace stadion::bench {
namespace {

/// Returns the distance with the shipped model and the default step, fine enough that its error does not
/// matter.
double distanceOf(const Throw& t) {
  constexpr int kRate = 240;
  const ThingFacts& f = factsOf(t.thing);
  const FlightStepper stepper(f.shipped, f.body, t.air(), 1.0 / kRate, f.axis);
  FlightState s{t.start.p, t.start.v, t.start.q, momentumOf(f.body, f.axis, t.start.q, t.start.w)};
  const Trajectory path = flyBy(t, kRate, [&](RigidFlight& r) {
    stepper.step(s);
    r.p = s.p;
    r.v = s.v;
  });
  const Vec3 end = path.back().at.p;
  return std::sqrt(end.x() * end.x() + end.y() * end.y());
}

using Angles = std::array<double, 3>;  ///< release, pitch, roll [degrees]

double discusDistance(const Angles& a) {
  return distanceOf(thrown(Thing::Discus, 25, a[0], a[1] - a[0], a[2], Vec3(0, 0, -42), Vec3::Zero()));
}

/// Hill climbing: changes one angle after the other in ever smaller steps while the distance grows.
double climb(Angles& a) {
  double best = discusDistance(a);
  for (double stride = 8; stride > 0.05; stride *= 0.5)
    for (bool better = true; better;) {
      better = false;
      for (std::size_t i = 0; i < a.size(); ++i)
        for (const double way : {-1.0, 1.0}) {
          Angles b = a;
          b[i] += way * stride;
          const double d = discusDistance(b);
          if (d > best + 1e-6) {
            best = d;
            a = b;
            better = true;
          }
        }
    }
  return best;
}

}  // namespace

PublishedThrows measurePublishedThrows() {
  PublishedThrows p;
  for (const double roll : {0.0, 30.0, -30.0}) {  // there may be several summits
    Angles a{37, 30, roll};
    const double d = climb(a);
    if (d > p.discusRange) {
      p.discusRange = d;
      p.gamma = a[0];
      p.pitch = a[1];
      p.roll = a[2];
    }
  }
  p.javelinRange = distanceOf(thrown(Thing::Javelin, 30, 34, 0, 0, Vec3::Zero(), Vec3::Zero()));
  p.checks.push_back({"discus, best throw at 25 m/s and 42 rad/s (69.39 m +- 5 %)", p.discusRange,
                      69.39 * 1.05, 69.39 * 0.95, "m"});
  p.checks.push_back({"javelin at 30 m/s and 34 degrees", p.javelinRange, 91, 85, "m"});
  return p;
}

}  // namespace stadion::bench
