#include "assets/generator/olympia/olympia.h"
#include "assets/generator/olympia/spectators.h"
#include "assets/generator/olympia/stadium_shape.h"

// They sit in loose rows on the slope, in clusters, and look at what goes on near the start, where they are
// most. A few stand, most of them on the crest, in groups.

namespace stadion::assets {
namespace {

constexpr double kRow = 1.3, kSeat = 0.85;  // [m]

bool taken(Point p) {  // by the judges' stand or the altar
  return std::fabs(p.y - kStand.y) < 9.5 && std::fabs(p.x) < kTrackSide + 13;
}

/// From the stands of the games and the way to them.
double beside(Point p) {
  return length({std::max(std::fabs(p.x) - 7, 0.0), p.y < -9 ? -9 - p.y : std::max(p.y, 0.0), 0});
}

/// From where visitors are; what lies behind them counts as farther.
double farFrom(Point p) {
  return length({p.x, p.y < 12 ? std::min(3 * (p.y + 10), 0.0) : p.y - 12, 0});
}

Detail detailAt(double far) {
  return far < 17.5 ? Detail::Near : far < 40 ? Detail::Middle : Detail::Far;
}

/// Where people may sit on one side's embankment: along the track, then around the corner at the start.
std::vector<Point> seats(double side) {
  std::vector<Point> all;
  for (double d = 4.2; d < 28; d += kRow) {
    for (double y = -10; y < 202; y += kSeat) all.push_back({side * (kTrackSide + d), y, 0});
    for (double x = 3; x < kTrackSide + 0.6 * d; x += 1.6 * kSeat)
      all.push_back({side * x, kTrackLow - d, 0});
  }
  return all;
}

}  // namespace

std::vector<Spectator> spectatorsOn(double side) {
  Dice dice(side > 0 ? 11 : 12);
  std::vector<Spectator> all;
  for (const Point& seat : seats(side)) {
    const Point p = seat + Point{dice.between(-0.3, 0.3), dice.between(-0.3, 0.3), 0};
    const double cluster = roughNoise(0.11 * p + Point{31, 0, 0}, 2);
    const double near = smoothstep(60, 5, p.y), up = outside(p);
    const double full = p.y < -11 ? 0.26 : mix(0.18, 0.36, near) * smoothstep(kCrest + 2, kCrest - 6, up);
    const bool there =
        dice.even() < full * smoothstep(mix(0.42, 0.26, near), mix(0.64, 0.56, near), cluster) + 0.012;
    const Person person = somebody(dice, dice.even() < (up > 22 && cluster > 0.5 ? 0.4 : 0.05));
    if (!there || taken(p)) continue;
    const Point to{0, mix(22, std::max(p.y, -10.0), 0.45), 0};
    const double yaw = det::atan2(-(to.x - p.x), to.y - p.y) + 0.25 * (person.turn - 0.5);
    all.push_back({person,
                   {p.x, p.y, groundHeight(p) - 0.04},
                   yaw,
                   mix(0.92, 1.06, person.turn),
                   beside(p),
                   farFrom(p)});
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Spectator& a, const Spectator& b) { return a.near < b.near; });
  return all;
}

Parts crowd(double side, double low, double high) {
  Part people;
  people.finish = {"people", "", 0.95, 0};
  const std::vector<Spectator> all = spectatorsOn(side);
  for (std::size_t i = kNearSpectators; i < all.size(); ++i) {
    const Spectator& s = all[i];
    if (s.at.y < low || s.at.y >= high) continue;
    add(people, figure(s.person, detailAt(s.far)), {s.at, s.yaw, {s.size, s.size, s.size}});
  }
  return {people};
}

}  // namespace stadion::assets
