#include "cli/assets/olympia/olympia.h"

namespace stadion::assets {
namespace {

void addWood(Part& to, Part from, Rgb colour) {
  paint(from, [&](const Vertex& v) { return mix(0.88, 1.06, noise(times(v.p, {3, 3, 14}))) * colour; });
  add(to, from);
}

}  // namespace

Parts whiteboard() {
  constexpr double kWidth = 3.2, kLow = 0.75, kHigh = 2.0;
  const Rgb oak{0.42, 0.29, 0.18};
  Part wood;
  wood.finish = {"oak", "", 0.85};
  const double x = kWidth / 2;
  for (double side : {-1.0, 1.0})
    addWood(wood,
            limb({side * (x + 0.05), 0.02, -0.2}, {side * (x + 0.05), 0.02, kHigh + 0.25}, 0.065, 0.05, 8),
            oak);
  addWood(wood, box({-x - 0.1, -0.01, kHigh}, {x + 0.1, 0.05, kHigh + 0.09}), oak);
  addWood(wood, box({-x - 0.1, -0.01, kLow - 0.09}, {x + 0.1, 0.05, kLow}), oak);
  Part planks;
  planks.finish = {"whitewash", "", 0.95};
  constexpr int kPlanks = 5;
  for (int i = 0; i < kPlanks; ++i) {
    const double a = mix(kLow, kHigh, double(i) / kPlanks), b = mix(kLow, kHigh, (i + 1.0) / kPlanks) - 0.006;
    Part plank = box({-x, 0.0, a}, {x, 0.03, b});
    paint(plank, [&](const Vertex&) {
      return mix(0.94, 1.0, noise({7.0 * i, 0.5, 0.5})) * Rgb{0.93, 0.90, 0.82};
    });
    add(planks, plank);
  }
  return {wood, planks};
}

}  // namespace stadion::assets
