#include "assets/generator/olympia/olympia.h"

namespace stadion::assets {
namespace {

constexpr double kWidth = 3.2, kLow = 0.75, kHigh = 2.0, kThick = 0.03;  // [m] of the painted panel
constexpr Rgb kOak{0.42, 0.29, 0.18}, kRed{0.58, 0.20, 0.13}, kBlue{0.20, 0.31, 0.45};

void addWood(Part& to, Part from) {
  paint(from, [&](const Vertex& v) { return mix(0.88, 1.06, noise(times(v.p, {3, 3, 14}))) * kOak; });
  add(to, from);
}

/// Paint on one face of the panel: rectangles in the face's own x to the right and z up.
class Face {
public:
  Face(Part& part, bool front) : part_(part), front_(front) {}

  void stroke(double x0, double z0, double x1, double z1, Rgb colour) const {
    const double y = front_ ? -0.003 : kThick + 0.003, side = front_ ? 1 : -1;
    addQuad(part_, {Vertex{{side * x0, y, z0}, colour}, Vertex{{side * x1, y, z0}, colour},
                    Vertex{{side * x1, y, z1}, colour}, Vertex{{side * x0, y, z1}, colour}});
  }

  void frame(double in, double thick, Rgb colour) const {
    const double x = kWidth / 2 - in, low = kLow + in, high = kHigh - in;
    stroke(-x, low, x, low + thick, colour), stroke(-x, high - thick, x, high, colour);
    stroke(-x, low, -x + thick, high, colour), stroke(x - thick, low, x, high, colour);
  }

  /// A meander: a line that runs into itself and out again, `repeats` times between -x and x.
  void meander(double x, double z, double height, int repeats) const {
    const double every = 2 * x / repeats, t = height / 7, s = every / 8;
    for (int i = 0; i < repeats; ++i) {
      const double a = -x + i * every;
      stroke(a, z, a + 8 * s, z + t, kRed);
      stroke(a, z, a + s, z + 7 * t, kRed);
      stroke(a, z + 6 * t, a + 6 * s, z + 7 * t, kRed);
      stroke(a + 5 * s, z + 2 * t, a + 6 * s, z + 7 * t, kRed);
      stroke(a + 2.5 * s, z + 2 * t, a + 6 * s, z + 3 * t, kRed);
      stroke(a + 2.5 * s, z + 2 * t, a + 3.5 * s, z + 4.5 * t, kRed);
    }
  }

  /// A wreath of olive, open at the top: two rows of leaves on a bent twig.
  void wreath(Point middle, double radius) const {
    constexpr int kLeaves = 15;
    for (int i = 0; i < kLeaves; ++i)
      for (double half : {-1.0, 1.0})
        for (double row : {-1.0, 1.0}) {
          const double at = half * mix(0.1, 2.7, (i + 0.5) / kLeaves);
          const auto [s, c] = det::sincos(at);
          leaf(middle + radius * Point{s, 0, -c}, at + half * (kPi / 2 - 0.55 * row), 0.36 * radius);
        }
  }

private:
  void leaf(Point foot, double turn, double length) const {
    const auto [s, c] = det::sincos(turn);
    const Point along = length * Point{s, 0, -c}, across = 0.16 * length * Point{c, 0, s};
    const double y = front_ ? -0.003 : kThick + 0.003, side = front_ ? 1 : -1;
    const Rgb green{0.30, 0.38, 0.19};
    const auto at = [&](Point p) { return Vertex{{side * p.x, y, p.z}, green}; };
    addQuad(part_,
            {at(foot), at(foot + 0.45 * along - across), at(foot + along), at(foot + 0.45 * along + across)});
  }

  Part& part_;
  bool front_;
};

}  // namespace

Parts whiteboard() {
  Part wood;
  wood.finish = {"oak", "", 0.85};
  const double x = kWidth / 2;
  for (double side : {-1.0, 1.0})
    addWood(wood,
            limb({side * (x + 0.05), 0.02, -0.2}, {side * (x + 0.05), 0.02, kHigh + 0.25}, 0.065, 0.05, 8));
  addWood(wood, box({-x - 0.1, -0.01, kHigh}, {x + 0.1, 0.05, kHigh + 0.09}));
  addWood(wood, box({-x - 0.1, -0.01, kLow - 0.09}, {x + 0.1, 0.05, kLow}));
  // The planks are whitewashed over: their joints do not show.
  Part panel;
  panel.finish = {"whitewash", "", 0.95};
  constexpr int kPlanks = 5;
  for (int i = 0; i < kPlanks; ++i) {
    const double a = mix(kLow, kHigh, double(i) / kPlanks), b = mix(kLow, kHigh, (i + 1.0) / kPlanks);
    Part plank = box({-x, 0.0, a}, {x, kThick, b});
    paint(plank, [](const Vertex& v) { return mix(0.95, 1.0, noise(2.3 * v.p)) * Rgb{0.93, 0.90, 0.82}; });
    add(panel, plank);
  }
  Face(panel, true).frame(0.05, 0.014, kRed);
  // The back shows a meander above and below, and the winner's wreath.
  const Face back(panel, false);
  back.frame(0.05, 0.02, kBlue);
  back.meander(x - 0.14, kHigh - 0.32, 0.18, 12), back.meander(x - 0.14, kLow + 0.14, 0.18, 12);
  back.wreath({0, 0, 0.5 * (kLow + kHigh) + 0.02}, 0.24);
  return {wood, panel};
}

}  // namespace stadion::assets
