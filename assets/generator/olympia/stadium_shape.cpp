#include "assets/generator/olympia/stadium_shape.h"

namespace stadion::assets {
namespace {

constexpr double kMiddle = (kTrackLow + kTrackHigh) / 2;
constexpr double kHalfX = kTrackSide - kCorner, kHalfY = (kTrackHigh - kTrackLow) / 2 - kCorner;

// Height of the embankments across [m]: distance outside the track, height.
constexpr std::array<double, 2> kBank[] = {{0, 0.02}, {2.6, 0.06}, {4.5, 0.6}, {10, 2.2},
                                           {17, 4.3}, {23, 5.7},   {27, 6.2},  {31, 6.2},
                                           {35, 5.5}, {42, 2.9},   {48, 0.9},  {kBankEnd, 0}};

double bank(double d) {
  for (std::size_t i = 1; i < std::size(kBank); ++i)
    if (d < kBank[i][0])
      return mix(kBank[i - 1][1], kBank[i][1],
                 std::max(0.0, d - kBank[i - 1][0]) / (kBank[i][0] - kBank[i - 1][0]));
  return 0;
}

/// The hill of Kronos: a cone with a round top and foot.
double kronos(Point p) {
  const double r = length({p.x - kKronos.x, (p.y - kKronos.y) * 0.9, 0});
  const double s = smoothstep(205, 5, r);
  return 78 * mix(s, s * s, 0.3) * mix(0.85, 1.1, roughNoise(0.014 * p, 3));
}

/// Ridges around the valley, higher in the north.
double ridges(Point p) {
  const double r = length({p.x, p.y - kMiddle, 0});
  const double north = 0.5 + 0.5 * p.x / std::max(r, 1.0);
  const double height = mix(190, 260, north) * smoothstep(420, 2300, r);
  return height * mix(0.35, 1.35, roughNoise(0.0016 * p, 4));
}

}  // namespace

double outside(Point p) {
  const double x = std::max(std::fabs(p.x) - kHalfX, 0.0),
               y = std::max(std::fabs(p.y - kMiddle) - kHalfY, 0.0);
  return std::sqrt(x * x + y * y) - kCorner;
}

double groundHeight(Point p) {
  p.z = 0;
  const double d = outside(p);
  const double uneven = smoothstep(3, 8, d) * (roughNoise(0.22 * p, 3) - 0.5) * 0.45;
  const double swell = smoothstep(50, 160, d) * (roughNoise(0.012 * p, 2) - 0.45) * 5;
  const double clear = smoothstep(42, 85, d);
  return bank(d) * mix(0.94, 1.06, noise(0.03 * p)) + uneven + swell + clear * (kronos(p) + ridges(p));
}

std::vector<Point> around(double d) {
  std::vector<Point> points;
  constexpr int kShort = 12, kLong = 72, kArc = 12;  // steps; two of each make kAround with the four arcs
  static_assert(2 * (kShort + kLong) + 4 * kArc == kAround);
  const double r = kCorner + d;
  const auto arc = [&](double x, double y, int quarter) {
    for (int i = 0; i < kArc; ++i) {
      const auto [s, c] = det::sincos(kPi / 2 * (quarter + double(i) / kArc));
      points.push_back({x + r * c, y + r * s, 0});
    }
  };
  const auto side = [&](Point a, Point b, int steps) {
    for (int i = 0; i < steps; ++i) points.push_back(mix(a, b, double(i) / steps));
  };
  const double low = kMiddle - kHalfY, high = kMiddle + kHalfY;
  side({kHalfX + r, low, 0}, {kHalfX + r, high, 0}, kLong);
  arc(kHalfX, high, 0);
  side({kHalfX, high + r, 0}, {-kHalfX, high + r, 0}, kShort);
  arc(-kHalfX, high, 1);
  side({-kHalfX - r, high, 0}, {-kHalfX - r, low, 0}, kLong);
  arc(-kHalfX, low, 2);
  side({-kHalfX, low - r, 0}, {kHalfX, low - r, 0}, kShort);
  arc(kHalfX, low, 3);
  return points;
}

Part ring(const std::vector<Turning>& outline) {
  Part part;
  for (const Turning& t : outline)
    for (Point p : around(t.r)) part.vertices.push_back({{p.x, p.y, t.z}});
  for (std::uint32_t k = 0; k + 1 < outline.size(); ++k) {
    for (std::uint32_t i = 0; i < kAround; ++i) {
      const std::uint32_t j = (i + 1) % kAround, inner = k * kAround, outer = inner + kAround;
      part.triangles.push_back({inner + i, outer + i, outer + j});
      part.triangles.push_back({inner + i, outer + j, inner + j});
    }
  }
  return part;
}

}  // namespace stadion::assets
