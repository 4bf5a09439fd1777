#include "assets/generator/olympia/anatomy.h"

namespace stadion::assets {
namespace {

struct Colours {
  Rgb hair, band;
  bool beard;
};

Colours coloursOf(Hair hair) {
  switch (hair) {
  case Hair::Dark: return {{0.17, 0.11, 0.08}, {0.68, 0.17, 0.14}, false};
  case Hair::Fair: return {{0.50, 0.33, 0.16}, {0.92, 0.89, 0.82}, false};
  case Hair::Grey: return {{0.56, 0.53, 0.49}, {0.86, 0.72, 0.34}, true};
  case Hair::Bearded: break;
  }
  return {{0.14, 0.10, 0.08}, {0.24, 0.34, 0.52}, true};
}

constexpr Point kSkull{0, -0.006, 0.168};

void addFace(Clay& clay) {
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
}

/// Whether locks grow there.
bool hairy(Point p) {
  const Point d = p - kSkull;
  const double front = 0.045 - 0.55 * (p.z - 0.19);  // the hairline goes back towards the temples
  return d.z > 0.028 - 0.75 * (0.04 - d.y) * (d.y < 0.04 ? 1 : 0) && p.z > 0.075 &&
         (d.z > 0.03 || d.y < front - 0.02);
}

bool bearded(Point p) {
  const double x = std::fabs(p.x), cheek = mix(0.062, 0.125, smoothstep(0.03, 0.068, x));
  const bool lips = x < 0.021 && p.z > 0.066 && p.z < 0.090;
  return p.z < std::max(cheek, x < 0.026 && p.y > 0.07 ? 0.099 : 0.0) && p.z > 0.012 && p.y > 0.012 && !lips;
}

double fromBand(Point p) {
  return std::fabs(p.z - (0.186 - 0.12 * p.y));
}

}  // namespace

HeadClay::HeadClay(const Look& look) {
  const Colours colours = coloursOf(look.hair);
  hair_ = colours.hair, band_ = colours.band, beard_ = colours.beard;
  addFace(face_);
  addLocks(420, false);
  if (beard_) addLocks(1100, true);
}

void HeadClay::addLocks(int count, bool beard) {
  // Spread evenly over the skull by the golden angle and drawn to its surface.
  for (int i = 0; i < count; ++i) {
    const double z = 1 - 2 * (i + 0.5) / count, r = std::sqrt(1 - z * z);
    const auto [s, c] = det::sincos(2.39996322972865 * i);
    Point p = kSkull + Point{0.1 * r * c, 0.12 * r * s, 0.13 * z};
    for (int n = 0; n < 4; ++n) p = p - face_.distance(p) * face_.outward(p);
    if (beard ? bearded(p) : hairy(p)) locks_.push_back(p);
  }
}

bool HeadClay::near(Point p) const {
  return std::any_of(locks_.begin(), locks_.end(), [&](const Point& lock) {
    const Point d = p - lock;
    return dot(d, d) < 0.0185 * 0.0185;
  });
}

void HeadClay::addTo(Clay& clay, int bone, const Pose& X) const {
  clay.on(bone, X);
  addFace(clay);
  for (const Point& p : locks_) {
    const bool chin = p.y > 0 && p.z < 0.105;  // shorter and softer
    clay.ball(p, chin ? Point{0.0115, 0.0095, 0.0125} : Point{0.0125, 0.0125, 0.0115}, chin ? 0.008 : 0.004);
  }
}

double HeadClay::band(Point p) const {
  return p.z > 0.12 ? 0.003 * smoothstep(0.014, 0.009, fromBand(p)) : 0.0;
}

void HeadClay::straighten(Part& part, Point neck) const {
  for (Vertex& v : part.vertices) {
    const Point p = v.p - neck;
    if (p.z < 0.12) continue;
    const double over = p.z - (0.186 - 0.12 * p.y), edge = over < 0 ? -0.0105 : 0.0105;
    if (std::fabs(over - edge) < 0.0050) v.p.z -= over - edge - (over < 0 ? 1e-4 : -1e-4);
  }
}

Rgb HeadClay::colour(Point p, const Rgb& skin) const {
  if (fromBand(p) < 0.0105 && p.z > 0.13) return band_;
  const double eye =
      std::min(length(p - Point{0.030, 0.0855, 0.133}), length(p - Point{-0.030, 0.0855, 0.133}));
  if (eye < 0.0055) return Rgb{0.13, 0.09, 0.07};
  if (eye < 0.0095) return p.z > 0.137 ? times({0.55, 0.46, 0.42}, skin) : Rgb{0.80, 0.76, 0.71};
  const double over = beard_ && p.z < 0.105 && p.y > 0 ? 0.0008 : 0.0025;
  if (face_.distance(p) > over && p.y < 0.118 && near(p))
    return mix(0.75, 1.3, roughNoise(60 * p, 2)) * hair_;
  const bool brow =
      std::fabs(p.z - 0.153) < 0.005 && std::fabs(p.x) > 0.010 && std::fabs(p.x) < 0.046 && p.y > 0.06;
  if (brow) return mix(skin, hair_, 0.75);
  if (p.y > 0.085 && std::fabs(p.z - 0.078) < 0.010 && std::fabs(p.x) < 0.022)
    return mix(skin, Rgb{0.66, 0.36, 0.30}, 0.7);
  const double blush = smoothstep(0.03, 0.0, length(p - Point{p.x < 0 ? -0.042 : 0.042, 0.075, 0.105}));
  return mix(skin, Rgb{0.80, 0.46, 0.36}, 0.35 * blush);
}

}  // namespace stadion::assets
