#include "bench/flight/objects.h"

#include "bench/flight/bodies.h"
#include "engine/base/plain_file.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace stadion::bench {
namespace {

ThingFacts javelinFacts() {
  const FlightShape shape = measureShape(bodies::javelin(96), Vec3(-1.05, 0, 0));
  return {"javelin",       {.806, 1.5e-4, .42}, 0,    2.0, StripJavelin(kDensity),
          javelinFlight(), rodFrom(shape),      shape};
}
ThingFacts discusFacts() {
  const FlightShape shape = measureShape(bodies::discus(96), Vec3::Zero());
  return {"discus",       {2.0, .0131, .0073}, 2,    1.8, WingDiscus(kDensity),
          discusFlight(), plateFrom(shape),    shape};
}
ThingFacts ballFacts() {
  constexpr double kInertia = 2.0 / 3 * .43 * .11 * .11;
  const FlightShape shape = measureShape(bodies::ball(.11), Vec3::Zero());
  return {"ball",           {.43, kInertia, kInertia}, 0,    .11, CrisisBall(kDensity),
          footballFlight(), ballFrom(shape),           shape};
}

/// A number in a file's name: "25" of "disc_25_35_s40_a-10", "-10" after the letter a.
struct Named {
  std::string name;
  double after(const std::string& mark, double otherwise) const {
    const std::size_t at = name.find(mark);
    return at == std::string::npos ? otherwise : std::atof(name.c_str() + at + mark.size());
  }
  bool has(const std::string& part) const { return name.find(part) != std::string::npos; }
};

Throw releaseOf(const std::string& name, const Trajectory& path) {
  const Named n{name};
  Throw t;
  t.name = name;
  t.start = path.front().at;
  t.thing = n.has("jav_") ? Thing::Javelin : n.has("disc_") ? Thing::Discus : Thing::Ball;
  t.wind = Vec3(n.after("_tail", 0) - n.after("_head", 0), n.after("_xwind", 0), 0);
  return t;
}

/// Reproducible on every machine, unlike the library's distributions.
struct Random {
  std::uint64_t state;
  double between(double low, double high) {
    std::uint64_t z = state += 0x9e3779b97f4a7c15;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9;
    z = (z ^ z >> 27) * 0x94d049bb133111eb;
    z ^= z >> 31;
    return low + (high - low) * static_cast<double>(z >> 11) * 0x1p-53;
  }
};

/// Returns the moment at which the centre reaches the ground, with both ends' velocities kept.
TrajectorySample landingBetween(const Trajectory& step) {
  double low = step[0].t, high = step[1].t;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (sampleAt(step, middle).p.z() > 0 ? low : high) = middle;
  }
  return {high, sampleAt(step, high)};
}

}  // namespace

const ThingFacts& factsOf(Thing thing) {
  static const ThingFacts javelin = javelinFacts(), discus = discusFacts(), ball = ballFacts();
  return thing == Thing::Javelin ? javelin : thing == Thing::Discus ? discus : ball;
}

runge_kutta::FlightConditions Throw::conditions() const {
  const ThingFacts& f = factsOf(thing);
  return {f.body.mass, f.inertia(), Vec3(0, 0, -kGravity), wind};
}

FlightAir Throw::air() const {
  return {Vec3(0, 0, -kGravity), wind, kDensity};
}

Throw thrown(Thing thing, double speed, double gamma, double alpha, double roll, const Vec3& w_A,
             const Vec3& wind) {
  Throw t;
  t.thing = thing;
  t.wind = wind;
  const double g = gamma * kDegree;
  t.start.p = Vec3(0, 0, factsOf(thing).height);
  t.start.v = speed * Vec3(std::cos(g), 0, std::sin(g));
  t.start.q = Quat(Eigen::AngleAxisd((gamma + alpha) * kDegree, -Vec3::UnitY())) *
              Quat(Eigen::AngleAxisd(roll * kDegree, Vec3::UnitX()));
  t.start.w = w_A;
  return t;
}

Result<std::vector<ReferenceFlight>> referenceFlights(const std::string& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error))
    if (entry.path().extension() == ".csv" &&
        entry.path().stem().string().find("coeffs") == std::string::npos)
      names.push_back(entry.path().string());
  std::sort(names.begin(), names.end());
  std::vector<ReferenceFlight> flights;
  for (const std::string& name : names) {
    const auto text = readPlainFile(name, 1 << 20);
    if (!text) return text.error();
    auto path = readTrajectory(text.value(), name);
    if (!path) return path.error();
    const std::string stem = std::filesystem::path(name).stem();
    flights.push_back(
        {releaseOf(stem, path.value()), path.value(), stem.find("tumble") == std::string::npos});
  }
  if (flights.empty())
    return Result<std::vector<ReferenceFlight>>::failure("there are no reference flights in " + folder);
  return flights;
}

std::vector<Throw> heldOut(Thing thing, int count) {
  Random random{20041200 + static_cast<std::uint64_t>(thing)};
  std::vector<Throw> throws;
  for (int i = 0; i < count; ++i) {
    const auto pick = [&random](double low, double high) { return random.between(low, high); };
    const Vec3 wind(pick(-5, 5), pick(-5, 5), 0);
    Throw t;
    if (thing == Thing::Javelin) {
      const double speed = pick(22, 30), gamma = pick(28, 40), alpha = pick(-8, 8), rate = pick(-.3, .3);
      t = thrown(thing, speed, gamma, alpha, pick(-180, 180), Vec3(0, rate, 0), wind);
    } else if (thing == Thing::Discus) {
      const double speed = pick(21, 25), gamma = pick(30, 40), alpha = pick(-15, 8), roll = pick(-15, 15);
      t = thrown(thing, speed, gamma, alpha, roll, Vec3(0, pick(-.5, .5), -40), wind);
    } else {
      const double speed = pick(15, 30), gamma = pick(15, 30);
      t = thrown(thing, speed, gamma, 0, 0, Vec3(pick(-60, 60), pick(-60, 60), pick(-60, 60)), wind);
    }
    t.name = "held out " + std::to_string(i);
    throws.push_back(t);
  }
  return throws;
}

Trajectory flyBy(const Throw& release, int hz, const std::function<void(RigidFlight&)>& step) {
  Trajectory flight{{0, release.start}};
  RigidFlight now = release.start;
  for (int n = 1; n <= 20 * hz; ++n) {
    const RigidFlight before = now;
    step(now);
    const double t = static_cast<double>(n) / hz;
    if (now.p.z() <= 0 || !now.p.allFinite()) {
      flight.push_back(landingBetween({{t - 1.0 / hz, before}, {t, now}}));
      return flight;
    }
    if (n % (hz / 10) == 0) flight.push_back({t, now});
  }
  return flight;
}

Trajectory flyExactly(const Throw& release, double tolerance) {
  runge_kutta::DormandPrince method(tolerance);
  const runge_kutta::FlightConditions around = release.conditions();
  const AnyModel& model = factsOf(release.thing).exact;
  return flyBy(release, 100, [&](RigidFlight& f) { method.advance(f, 0.01, around, model); });
}

FlightErrors errorsOf(const Trajectory& flight, const Trajectory& exact, int axis) {
  const double range = exact.back().at.p.x();
  const Vec3 off = flight.back().at.p - exact.back().at.p;
  FlightErrors e;
  e.range = std::fabs(off.x() / range);
  e.landing = std::hypot(off.x(), off.y()) / std::fabs(range);
  int count = 0;
  for (const TrajectorySample& s : flight) {
    const auto same =
        std::ranges::find_if(exact, [&s](const TrajectorySample& x) { return std::fabs(x.t - s.t) < 1e-6; });
    if (same == exact.end() || s.t == 0) continue;
    const Vec3 a = s.at.q * Vec3::Unit(axis), b = same->at.q * Vec3::Unit(axis);
    e.attitude += std::atan2(a.cross(b).norm(), a.dot(b)) / kDegree;
    ++count;
  }
  if (count) e.attitude /= count;
  return e;
}

}  // namespace stadion::bench
