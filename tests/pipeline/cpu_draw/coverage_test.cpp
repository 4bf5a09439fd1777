/// Setup and coverage of triangles: all kernels agree to the bit, and with a plain drawing.

#include "pipeline/cpu_draw/kernels/choose_kernels.h"
#include "tests/pipeline/cpu_draw/scalar_drawing.h"

#include <cstring>
#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace stadion {
namespace {

using test::ScalarTriangle;

constexpr int kCoverWidth = 61, kCoverHeight = 16;
constexpr float kMostCoverDepth = 10;

/// Triangles in the picture, padded for the kernels.
struct PlacedTriangles {
  std::vector<float> x, y, depth;
  std::vector<int> a, b, c;

  void add(const ScalarTriangle& t) {
    const auto first = static_cast<int>(x.size());
    for (const auto& corner : t) {
      x.push_back(static_cast<float>(corner.x)), y.push_back(static_cast<float>(corner.y));
      depth.push_back(static_cast<float>(corner.depth));
    }
    add(first, first + 1, first + 2);
  }
  void add(int i, int j, int k) { a.push_back(i), b.push_back(j), c.push_back(k); }
  /// The corners as the kernels see them.
  ScalarTriangle at(std::size_t t) const {
    ScalarTriangle out;
    const int corners[] = {a[t], b[t], c[t]};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto v = static_cast<std::size_t>(corners[k]);
      out[k] = {double{x[v]}, double{y[v]}, double{depth[v]}};
    }
    return out;
  }
};

struct CoveredBand {
  std::vector<TriangleRecord> records;
  std::vector<float> depth;
  std::vector<unsigned> triangle;
  std::vector<LayerFragment> fragments;
  std::size_t unfinished = 0;
};

SetupParameters setupFor(int samples, float facing = 0) {
  SetupParameters s{};
  s.width = kCoverWidth, s.height = kCoverHeight, s.samples = samples, s.facing = facing;
  s.mirrored = 1, s.leastDepth = 0, s.mostDepth = kMostCoverDepth;
  return s;
}

CoveredBand drawn(PlacedTriangles t, int samples, const DrawKernels& by, bool layered = false) {
  const auto count = static_cast<unsigned>(t.a.size());
  for (auto* corners : {&t.a, &t.b, &t.c}) corners->resize(count + kKernelPadding);
  std::vector<float> placed(4 * (t.x.size() + kKernelPadding));
  for (std::size_t v = 0; v < t.x.size(); ++v)
    placed[4 * v] = t.x[v], placed[4 * v + 1] = t.y[v], placed[4 * v + 2] = t.depth[v];
  CoveredBand out;
  out.records.resize(count);
  const PlacedVertices at{placed.data()};
  out.records.resize(
      by.setUp({t.a.data(), t.b.data(), t.c.data()}, 0, count, at, setupFor(samples), out.records.data()));
  const int stride = (kCoverWidth + 15) / 16 * 16 * samples;
  out.depth.assign(static_cast<std::size_t>(stride * kCoverHeight), 0.0f);
  out.triangle.assign(out.depth.size(), kNoTriangle);
  const BandSamples band{out.depth.data(), out.triangle.data(), stride, 0, kCoverHeight};
  std::vector<LayerFragment> room(kCoverWidth * kCoverHeight + 64);
  for (const TriangleRecord& r : out.records) {
    if (r.sourceAndFlags & kUnfinished) {
      ++out.unfinished;
      continue;
    }
    if (layered) {
      const unsigned made = by.coverLayer(r, r.triangle, samples, nullptr, band, room.data());
      out.fragments.insert(out.fragments.end(), room.begin(), room.begin() + made);
    } else {
      const TriangleRecord* const one = &r;
      by.cover(&one, 1, r.triangle, samples, nullptr, band);
    }
  }
  return out;
}

template <class V>
bool sameBits(const std::vector<V>& a, const std::vector<V>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(V)) == 0;
}

/// Of many sizes; some thin, some degenerate, some beyond the picture.
PlacedTriangles someTriangles(std::mt19937& random, int count) {
  PlacedTriangles out;
  const auto from = [&](double lo, double hi) { return std::uniform_real_distribution(lo, hi)(random); };
  for (int i = 0; i < count; ++i) {
    const double size = std::exp(from(-3, 4.5)), x = from(-5, kCoverWidth + 5),
                 y = from(-5, kCoverHeight + 5);
    ScalarTriangle t;
    for (auto& c : t) c = {x + from(-size, size), y + from(-size, size), from(0.1, 9)};
    if (i % 7 == 0) t[2] = {t[0].x + 1e-3, t[1].y, t[2].depth};
    if (i % 11 == 0) t[2] = t[1];
    if (i % 5 == 0)
      for (auto& c : t) c.x = std::round(4 * c.x) / 4, c.y = std::round(4 * c.y) / 4;
    out.add(t);
  }
  return out;
}

TEST(CpuCoverage, TheKernelsOfAllWidthsGiveTheSameBits) {
  std::mt19937 random(1);
  for (const int samples : {1, 2, 4, 8})
    for (int round = 0; round < 20; ++round) {
      const PlacedTriangles triangles = someTriangles(random, 300);
      const CoveredBand four = drawn(triangles, samples, kDrawByFour);
      const CoveredBand layers = drawn(triangles, samples, kDrawByFour, true);
      for (const DrawKernels* other : drawKernelsHere()) {
        const CoveredBand theirs = drawn(triangles, samples, *other);
        EXPECT_TRUE(sameBits(four.records, theirs.records)) << other->name;
        EXPECT_TRUE(sameBits(four.depth, theirs.depth)) << other->name << ", " << samples;
        EXPECT_EQ(four.triangle, theirs.triangle) << other->name << ", " << samples;
        EXPECT_TRUE(sameBits(layers.fragments, drawn(triangles, samples, *other, true).fragments))
            << other->name;
      }
    }
}

/// Compares one triangle in the band with a plain drawing of it; returns the number of samples inside.
int expectPlainCoverage(const ScalarTriangle& t, const CoveredBand& band, int samples) {
  constexpr double kNearEdge = 2e-3;  // where rounding decides [pixels]
  const auto stride = static_cast<std::size_t>((kCoverWidth + 15) / 16 * 16 * samples);
  const auto places = test::samplePlaces(samples);
  const double slope = std::max(std::fabs(depthAt(t, 1, 0) - depthAt(t, 0, 0)),
                                std::fabs(depthAt(t, 0, 1) - depthAt(t, 0, 0)));
  int inside = 0;
  for (std::size_t y = 0; y < kCoverHeight; ++y)
    for (std::size_t x = 0; x < kCoverWidth; ++x)
      for (std::size_t s = 0; s < places.size(); ++s) {
        const std::size_t at = y * stride + x * places.size() + s;
        const double px = static_cast<double>(x) + places[s][0], py = static_cast<double>(y) + places[s][1];
        const double within = test::inside(t, px, py);
        if (std::fabs(within) < kNearEdge) continue;
        EXPECT_EQ(band.triangle[at] == 0, within > 0) << "at " << px << ", " << py;
        if (!(within > 0)) continue;
        EXPECT_NEAR(band.depth[at], depthAt(t, px, py), 1e-4 * (1 + slope));
        ++inside;
      }
  return inside;
}

TEST(CpuCoverage, ATriangleCoversTheSamplesInsideItAndNoOthers) {
  std::mt19937 random(2);
  for (const int samples : {1, 2, 4, 8}) {
    const PlacedTriangles all = someTriangles(random, 300);
    int inside = 0;
    for (std::size_t i = 0; i < all.a.size(); ++i) {
      const ScalarTriangle t = all.at(i);
      if (std::fabs(doubleArea(t)) < 1e-2) continue;
      PlacedTriangles one;
      one.add(t);
      inside += expectPlainCoverage(t, drawn(one, samples, kDrawByFour), samples);
      ASSERT_FALSE(HasFailure()) << "triangle " << i << ", " << samples << " samples";
    }
    EXPECT_GT(inside, 1000 * samples);
  }
}

TEST(CpuCoverage, NeighboursLeaveNoGapAndNeverOverlap) {
  std::mt19937 random(3);
  for (const int samples : {1, 2, 4, 8})
    for (int round = 0; round < 100; ++round) {
      // A net of points, shifted, that reaches beyond the picture.
      constexpr int kColumns = 12, kRows = 6;
      PlacedTriangles net;
      const double spread = round % 3 == 0 ? 0 : 0.2;  // no triangle turns over
      std::uniform_real_distribution<double> shift(-spread, spread);
      for (int j = 0; j <= kRows; ++j)
        for (int i = 0; i <= kColumns; ++i)
          net.x.push_back(static_cast<float>((i + shift(random)) * 7.3 - 10)),
              net.y.push_back(static_cast<float>((j + shift(random)) * 5.1 - 5)), net.depth.push_back(1);
      for (int j = 0; j < kRows; ++j)
        for (int i = 0; i < kColumns; ++i) {
          const int at = j * (kColumns + 1) + i, up = at + kColumns + 1;
          net.add(at, at + 1, up + 1), net.add(at, up + 1, up);
        }
      std::vector<int> count(kCoverWidth * kCoverHeight * samples);
      for (const LayerFragment& f : drawn(net, samples, kDrawByFour, true).fragments)
        for (int s = 0; s < samples; ++s)
          if (f.samples >> s & 1)
            ++count[static_cast<std::size_t>(((f.pixel >> 16) * kCoverWidth + (f.pixel & 0xffff)) * samples +
                                             s)];
      for (const int times : count) ASSERT_EQ(times, 1) << samples << " samples, round " << round;
    }
}

TEST(CpuCoverage, TheLaterOfTwoTrianglesAtTheSameDepthIsSeen) {
  PlacedTriangles two;
  const ScalarTriangle t{{{0, 0, 1}, {60, 0, 1}, {0, 15, 1}}};
  two.add(t), two.add(t);
  const CoveredBand band = drawn(two, 4, kDrawByFour);
  EXPECT_EQ(band.triangle[0], 1u);
}

TEST(CpuCoverage, TrianglesThatAreNotFiniteOrBehindTheEyeCoverNothing) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN(),
                   kInf = std::numeric_limits<double>::infinity();
  for (const double bad : {kNan, kInf, -kInf, 1e30}) {
    PlacedTriangles triangles;
    for (int k = 0; k < 3; ++k) {
      ScalarTriangle t{{{0, 0, 1}, {60, 0, 1}, {0, 15, 1}}};
      t[static_cast<std::size_t>(k)].x = bad, triangles.add(t);
      t = {{{0, 0, -1}, {60, 0, -1}, {0, 15, kNan}}}, triangles.add(t);
    }
    for (const DrawKernels* kernels : drawKernelsHere()) {
      const CoveredBand band = drawn(triangles, 4, *kernels);
      for (const unsigned seen : band.triangle) ASSERT_EQ(seen, kNoTriangle);
      EXPECT_EQ(band.unfinished, 3u);  // the clipper decides
    }
  }
}

}  // namespace
}  // namespace stadion
