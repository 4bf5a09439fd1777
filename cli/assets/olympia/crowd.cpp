#include "cli/assets/olympia/olympia.h"
#include "cli/assets/olympia/person.h"
#include "cli/assets/olympia/stadium_shape.h"

// They sit in loose rows on the slope, in clusters, and look at what goes on near the start.

namespace stadion::assets {
namespace {

constexpr double kRow = 1.3, kSeat = 0.85;  // [m]

bool taken(Point p) {  // by the judges' stand or the altar
  return std::fabs(p.y - kStand.y) < 9.5 && std::fabs(p.x) < kTrackSide + 13;
}

Detail detailAt(Point p) {
  const double far = length({p.x, std::max(0.0, p.y - 12), 0});
  return far < 27 ? Detail::Near : far < 62 ? Detail::Middle : Detail::Far;
}

}  // namespace

Parts crowd(double side, double low, double high) {
  Dice dice(side > 0 ? 11 : 12);
  Part people;
  people.finish = {"people", "", 0.95, 0};
  for (double d = 4.2; d < 28; d += kRow) {
    for (double y = -8; y < 202; y += kSeat) {
      const Point p{side * (kTrackSide + d + dice.between(-0.3, 0.3)), y + dice.between(-0.3, 0.3), 0};
      const double cluster = roughNoise(0.11 * p + Point{31, 0, 0}, 2);
      const bool there = dice.even() < 0.45 * smoothstep(0.47, 0.66, cluster) + 0.015;
      const Person person = somebody(dice, dice.even() < (d > 24 ? 0.8 : 0.12));
      if (!there || taken(p) || p.y < low || p.y >= high) continue;
      const Point to{0, mix(22, p.y, 0.45), 0};
      const double yaw = det::atan2(-(to.x - p.x), to.y - p.y) + 0.25 * (person.turn - 0.5);
      const double size = mix(0.92, 1.06, person.turn);
      add(people, figure(person, detailAt(p)), {{p.x, p.y, groundHeight(p) - 0.04}, yaw, {size, size, size}});
    }
  }
  return {people};
}

}  // namespace stadion::assets
