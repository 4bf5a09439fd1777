/// Light from all around, against integrals over the sphere.

#include "engine/environment/mirrored_light.h"
#include "tests/engine/environment/surroundings.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace stadion::test {
namespace {

using Way = std::array<double, 3>;

double dotOf(const Way& a, const Way& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Sums weight(direction) * colour over the sphere in small steps, divided by the sum of weights.
template <class Weight>
std::array<double, 3> weightedMean(const ColourAt& colour, const Weight& weight) {
  constexpr int kRows = 720, kColumns = 1440;
  std::array<double, 3> sum{};
  double all = 0;
  for (int y = 0; y < kRows; ++y)
    for (int x = 0; x < kColumns; ++x) {
      const Way d = equirectangularDirection((x + 0.5) / kColumns, (y + 0.5) / kRows);
      const double part = weight(d) * std::sin(std::numbers::pi * (y + 0.5) / kRows);
      if (!(part > 0)) continue;
      const auto c = colour(d);
      for (std::size_t k = 0; k < 3; ++k) sum[k] += part * c[k];
      all += part;
    }
  for (double& c : sum) c /= all;
  return sum;
}

Way directionOf(double x, double y, double z) {
  const double size = std::sqrt(x * x + y * y + z * z);
  return {x / size, y / size, z / size};
}

const std::array kWays{directionOf(1, 2, 0.5), directionOf(0, 0, 1),       directionOf(-1, 0.2, -0.4),
                       directionOf(0, 0, -1),  directionOf(0.6, 0.7, 0.4), directionOf(0.01, -1, 0.02)};

/// The colour of a map in a direction, from its nearest texel.
Radiance texelOf(const EnvironmentLight& light, std::size_t first, std::uint32_t side, const Way& d) {
  const auto place = octahedralPlace(d);
  const auto at = [&](double p) { return static_cast<std::uint32_t>(std::lround((p + 1) * 0.5 * side)); };
  return unpackedLight(light.texels[first + std::size_t{at(place[1])} * (side + 1) + at(place[0])]);
}

TEST(EnvironmentTexels, ColoursKeepNineBits) {
  for (const Radiance& c :
       {Radiance{1, 0.5f, 0.25f}, Radiance{0, 0, 0}, Radiance{65408, 1, 0}, Radiance{0.9999f, 0, 0},
        Radiance{1e-6f, 2e-6f, 0}, Radiance{3e7f, 5, 5}, Radiance{511.9f, 511.4f, 2}}) {
    const Radiance back = unpackedLight(packedLight(c));
    const float most = std::min(std::max({c[0], c[1], c[2]}), 65408.0f);
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_NEAR(back[k], std::min(c[k], 65408.0f), most / 511 + 4e-8f) << c[0] << " " << k;
  }
  EXPECT_EQ(unpackedLight(packedLight({1, 0.5f, 0.25f})), (Radiance{1, 0.5f, 0.25f}));
}

TEST(EnvironmentTexels, PlacesAndDirectionsAreEachOthersInverse) {
  for (const Way& d : kWays) {
    const auto place = octahedralPlace(d);
    const Way back = octahedralDirection(place[0], place[1]);
    EXPECT_NEAR(dotOf(d, back), 1, 1e-12);
  }
}

TEST(EnvironmentTexels, TheEdgesOfTheSquareAreFolded) {
  const EnvironmentLight light = environmentLight(surroundingsOf(64, [](const Way& d) {
    return std::array<double, 3>{2 + d[0], 2 + d[1], 2 + d[2]};
  }));
  for (const std::size_t map : {0u, 1u, 3u}) {
    const std::uint32_t side = EnvironmentLight::kSides[map];
    const std::size_t first = light.firstOf(map), row = side + 1;
    for (std::uint32_t i = 0; i <= side; ++i) {
      EXPECT_EQ(light.texels[first + i], light.texels[first + side - i]);
      EXPECT_EQ(light.texels[first + side * row + i], light.texels[first + side * row + side - i]);
      EXPECT_EQ(light.texels[first + i * row], light.texels[first + (side - i) * row]);
      EXPECT_EQ(light.texels[first + i * row + side], light.texels[first + (side - i) * row + side]);
    }
  }
}

/// A picture blended from four texels, as the renderers do.
double blendedPicture(const EnvironmentLight& light, const Way& d) {
  const auto place = octahedralPlace(d);
  const double side = light.pictureSide, x = (place[0] + 1) * 0.5 * side, y = (place[1] + 1) * 0.5 * side;
  const double left = std::min(std::floor(x), side - 1), low = std::min(std::floor(y), side - 1);
  const auto at = [&](double column, double line) {
    return double{unpackedLight(light.texels[static_cast<std::size_t>(line * (side + 1) + column)])[0]};
  };
  const double right = x - left, up = y - low;
  return (at(left, low) * (1 - right) + at(left + 1, low) * right) * (1 - up) +
         (at(left, low + 1) * (1 - right) + at(left + 1, low + 1) * right) * up;
}

/// In front, to the right, behind and to the left are corners of the octahedron.
TEST(EnvironmentTexels, AHorizonIsAsSharpAtTheCornersAsElsewhere) {
  const EnvironmentLight light = environmentLight(surroundingsOf(512, [](const Way& d) {
    return std::array<double, 3>{d[2] > 0 ? 1.0 : 0.0, 0, 0};
  }));
  const auto widthAt = [&](double azimuth) {  // from 10 % to 90 %
    double low = 0, high = 0;
    for (double z = -0.03; z < 0.03; z += 1e-5) {
      const double c = blendedPicture(light, directionOf(std::sin(azimuth), std::cos(azimuth), z));
      if (c < 0.1) low = z;
      if (c < 0.9) high = z;
    }
    return high - low;
  };
  const double usual = widthAt(0.3);
  for (const double corner : {0.0, 0.5, 1.0, 1.5})
    EXPECT_LT(widthAt(corner * std::numbers::pi), 1.3 * usual) << corner;
}

TEST(EnvironmentLight, HarmonicsGiveTheIrradianceOfSmoothSurroundings) {
  const ColourAt smooth = [](const Way& d) {
    return std::array<double, 3>{1 + 0.5 * d[2], 0.8 + 0.3 * d[0] - 0.2 * d[1],
                                 0.7 + 0.2 * d[0] * d[1] + 0.1 * d[2] * d[2] - 0.2 * d[1] * d[2]};
  };
  const EnvironmentLight light = environmentLight(surroundingsOf(128, smooth));
  for (const Way& n : kWays) {
    const auto exact = weightedMean(smooth, [&](const Way& d) { return dotOf(n, d); });
    const Radiance got =
        light.matt({static_cast<float>(n[0]), static_cast<float>(n[1]), static_cast<float>(n[2])});
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(got[k], exact[k], 2e-3) << n[0] << " " << n[1];
  }
}

/// The error of nine coefficients is a few percent of the mean light, as their authors found.
TEST(EnvironmentLight, HarmonicsComeNearTheIrradianceOfAHall) {
  const EnvironmentLight light = environmentLight(surroundingsOf(256, hallAt));
  for (const Way& n : kWays) {
    const auto exact = weightedMean(hallAt, [&](const Way& d) { return dotOf(n, d); });
    const Radiance got =
        light.matt({static_cast<float>(n[0]), static_cast<float>(n[1]), static_cast<float>(n[2])});
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(got[k], exact[k], 0.08) << n[0] << " " << n[1];
  }
}

TEST(EnvironmentLight, MapsAreTheSurroundingsInTheLobeOfTheirRoughness) {
  const EnvironmentLight light = environmentLight(surroundingsOf(512, hallAt));
  for (std::size_t map = 2; map < EnvironmentLight::kMaps; ++map) {
    const double spread = std::pow(double{EnvironmentLight::roughnessOf(map)}, 2), squared = spread * spread;
    for (const Way& way : kWays) {
      // That of the nearest texel.
      const auto place = octahedralPlace(way);
      const double side = EnvironmentLight::kSides[map];
      const auto nearest = [&](double p) { return std::round((p + 1) * 0.5 * side) * 2 / side - 1; };
      const Way n = octahedralDirection(nearest(place[0]), nearest(place[1]));
      const auto exact = weightedMean(hallAt, [&](const Way& l) {
        const double cosine = dotOf(n, l);
        if (cosine <= 0) return 0.0;
        const double half = 0.5 * (1 + cosine);  // square of the half vector's cosine
        const double lobe = half * (squared - 1) + 1;
        return cosine / (lobe * lobe);
      });
      const Radiance got = texelOf(light, light.firstOf(map), EnvironmentLight::kSides[map], n);
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(got[k], exact[k], 0.02 + 0.03 * exact[k])
            << map << ": " << n[0] << " " << n[1] << " " << n[2];
    }
  }
}

TEST(EnvironmentLight, WhiteSurroundingsAreWhiteInEveryMap) {
  const EnvironmentLight light = environmentLight(whiteSurroundings());
  EXPECT_TRUE(light.isSound());
  for (const Way& n : kWays) {
    const Radiance got =
        light.matt({static_cast<float>(n[0]), static_cast<float>(n[1]), static_cast<float>(n[2])});
    for (const float c : got) EXPECT_NEAR(c, 1, 1e-3);
  }
  for (const std::uint32_t texel : light.texels)
    for (const float c : unpackedLight(texel)) ASSERT_NEAR(c, 1, 2.0 / 512);
}

TEST(EnvironmentLight, ASkyIsThatOfAPictureOfIt) {
  const Radiance zenith{0.1f, 0.2f, 0.6f}, horizon{0.7f, 0.8f, 0.9f}, ground{0.2f, 0.15f, 0.1f};
  const EnvironmentLight sky = skyLight(zenith, horizon, ground);
  const EnvironmentLight pictured = environmentLight(
      surroundingsOf(512, [&](const Way& d) { return skyColour(zenith, horizon, ground, d[2]); }));
  EXPECT_EQ(sky.pictureSide, 0u);
  EXPECT_TRUE(sky.isSound());
  for (std::size_t i = 0; i < 9; ++i)
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(sky.harmonics[i][k], pictured.harmonics[i][k], 0.01) << i;
  for (std::size_t map = 0; map < EnvironmentLight::kMaps; ++map)
    for (const Way& d : kWays) {
      const std::uint32_t side = EnvironmentLight::kSides[map];
      const Radiance a = texelOf(sky, sky.firstOf(map), side, d),
                     b = texelOf(pictured, pictured.firstOf(map), side, d);
      for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(a[k], b[k], 0.02) << map << " " << d[2];
    }
}

TEST(MirroredRays, WeightsAddUpAndSolidAnglesCoverTheLobe) {
  for (const double roughness : {0.15, 0.4, 0.7, 1.0}) {
    double weights = 0;
    for (const MirroredRay& ray : mirroredRays(roughness, 128)) {
      weights += ray.weight;
      EXPECT_NEAR(dotOf(ray.direction, ray.direction), 1, 1e-9);
      EXPECT_GT(ray.direction[2], 0);
    }
    EXPECT_NEAR(weights, 1, 1e-9);
  }
  for (const Way& n : kWays) {
    const auto axes = axesAround(n);
    EXPECT_NEAR(dotOf(axes[0], axes[1]), 0, 1e-12);
    EXPECT_NEAR(dotOf(axes[0], n), 0, 1e-12);
    EXPECT_NEAR(dotOf(axes[1], axes[1]), 1, 1e-12);
  }
}

}  // namespace
}  // namespace stadion::test
