#include "assets/generator/craft/models.h"

#include <cmath>

// Level outlines, one above the other from the sole to the knee, joined by bands of triangles.

namespace stadion::assets {
namespace {

constexpr int kRound = 24;  // points of an outline
enum : std::uint32_t { Sole, Boot, Sock, Stripe, Skin };

struct Outline {
  double z, heel, toe, half;  // [m] height, rear end, front end, half width
  double taper;               // how much narrower the rear is than the ball of the foot
  std::uint32_t paint;        // of the band above
};

constexpr Outline kOutlines[] = {
    {0.000, -0.070, 0.205, 0.040, 0.25, Sole}, {0.014, -0.075, 0.205, 0.046, 0.25, Boot},
    {0.032, -0.075, 0.203, 0.047, 0.25, Boot}, {0.052, -0.073, 0.190, 0.045, 0.22, Boot},
    {0.068, -0.070, 0.150, 0.043, 0.18, Boot}, {0.085, -0.066, 0.105, 0.041, 0.12, Boot},
    {0.105, -0.062, 0.062, 0.039, 0.06, Sock}, {0.140, -0.056, 0.044, 0.037, 0.00, Sock},
    {0.200, -0.062, 0.042, 0.043, 0.00, Sock}, {0.270, -0.074, 0.046, 0.053, 0.00, Sock},
    {0.330, -0.078, 0.050, 0.057, 0.00, Sock}, {0.380, -0.072, 0.052, 0.056, 0.00, Stripe},
    {0.398, -0.069, 0.053, 0.055, 0.00, Sock}, {0.410, -0.067, 0.054, 0.055, 0.00, Skin},
    {0.450, -0.062, 0.060, 0.054, 0.00, Skin}, {0.490, -0.060, 0.064, 0.055, 0.00, Skin},
    {0.510, -0.050, 0.054, 0.046, 0.00, Skin},
};

struct FootDirection {
  double c, s;
};

// The unit circle in steps of 15 degrees from square roots alone, so that it is the same everywhere.
FootDirection direction(int n) {
  const double s15 = (std::sqrt(6.0) - std::sqrt(2.0)) / 4, c15 = (std::sqrt(6.0) + std::sqrt(2.0)) / 4;
  const double r2 = std::sqrt(0.5), r3 = std::sqrt(0.75);
  const FootDirection quarter[] = {{1, 0}, {c15, s15}, {r3, 0.5}, {r2, r2}, {0.5, r3}, {s15, c15}};
  const FootDirection d = quarter[n % 6];
  switch (n / 6 % 4) {
  case 0: return d;
  case 1: return {-d.s, d.c};
  case 2: return {-d.c, -d.s};
  default: return {d.s, -d.c};
  }
}

Point onOutline(const Outline& o, int n) {
  const FootDirection d = direction(n);  // c points forward, s to the left
  const double middle = 0.5 * (o.heel + o.toe), reach = 0.5 * (o.toe - o.heel);
  const double narrow = 1 - o.taper * 0.5 * (1 - d.c);
  return {-o.half * d.s * narrow, middle + reach * d.c, o.z};
}

}  // namespace

Model crudeFoot() {
  Model model;
  model.name = "foot";
  model.paints = {{"sole", {235, 235, 235}, "", 5},
                  {"boot", {30, 34, 46}, "", 40},
                  {"sock", {176, 24, 32}, "", 2},
                  {"stripe", {240, 240, 240}, "", 2},
                  {"skin", {214, 164, 132}, "", 10}};
  const auto rings = static_cast<std::uint32_t>(std::size(kOutlines));
  for (const Outline& o : kOutlines)
    for (int n = 0; n < kRound; ++n) model.points.push_back(onOutline(o, n));
  const auto at = [](std::uint32_t ring, std::uint32_t n) { return ring * kRound + n % kRound; };
  for (std::uint32_t r = 0; r + 1 < rings; ++r) {
    for (std::uint32_t n = 0; n < kRound; ++n) {
      model.triangles.push_back({{at(r, n), at(r, n + 1), at(r + 1, n + 1)}, kOutlines[r].paint});
      model.triangles.push_back({{at(r, n), at(r + 1, n + 1), at(r + 1, n)}, kOutlines[r].paint});
    }
  }
  const Outline &low = kOutlines[0], &high = kOutlines[rings - 1];
  const auto under = static_cast<std::uint32_t>(model.points.size()), over = under + 1;
  model.points.push_back({0, 0.5 * (low.heel + low.toe), low.z});
  model.points.push_back({0, 0.5 * (high.heel + high.toe), high.z + 0.012});
  for (std::uint32_t n = 0; n < kRound; ++n) {
    model.triangles.push_back({{under, at(0, n + 1), at(0, n)}, Sole});
    model.triangles.push_back({{over, at(rings - 1, n), at(rings - 1, n + 1)}, Skin});
  }
  return model;
}

}  // namespace stadion::assets
