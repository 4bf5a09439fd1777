#include "engine/environment/radiance_map.h"

#include "engine/environment/mirrored_light.h"
#include "engine/maths/angles.h"
#include "engine/maths/functions.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <utility>

namespace stadion {
namespace {

using SphereWay = std::array<double, 3>;
using LightSum = std::array<double, 3>;

void addLight(LightSum& to, const Radiance& light, double weight) {
  for (std::size_t c = 0; c < 3; ++c) to[c] += weight * double{light[c]};
}

Radiance roundedLight(const LightSum& sum) {
  return {static_cast<float>(sum[0]), static_cast<float>(sum[1]), static_cast<float>(sum[2])};
}

/// Half as wide and half as high.
RadianceMap halved(const RadianceMap& map) {
  RadianceMap half{map.width / 2, map.height / 2, {}};
  half.pixels.reserve(std::size_t{half.width} * half.height);
  for (std::uint32_t y = 0; y < half.height; ++y)
    for (std::uint32_t x = 0; x < half.width; ++x) {
      LightSum sum{};
      for (std::uint32_t i = 0; i < 4; ++i) addLight(sum, map.at(2 * x + i % 2, 2 * y + i / 2), 0.25);
      half.pixels.push_back(roundedLight(sum));
    }
  return half;
}

/// Twice as wide and twice as high, with the same colours.
RadianceMap doubled(const RadianceMap& map) {
  RadianceMap twice{map.width * 2, map.height * 2, {}};
  twice.pixels.reserve(std::size_t{twice.width} * twice.height);
  for (std::uint32_t y = 0; y < twice.height; ++y)
    for (std::uint32_t x = 0; x < twice.width; ++x) twice.pixels.push_back(map.at(x / 2, y / 2));
  return twice;
}

/// Abramowitz and Stegun 4.4.49; error below 1e-5, for x from 0 to 1.
double smallArcTangent(double x) {
  const double s = x * x;
  return x * (0.9998660 + s * (-0.3302995 + s * (0.1801410 + s * (-0.0851330 + s * 0.0208351))));
}

/// The angle of (x, y) from the y axis towards the x axis, from -pi to pi; error below 1e-5.
double quickAngle(double x, double y) {
  const double wide = std::abs(x), high = std::abs(y), most = std::max(wide, high);
  if (!(most > 0)) return 0;
  double angle = smallArcTangent(std::min(wide, high) / most);
  if (wide > high) angle = kPi / 2 - angle;
  if (y < 0) angle = kPi - angle;
  return x < 0 ? -angle : angle;
}

/// The colour in a direction, blended from four pixels.
Radiance lookedUp(const RadianceMap& map, const SphereWay& d) {
  const double u = 0.5 + quickAngle(d[0], d[1]) / (2 * kPi);
  const double v = quickAngle(std::sqrt(d[0] * d[0] + d[1] * d[1]), d[2]) / kPi;
  const double x = u * map.width - 0.5, y = std::clamp(v * map.height - 0.5, 0.0, map.height - 1.0);
  const double left = std::floor(x), top = std::floor(y), right = x - left, down = y - top;
  const auto width = static_cast<std::int64_t>(map.width);
  const auto column = [&](double at) {
    return static_cast<std::uint32_t>((static_cast<std::int64_t>(at) + width) % width);
  };
  const auto row = static_cast<std::uint32_t>(top), next = std::min(row + 1, map.height - 1);
  const std::uint32_t first = column(left), second = column(left + 1);
  LightSum sum{};
  addLight(sum, map.at(first, row), (1 - right) * (1 - down)),
      addLight(sum, map.at(second, row), right * (1 - down));
  addLight(sum, map.at(first, next), (1 - right) * down), addLight(sum, map.at(second, next), right * down);
  return roundedLight(sum);
}

/// An octahedral map with a texel in the middle of each step.
struct SquareMap {
  std::uint32_t side = 0;
  std::vector<Radiance> texels;

  SphereWay direction(std::uint32_t x, std::uint32_t y) const {
    return octahedralDirection((x + 0.5) * 2 / side - 1, (y + 0.5) * 2 / side - 1);
  }
  const Radiance& texel(std::int64_t x, std::int64_t y) const {
    const std::int64_t last = std::int64_t{side} - 1;
    if (x < 0 || x > last) x = std::clamp<std::int64_t>(x, 0, last), y = last - y;
    if (y < 0 || y > last) y = std::clamp<std::int64_t>(y, 0, last), x = last - x;
    return texels[static_cast<std::size_t>(y * side + x)];
  }
  void addAt(const SphereWay& d, double weight, LightSum& sum) const {
    const auto place = octahedralPlace(d);
    const double x = (place[0] + 1) * 0.5 * side - 0.5, y = (place[1] + 1) * 0.5 * side - 0.5;
    const double left = std::floor(x), low = std::floor(y), right = x - left, up = y - low;
    const auto column = static_cast<std::int64_t>(left), row = static_cast<std::int64_t>(low);
    addLight(sum, texel(column, row), weight * (1 - right) * (1 - up));
    addLight(sum, texel(column + 1, row), weight * right * (1 - up));
    addLight(sum, texel(column, row + 1), weight * (1 - right) * up);
    addLight(sum, texel(column + 1, row + 1), weight * right * up);
  }
};

template <class Colour>
SquareMap squareMap(std::uint32_t side, const Colour& colour) {
  SquareMap map{side, {}};
  map.texels.reserve(std::size_t{side} * side);
  for (std::uint32_t y = 0; y < side; ++y)
    for (std::uint32_t x = 0; x < side; ++x) map.texels.push_back(colour(map, x, y));
  return map;
}

/// An octahedral map as it is kept: a texel at each corner of side x side steps.
struct CornerMap {
  std::uint32_t side = 0;
  std::vector<Radiance> texels;

  const Radiance& texel(std::uint32_t x, std::uint32_t y) const {
    return texels[std::size_t{y} * (side + 1) + x];
  }
};

/// `colour`: of a place on the square, -1 to 1.
template <class Colour>
CornerMap cornerMap(std::uint32_t side, const Colour& colour) {
  CornerMap map{side, {}};
  map.texels.reserve(EnvironmentLight::sizeOf(side));
  for (std::uint32_t y = 0; y <= side; ++y)
    for (std::uint32_t x = 0; x <= side; ++x)
      map.texels.push_back(colour(2.0 * x / side - 1, 2.0 * y / side - 1));
  return map;
}

/// The direction of a place that may lie beyond an edge of the square, which is folded in its middle.
SphereWay directionBeyond(double x, double y) {
  if (std::abs(x) > 1) x = (x < 0 ? -2 : 2) - x, y = -y;
  if (std::abs(y) > 1) y = (y < 0 ? -2 : 2) - y, x = -x;
  return octahedralDirection(x, y);
}

/// Each texel is the mean of four places around it.
CornerMap cornerMapOf(const RadianceMap& map, std::uint32_t side) {
  const double part = 0.5 / side;
  return cornerMap(side, [&](double x, double y) {
    LightSum sum{};
    for (const double inY : {-part, part})
      for (const double inX : {-part, part})
        addLight(sum, lookedUp(map, directionBeyond(x + inX, y + inY)), 0.25);
    return roundedLight(sum);
  });
}

/// Each texel is the mean of the four corners around it.
SquareMap squareMapOf(const CornerMap& map) {
  return squareMap(map.side, [&](const SquareMap&, std::uint32_t x, std::uint32_t y) {
    LightSum sum{};
    for (std::uint32_t i = 0; i < 4; ++i) addLight(sum, map.texel(x + i % 2, y + i / 2), 0.25);
    return roundedLight(sum);
  });
}

/// A quarter as large: the same surroundings at fewer corners. `fine`: with two texels for each step.
CornerMap cornerMapFrom(const SquareMap& fine) {
  return cornerMap(fine.side / 2, [&](double x, double y) {
    LightSum sum{};
    fine.addAt(octahedralDirection(x, y), 1, sum);
    return roundedLight(sum);
  });
}

/// Proportional to the solid angle of a texel.
double sizeOf(const SquareMap& map, std::uint32_t x, std::uint32_t y) {
  const double u = std::abs((x + 0.5) * 2 / map.side - 1), v = std::abs((y + 0.5) * 2 / map.side - 1);
  const double z = 1 - u - v,
               squared = z >= 0 ? u * u + v * v + z * z : (1 - u) * (1 - u) + (1 - v) * (1 - v) + z * z;
  return 1 / (squared * std::sqrt(squared));
}

SquareMap halved(const SquareMap& map) {
  return squareMap(map.side / 2, [&](const SquareMap&, std::uint32_t x, std::uint32_t y) {
    LightSum sum{};
    double all = 0;
    for (std::uint32_t i = 0; i < 4; ++i) {
      const std::uint32_t column = 2 * x + i % 2, row = 2 * y + i / 2;
      const double size = sizeOf(map, column, row);
      addLight(sum, map.texel(column, row), size);
      all += size;
    }
    for (double& c : sum) c /= all;
    return roundedLight(sum);
  });
}

/// The same surroundings, each time in a quarter of the texels.
std::vector<SquareMap> pyramidOf(SquareMap map) {
  constexpr std::uint32_t kLeast = 4;
  std::vector<SquareMap> all;
  all.push_back(std::move(map));
  while (all.back().side > kLeast) all.push_back(halved(all.back()));
  return all;
}

/// A ray of a lobe, and the two maps of a pyramid whose texels are as wide as what it stands for.
struct WideRay {
  MirroredRay ray;
  std::size_t fine, coarse;
  double part;  ///< of the coarse one
};

std::vector<WideRay> wideRays(double roughness, const std::vector<SquareMap>& pyramid) {
  std::vector<WideRay> rays;
  const double side = pyramid[0].side, texel = 4 * kPi / (side * side);
  const auto last = static_cast<double>(pyramid.size() - 1);
  constexpr std::uint32_t kHalfVectors = 128;
  for (const MirroredRay& ray : mirroredRays(roughness, kHalfVectors)) {
    const double level =
        std::clamp(0.5 * det::log(ray.solidAngle / texel) / std::numbers::ln2 + 0.5, 0.0, last);
    const double fine = std::floor(level);
    const auto at = static_cast<std::size_t>(fine);
    rays.push_back({ray, at, std::min(at + 1, pyramid.size() - 1), level - fine});
  }
  return rays;
}

CornerMap mirrored(const std::vector<SquareMap>& pyramid, double roughness, std::uint32_t side) {
  const std::vector<WideRay> rays = wideRays(roughness, pyramid);
  return cornerMap(side, [&](double x, double y) {
    const SphereWay n = octahedralDirection(x, y);
    const auto axes = axesAround(n);
    LightSum sum{};
    for (const WideRay& wide : rays) {
      const SphereWay& l = wide.ray.direction;
      SphereWay d;
      for (std::size_t k = 0; k < 3; ++k) d[k] = l[0] * axes[0][k] + l[1] * axes[1][k] + l[2] * n[k];
      pyramid[wide.fine].addAt(d, wide.ray.weight * (1 - wide.part), sum);
      if (wide.part > 0) pyramid[wide.coarse].addAt(d, wide.ray.weight * wide.part, sum);
    }
    return roundedLight(sum);
  });
}

/// Of a wide lobe: the mean over all directions.
CornerMap widelyMirrored(const SquareMap& from, double roughness, std::uint32_t side) {
  struct Source {
    SphereWay direction;
    double size;
  };
  std::vector<Source> sources;
  for (std::uint32_t y = 0; y < from.side; ++y)
    for (std::uint32_t x = 0; x < from.side; ++x)
      sources.push_back({from.direction(x, y), sizeOf(from, x, y)});
  return cornerMap(side, [&](double x, double y) {
    const SphereWay n = octahedralDirection(x, y);
    LightSum sum{};
    double all = 0;
    for (std::size_t i = 0; i < sources.size(); ++i) {
      const SphereWay& d = sources[i].direction;
      const double weight =
          sources[i].size * mirroredWeight(roughness, n[0] * d[0] + n[1] * d[1] + n[2] * d[2]);
      if (weight <= 0) continue;
      addLight(sum, from.texels[i], weight);
      all += weight;
    }
    for (double& c : sum) c /= all;
    return roundedLight(sum);
  });
}

/// Sums radiance over the sphere into harmonics of irradiance / pi.
class HarmonicSum {
public:
  void add(const SphereWay& d, const LightSum& light) {
    const std::array<double, 9> y = harmonicsAt(d);
    for (std::size_t i = 0; i < y.size(); ++i)
      for (std::size_t c = 0; c < 3; ++c) sums_[i][c] += y[i] * light[c];
  }
  /// The bands of a cosine lobe, divided by pi.
  std::array<Radiance, 9> result() const {
    std::array<Radiance, 9> out;
    for (std::size_t i = 0; i < out.size(); ++i) {
      const double band = i == 0 ? 1 : i < 4 ? 2.0 / 3 : 0.25;
      for (std::size_t c = 0; c < 3; ++c) out[i][c] = static_cast<float>(band * sums_[i][c]);
    }
    return out;
  }

private:
  std::array<LightSum, 9> sums_{};
};

std::array<Radiance, 9> harmonicsOf(const RadianceMap& map) {
  std::vector<det::SinCos> columns;
  for (std::uint32_t x = 0; x < map.width; ++x)
    columns.push_back(det::sincos(((x + 0.5) / map.width - 0.5) * 2 * kPi));
  HarmonicSum sum;
  for (std::uint32_t y = 0; y < map.height; ++y) {
    const double above = det::cos(kPi * y / map.height), below = det::cos(kPi * (y + 1) / map.height);
    const double solidAngle = 2 * kPi / map.width * (above - below);
    const auto polar = det::sincos(kPi * (y + 0.5) / map.height);
    for (std::uint32_t x = 0; x < map.width; ++x) {
      LightSum light{};
      addLight(light, map.at(x, y), solidAngle);
      sum.add({polar.sin * columns[x].sin, polar.sin * columns[x].cos, polar.cos}, light);
    }
  }
  return sum.result();
}

void appendMap(const CornerMap& map, std::vector<std::uint32_t>& texels) {
  for (const Radiance& light : map.texels) texels.push_back(packedLight(light));
}

std::array<double, 3> mixedLight(const Radiance& a, const LightSum& b, double t) {
  LightSum out{};
  for (std::size_t c = 0; c < 3; ++c) out[c] = double{a[c]} + (b[c] - double{a[c]}) * t;
  return out;
}

/// A sky by the z of the direction, as a surface of some roughness mirrors it.
class MirroredSky {
public:
  template <class Colour>
  MirroredSky(double roughness, const Colour& colour) {
    constexpr std::uint32_t kHalfVectors = 1024;
    const std::vector<MirroredRay> rays = mirroredRays(roughness, kHalfVectors);
    for (int i = 0; i <= kSteps; ++i) {
      const double z = 2.0 * i / kSteps - 1, across = std::sqrt(1 - z * z);
      LightSum sum{};
      for (const MirroredRay& ray : rays) {
        const LightSum light = colour(z * ray.direction[2] + across * ray.direction[0]);
        for (std::size_t c = 0; c < 3; ++c) sum[c] += ray.weight * light[c];
      }
      table_[static_cast<std::size_t>(i)] = sum;
    }
  }
  Radiance at(double z) const {
    const double place = (z + 1) * 0.5 * kSteps, low = std::min(std::floor(place), kSteps - 1.0);
    const auto i = static_cast<std::size_t>(low);
    return roundedLight(mixedLight(roundedLight(table_[i]), table_[i + 1], place - low));
  }

private:
  static constexpr int kSteps = 128;
  std::array<LightSum, kSteps + 1> table_;
};

}  // namespace

std::array<double, 3> equirectangularDirection(double u, double v) {
  const auto around = det::sincos((u - 0.5) * 2 * kPi), polar = det::sincos(v * kPi);
  return {polar.sin * around.sin, polar.sin * around.cos, polar.cos};
}

EnvironmentLight environmentLight(RadianceMap map) {
  constexpr std::uint32_t kLeastRows = 64;  // fewer would be too coarse steps for the harmonics
  while (map.height < kLeastRows) map = doubled(map);
  while (map.height > EnvironmentLight::kMostPicture) map = halved(map);
  EnvironmentLight light;
  light.harmonics = harmonicsOf(map);
  light.pictureSide = std::max(std::bit_floor(map.height), EnvironmentLight::kLeastPicture);
  const CornerMap picture = cornerMapOf(map, light.pictureSide);
  map = {};
  const std::vector<SquareMap> pyramid = pyramidOf(squareMapOf(picture));
  appendMap(picture, light.texels);
  const auto withSide = [&](std::uint32_t side) -> const SquareMap& {
    return *std::ranges::find(pyramid, side, &SquareMap::side);
  };
  constexpr std::uint32_t kSharp = EnvironmentLight::kSides[0];
  appendMap(light.pictureSide == kSharp ? picture : cornerMapFrom(withSide(2 * kSharp)), light.texels);
  constexpr std::size_t kFirstWide = 3;
  constexpr std::uint32_t kWideSource = 64;
  for (std::size_t i = 1; i < EnvironmentLight::kMaps; ++i) {
    const double roughness{EnvironmentLight::roughnessOf(i)};
    const std::uint32_t side = EnvironmentLight::kSides[i];
    appendMap(i < kFirstWide ? mirrored(pyramid, roughness, side)
                             : widelyMirrored(withSide(kWideSource), roughness, side),
              light.texels);
  }
  return light;
}

std::array<double, 3> skyColour(const Radiance& zenith, const Radiance& horizon, const Radiance& ground,
                                double z) {
  const auto toDouble = [](const Radiance& c) { return LightSum{double{c[0]}, double{c[1]}, double{c[2]}}; };
  if (z < 0)
    return mixedLight(horizon, toDouble(ground), det::exp(0.03 * std::numbers::ln2 / std::min(z, -1e-4)));
  const double low = (1 - z) * (1 - z);
  return mixedLight(zenith, toDouble(horizon), low * low);
}

EnvironmentLight skyLight(const Radiance& zenith, const Radiance& horizon, const Radiance& ground) {
  const auto colour = [&](double z) { return skyColour(zenith, horizon, ground, z); };
  EnvironmentLight light;
  constexpr int kSlices = 512, kAround = 4;  // around, the harmonics of the second band need four
  HarmonicSum sum;
  for (int i = 0; i < kSlices; ++i) {
    const double z = (2 * i + 1.0) / kSlices - 1, across = std::sqrt(1 - z * z);
    LightSum slice = colour(z);
    for (double& c : slice) c *= 4 * kPi / (kSlices * kAround);
    for (const SphereWay& d : {SphereWay{across, 0, z}, SphereWay{-across, 0, z}, SphereWay{0, across, z},
                               SphereWay{0, -across, z}})
      sum.add(d, slice);
  }
  light.harmonics = sum.result();
  for (std::size_t i = 0; i < EnvironmentLight::kMaps; ++i) {
    const std::uint32_t side = EnvironmentLight::kSides[i];
    if (i == 0) {
      appendMap(cornerMap(side, [&](double x,
                                    double y) { return roundedLight(colour(octahedralDirection(x, y)[2])); }),
                light.texels);
      continue;
    }
    const MirroredSky sky(double{EnvironmentLight::roughnessOf(i)}, colour);
    appendMap(cornerMap(side, [&](double x, double y) { return sky.at(octahedralDirection(x, y)[2]); }),
              light.texels);
  }
  return light;
}

}  // namespace stadion
