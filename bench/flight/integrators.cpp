#include "bench/flight/integrators.h"

#include "dynamics/flight/split_step.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/format.h>

namespace stadion::bench {
namespace {

constexpr int kRates[] = {30, 60, 120, 240, 480, 960};
constexpr double kRounding = 1e-13, kLost = 1e-2;  ///< errors between them show the order
constexpr std::size_t kTimed = 15;                 ///< flights for timing; the median counts

/// Explicit in everything but positions, including gyroscopic torque, as a simple engine does it.
void eulerStep(RigidFlight& f, double h, const runge_kutta::FlightConditions& s, const AnyModel& model) {
  const Wrench air = model(Vec3(f.q.conjugate() * (f.v - s.wind)), f.w);
  f.v += h * (s.gravity + f.q * air.force / s.mass);
  f.w += h * (air.torque - f.w.cross(s.inertia.cwiseProduct(f.w))).cwiseQuotient(s.inertia);
  f.p += h * f.v;
  f.q = (f.q * det::expRotation(h * f.w)).normalized();
}

using Fly = std::function<Trajectory(const Throw&, int hz)>;

Trajectory byEuler(const Throw& t, int hz) {
  const auto around = t.conditions();
  const AnyModel& model = factsOf(t.thing).exact;
  return flyBy(t, hz, [&](RigidFlight& f) { eulerStep(f, 1.0 / hz, around, model); });
}
Trajectory byDefault(const Throw& t, int hz) {
  const ThingFacts& facts = factsOf(t.thing);
  FlightState s{t.start.p, t.start.v, t.start.q, momentumOf(facts.body, facts.axis, t.start.q, t.start.w)};
  const FlightAir air = t.air();
  return flyBy(t, hz, [&](RigidFlight& f) {
    splitStep(s, facts.body, facts.axis, air, 1.0 / hz, facts.exact);
    f = {s.p, s.v, s.q, angularVelocityOf(facts.body, facts.axis, s)};
  });
}
Trajectory byRungeKutta(const Throw& t, int hz) {
  const auto around = t.conditions();
  const AnyModel& model = factsOf(t.thing).exact;
  return flyBy(t, hz, [&](RigidFlight& f) { runge_kutta::step4(f, 1.0 / hz, around, model); });
}

struct Scheme {
  const char* name;
  Fly fly;
};
const Scheme kSchemes[] = {{"euler", byEuler}, {"default", byDefault}, {"rk4", byRungeKutta}};

double medianCost(const Scheme& scheme, const Throw& t, int hz) {
  std::vector<double> ns;
  for (std::size_t i = 0; i < kTimed; ++i) {
    const auto start = std::chrono::steady_clock::now();
    const Trajectory flight = scheme.fly(t, hz);
    const std::chrono::duration<double, std::nano> took = std::chrono::steady_clock::now() - start;
    ns.push_back(took.count() / std::max(1.0, flight.back().t * hz));
  }
  std::ranges::nth_element(ns, ns.begin() + kTimed / 2);
  return ns[kTimed / 2];
}

IntegratorResult measure(Thing thing, const Scheme& scheme, int hz,
                         const std::vector<ReferenceFlight>& flights) {
  IntegratorResult r{thing, scheme.name, hz, 0, 0, 0, 0};
  for (const ReferenceFlight& f : flights) {
    const FlightErrors e = errorsOf(scheme.fly(f.release, hz), f.path, factsOf(thing).axis);
    const double n = static_cast<double>(flights.size());
    r.landing += e.landing * e.landing / n;
    r.attitude += e.attitude / n;
    // A lost flight gives no number.
    r.worst = std::isnan(e.landing) || e.landing > r.worst ? e.landing : r.worst;
  }
  r.landing = std::sqrt(r.landing);
  r.ns = medianCost(scheme, flights.front().release, hz);
  return r;
}

void addChecks(Integrators& all) {
  for (const IntegratorResult& r : all.results) {
    const std::string name = fmt::format("{} {} at {} Hz: ", factsOf(r.thing).name, r.scheme, r.hz);
    if (r.scheme == "rk4" && r.hz == 960)
      all.checks.push_back({name + "landing, worst reference flight", r.worst, 1e-5, 0, ""});
    if (r.scheme != "default" || r.hz != 60 || r.thing == Thing::Ball) continue;
    const bool javelin = r.thing == Thing::Javelin;
    all.checks.push_back({name + "landing", 100 * r.landing, javelin ? 0.05 : 0.1, 0, "%"});
    if (!javelin) all.checks.push_back({name + "attitude", r.attitude, 0.15, 0, "deg"});
  }
}

}  // namespace

double Integrators::order(Thing thing, const std::string& scheme) const {
  // The slope of the least-squares line through log(error) over log(rate).
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const IntegratorResult& r : results) {
    if (r.thing != thing || r.scheme != scheme || !(r.landing > kRounding && r.landing < kLost)) continue;
    const double u = std::log(r.hz), v = std::log(r.landing);
    n += 1;
    x += u;
    y += v;
    xx += u * u;
    xy += u * v;
  }
  return n < 2 ? std::numeric_limits<double>::quiet_NaN() : (x * y - n * xy) / (n * xx - x * x);
}

std::vector<Measurement> Integrators::measurements(Thing thing) const {
  std::vector<Measurement> all;
  for (const IntegratorResult& r : results) {
    if (r.thing != thing || r.hz < 60) continue;
    Measurement m;
    m.engine = r.scheme;
    m.caseName = factsOf(thing).name;
    m.n = r.hz / 60;
    m.ns = r.ns * m.n;
    m.m["err"] = r.landing;
    all.push_back(m);
  }
  return all;
}

Integrators measureIntegrators(const std::vector<ReferenceFlight>& references) {
  Integrators all;
  for (const Thing thing : {Thing::Javelin, Thing::Discus, Thing::Ball}) {
    std::vector<ReferenceFlight> flights;
    std::ranges::copy_if(references, std::back_inserter(flights),
                         [thing](const ReferenceFlight& f) { return f.release.thing == thing && f.smooth; });
    for (const Scheme& scheme : kSchemes)
      for (const int hz : kRates) all.results.push_back(measure(thing, scheme, hz, flights));
  }
  addChecks(all);
  return all;
}

}  // namespace stadion::bench
