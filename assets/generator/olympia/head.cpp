#include "assets/generator/craft/sculpt.h"
#include "assets/generator/olympia/body.h"

namespace stadion::assets {
namespace {

struct Look {
  Rgb skin{0.82, 0.57, 0.42}, hair, band;
  bool beard = false;
};

Look lookOf(Hair hair) {
  switch (hair) {
  case Hair::Dark: return {{0.80, 0.58, 0.44}, {0.17, 0.11, 0.08}, {0.68, 0.17, 0.14}, false};
  case Hair::Fair: return {{0.80, 0.58, 0.44}, {0.50, 0.33, 0.16}, {0.92, 0.89, 0.82}, false};
  case Hair::Bearded: break;
  }
  return {{0.80, 0.58, 0.44}, {0.14, 0.10, 0.08}, {0.24, 0.34, 0.52}, true};
}

constexpr Point kSkull{0, -0.006, 0.168};

Clay faceClay() {
  Clay clay;
  clay.rod({0, -0.012, -0.06}, {0, -0.004, 0.08}, 0.058, 0.054).ball(kSkull, {0.073, 0.093, 0.085}, 0.03);
  clay.rods({0.036, -0.012, 0.07}, {0.012, 0.045, -0.045}, 0.014, 0.012, 0.02);
  clay.ball({0, 0.035, 0.118}, {0.057, 0.058, 0.083}, 0.03)
      .ball({0, 0.044, 0.068}, {0.044, 0.046, 0.036}, 0.03);
  clay.ball({0, 0.084, 0.052}, {0.020, 0.016, 0.016}, 0.02)
      .balls({0.042, 0.062, 0.112}, {0.020, 0.020, 0.017}, 0.02);
  clay.rods({0.006, 0.092, 0.152}, {0.040, 0.080, 0.150}, 0.011, 0.010, 0.012);
  clay.rod({0, 0.090, 0.150}, {0, 0.114, 0.106}, 0.0085, 0.0115, 0.012)
      .balls({0.0105, 0.103, 0.102}, {0.0085, 0.010, 0.008}, 0.008);
  clay.hollow({0.0305, 0.098, 0.133}, {0.016, 0.016, 0.0105}, 0.012)
      .hollow({-0.0305, 0.098, 0.133}, {0.016, 0.016, 0.0105}, 0.012);
  clay.balls({0.030, 0.0745, 0.133}, {0.0125, 0.0125, 0.0105}, 0.002);
  clay.ball({0, 0.0955, 0.0835}, {0.021, 0.010, 0.0065}, 0.006)
      .ball({0, 0.0935, 0.0725}, {0.018, 0.010, 0.0065}, 0.006);
  clay.balls({0.073, 0.004, 0.118}, {0.009, 0.019, 0.029}, 0.008);
  return clay;
}

/// Whether locks grow there.
bool hairy(Point p, const Look& look) {
  const Point d = p - kSkull;
  const double front = 0.045 - 0.55 * (p.z - 0.19);  // the hairline goes back towards the temples
  const bool scalp = d.z > 0.028 - 0.75 * (0.04 - d.y) * (d.y < 0.04 ? 1 : 0) && p.z > 0.075 &&
                     (d.z > 0.03 || d.y < front - 0.02);
  const bool chin = look.beard && p.z < 0.105 && p.z > 0.02 && p.y > 0.0 &&
                    !(std::fabs(p.x) < 0.022 && p.z > 0.066 && p.z < 0.094);
  return scalp || chin;
}

}  // namespace

Parts head(Hair hair, double step) {
  const Look look = lookOf(hair);
  const Clay face = faceClay();
  Clay clay = face;
  // Locks, spread evenly over the skull by the golden angle and drawn to its surface.
  for (int i = 0; i < 420; ++i) {
    const double z = 1 - 2 * (i + 0.5) / 420, r = std::sqrt(1 - z * z);
    const auto [s, c] = det::sincos(2.39996322972865 * i);
    Point p = kSkull + Point{0.1 * r * c, 0.12 * r * s, 0.13 * z};
    for (int n = 0; n < 4; ++n) p = p - face.distance(p) * face.outward(p);
    if (hairy(p, look)) clay.ball(p, {0.0125, 0.0125, 0.0115}, 0.004);
  }
  const auto bandAt = [](Point p) { return std::fabs(p.z - (0.186 - 0.12 * p.y)); };
  clay.relief([&](Point p) { return bandAt(p) < 0.0105 && p.z > 0.12 ? 0.003 : 0.0; });
  Part part = clay.cast(step, [&](Point p, Point n) {
    if (bandAt(p) < 0.0105 && p.z > 0.13) return look.band;
    const double eye =
        std::min(length(p - Point{0.030, 0.0855, 0.133}), length(p - Point{-0.030, 0.0855, 0.133}));
    if (eye < 0.0055) return Rgb{0.13, 0.09, 0.07};
    if (eye < 0.0095) return Rgb{0.90, 0.87, 0.82};
    const double grain = roughNoise(60 * p, 2);
    if (face.distance(p) > 0.003 && p.y < 0.105) return mix(0.75, 1.3, grain) * look.hair;
    const bool brow =
        std::fabs(p.z - 0.153) < 0.005 && std::fabs(p.x) > 0.010 && std::fabs(p.x) < 0.046 && p.y > 0.06;
    if (brow) return mix(look.skin, look.hair, 0.75);
    if (p.y > 0.085 && std::fabs(p.z - 0.078) < 0.010 && std::fabs(p.x) < 0.022) return Rgb{0.66, 0.38, 0.31};
    const double blush = smoothstep(0.03, 0.0, length(p - Point{p.x < 0 ? -0.042 : 0.042, 0.075, 0.105}));
    return mix(0.97, 1.03, grain) *
           mix(mix(0.82, 1.0, smoothstep(-0.5, 0.3, n.z)) * look.skin, Rgb{0.80, 0.46, 0.36}, 0.35 * blush);
  });
  part.finish = {"head", "", 0.6, 0};
  return {part};
}

}  // namespace stadion::assets
