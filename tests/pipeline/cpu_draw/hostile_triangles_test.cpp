/// Random triangles of all kinds, each alone in a small picture, against a plain drawing in double precision.
///
/// STADION_FUZZED_TRIANGLES sets how many; without it there are enough for a quick look.

#include "pipeline/cpu_draw/kernels/choose_kernels.h"
#include "pipeline/cpu_draw/picture_setup.h"
#include "tests/pipeline/cpu_draw/scalar_drawing.h"
#include "tests/pipeline/gl_draw/renderer_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>
#include <string>

namespace stadion {
namespace {

constexpr int kHostileSide = 8, kHostileSamples = 4;  ///< of the picture [pixels]
constexpr unsigned kTrianglesAMesh = 512;
constexpr double kRounding = 6e-8;  ///< of a single-precision number, relative

using Row3 = std::array<double, 3>;

/// A triangle in homogeneous coordinates of the picture: x * w, y * w, w.
struct HomogeneousTriangle {
  std::array<Row3, 3> corner;
  std::array<Row3, 3> weight;  ///< times (x, y, 1): how much of w a corner gives, times `whole`
  double whole;                ///< volume
  double blur;                 ///< how far single precision may move its edges [pixels]
};

double rowAt(const Row3& row, double x, double y) {
  return row[0] * x + row[1] * y + row[2];
}

/// How far rounding moves a corner before the eye, seen in the picture.
double blurOf(const PixelMatrix& m, const std::array<float, 3>& p, const Row3& placed) {
  const auto sum = [&](const float* row) {
    double s = std::fabs(double{row[3]});
    for (int k = 0; k < 3; ++k) s += std::fabs(double{row[k]} * double{p[static_cast<std::size_t>(k)]});
    return s;
  };
  if (!(placed[2] > 0)) return 0;
  const double x = std::fabs(placed[0] / placed[2]), y = std::fabs(placed[1] / placed[2]);
  if (!(x < 40000 && y < 40000)) return 0;  // is clipped in double precision
  return 8 * kRounding * (std::max(sum(m.x), sum(m.y)) + std::max(x, y) * sum(m.w)) / placed[2];
}

HomogeneousTriangle homogeneous(const PixelMatrix& m, const std::array<std::array<float, 3>, 3>& corners) {
  HomogeneousTriangle t{};
  t.blur = 0.03;
  for (std::size_t k = 0; k < 3; ++k) {
    const float* rows[] = {m.x, m.y, m.w};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      double sum = double{rows[axis][3]};
      for (std::size_t i = 0; i < 3; ++i) sum += double{rows[axis][i]} * double{corners[k][i]};
      t.corner[k][axis] = sum;
    }
    t.blur += blurOf(m, corners[k], t.corner[k]);
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const Row3 &b = t.corner[(k + 1) % 3], &c = t.corner[(k + 2) % 3];
    t.weight[k] = {b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2], b[0] * c[1] - b[1] * c[0]};
  }
  t.whole =
      t.corner[0][0] * t.weight[0][0] + t.corner[0][1] * t.weight[0][1] + t.corner[0][2] * t.weight[0][2];
  return t;
}

std::string describe(const HomogeneousTriangle& t) {
  std::string text = "; corners times w:";
  for (const Row3& c : t.corner)
    text += " (" + std::to_string(c[0]) + ", " + std::to_string(c[1]) + ", " + std::to_string(c[2]) + ")";
  return text + ", blur " + std::to_string(t.blur);
}

enum class Seen { No, Yes, Unclear };

/// Whether a sample lies inside, before the eye and behind the near plane. Close to a border rounding
/// decides.
Seen sampleSeen(const HomogeneousTriangle& t, double x, double y, double mostDepth, double& depth) {
  Row3 plane{};
  bool inside = true;
  for (const Row3& w : t.weight) {
    const double at = rowAt(w, x, y) / t.whole, across = std::hypot(w[0], w[1]) / std::fabs(t.whole);
    if (!(std::fabs(at) > t.blur * across)) return Seen::Unclear;
    inside = inside && at > 0;
    for (std::size_t k = 0; k < 3; ++k) plane[k] += w[k] / t.whole;
  }
  depth = rowAt(plane, x, y);
  const double across = std::hypot(plane[0], plane[1]);
  if (!(std::fabs(depth - mostDepth) > t.blur * across + 1e-5 * mostDepth)) return Seen::Unclear;
  if (!(std::fabs(depth) > t.blur * across)) return Seen::Unclear;
  return inside && depth > 0 && depth < mostDepth ? Seen::Yes : Seen::No;
}

/// Points that make triangles of all kinds around what a camera at the origin, which looks along +y, sees.
class HostilePoints {
public:
  explicit HostilePoints(unsigned seed) : random_(seed) {}

  std::array<std::array<float, 3>, 3> triangle() {
    std::array<std::array<double, 3>, 3> p;
    const double size = std::exp(from(-9, 3));
    const std::array<double, 3> middle = seen(std::exp(from(-2, 5)));
    for (auto& corner : p)
      for (std::size_t k = 0; k < 3; ++k) corner[k] = middle[k] + from(-size, size);
    const unsigned kind = random_() % 10;
    if (kind == 0) p[random_() % 3][1] *= -1;  // through the near plane
    if (kind == 1)
      for (auto& corner : p) corner = anywhere(20);
    if (kind == 2)  // a sliver
      for (std::size_t k = 0; k < 3; ++k) p[2][k] = p[1][k] + from(-1e-4, 1e-4) * size;
    if (kind == 3) p[2] = p[random_() % 3];  // degenerate, more often than not
    if (kind == 4)
      for (auto& corner : p) corner = anywhere(std::exp(from(0, 80)));
    if (kind == 5) p[random_() % 3][random_() % 3] = odd();
    if (kind == 6)
      for (auto& corner : p) corner[1] *= -1;  // behind the eye
    if (kind == 7) p[random_() % 3] = anywhere(std::exp(from(0, 12)));
    std::array<std::array<float, 3>, 3> out;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k) out[i][k] = static_cast<float>(p[i][k]);
    return out;
  }

private:
  double from(double lo, double hi) {
    return lo + (hi - lo) * (static_cast<double>(random_()) / 4294967296.0);
  }
  std::array<double, 3> seen(double distance) {
    return {distance * from(-0.5, 0.5), distance, distance * from(-0.5, 0.5)};
  }
  std::array<double, 3> anywhere(double size) {
    return {from(-size, size), from(-size, size), from(-size, size)};
  }
  double odd() {
    constexpr double kInf = std::numeric_limits<double>::infinity();
    const double values[] = {std::nan(""), kInf, -kInf, 3e38, -3e38, 1e20, 1e-40, 0};
    return values[random_() % 8];
  }

  std::mt19937 random_;
};

/// Draws the triangles of a mesh one by one and compares each with the plain drawing.
class HostileMesh {
public:
  HostileMesh(unsigned seed, const DrawKernels& kernels) : kernels_(kernels), setup_(kernels) {
    HostilePoints points(seed);
    test::MeshMaker maker(test::matt(1, 1, 1));
    for (unsigned t = 0; t < kTrianglesAMesh; ++t)
      maker.triangle(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0));
    auto mesh = maker.seal();
    for (unsigned t = 0; t < kTrianglesAMesh; ++t) {
      const auto corners = points.triangle();
      for (std::size_t k = 0; k < 3; ++k) mesh->positions[3 * t + k] = corners[k];
    }
    mesh->materials[0].doubleSided = true;
    mesh_ = std::make_shared<const CpuMesh>(*mesh, Look::Full);
    const DrawView view = test::lookAt(Vec3(0, 0, 0), Vec3(0, 1, 0), 0.9, 1);
    geometry_ = *ViewGeometry::of(view.projection, view.view, kHostileSide, kHostileSide);
    setup_.begin(geometry_, kHostileSamples);
    setup_.add(mesh_, 0, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}, Transparency::Opaque);
    setup_.divide();
    for (std::size_t i = 0; i < setup_.placePieces(); ++i) setup_.place(i);
    for (std::size_t i = 0; i < setup_.setUpPieces(); ++i) setup_.setUp(i);
  }

  /// Returns what is wrong with the first wrong triangle, or nothing.
  std::string compare() {
    std::vector<const TriangleRecord*> records;
    setup_.forEach(Transparency::Opaque, 0,
                   [&](const TriangleRecord* from, std::span<const std::uint32_t> numbers, bool) {
                     for (const std::uint32_t i : numbers) records.push_back(from + i);
                   });
    std::size_t next = 0;
    for (unsigned t = 0; t < kTrianglesAMesh; ++t) {
      const std::size_t first = next;
      while (next < records.size() && records[next]->triangle == t) ++next;
      if (std::string wrong = compareOne(t, std::span(records).subspan(first, next - first)); !wrong.empty())
        return "triangle " + std::to_string(t) + ", " + kernels_.name + ": " + wrong;
    }
    return next == records.size() ? "" : "records are out of order";
  }
  std::size_t samplesSeen() const { return seen_; }

private:
  std::string compareOne(unsigned number, std::span<const TriangleRecord* const> records) {
    constexpr int kStride = 16 * kHostileSamples;
    std::array<float, kStride * kHostileSide> depths;
    std::array<unsigned, kStride * kHostileSide> shown;
    depths.fill(0), shown.fill(kNoTriangle);
    kernels_.cover(records.data(), static_cast<unsigned>(records.size()), 0, kHostileSamples, nullptr,
                   {depths.data(), shown.data(), kStride, 0, kHostileSide});
    std::array<std::array<float, 3>, 3> corners;
    std::ranges::transform(mesh_->triangle(number), corners.begin(),
                           [&](int v) { return mesh_->position(v); });
    const HomogeneousTriangle t = homogeneous(setup_.instance(0).matrix, corners);
    static const auto places = test::samplePlaces(kHostileSamples);
    for (int y = 0; y < kHostileSide; ++y)
      for (int x = 0; x < kHostileSide; ++x)
        for (int s = 0; s < kHostileSamples; ++s) {
          const auto at = static_cast<std::size_t>(y * kStride + x * kHostileSamples + s);
          const auto& place = places[static_cast<std::size_t>(s)];
          if (std::string wrong = compareSample(t, x + place[0], y + place[1], shown[at], depths[at]);
              !wrong.empty())
            return wrong + describe(t);
        }
    return {};
  }

  std::string compareSample(const HomogeneousTriangle& t, double x, double y, unsigned shown, float depth) {
    const double most = double{geometry_.mostDepth};
    if (shown != kNoTriangle && !(depth >= 0 && depth <= geometry_.mostDepth)) return "no depth";
    double expected = 0;
    const Seen seen = sampleSeen(t, x, y, most, expected);
    if (seen == Seen::Unclear) return {};
    if ((seen == Seen::Yes) != (shown != kNoTriangle))
      return "sample " + std::to_string(x) + ", " + std::to_string(y) +
             (shown == kNoTriangle ? " is missing" : " is not covered");
    if (seen != Seen::Yes) return {};
    ++seen_;
    Row3 plane{};
    for (const Row3& w : t.weight)
      for (std::size_t k = 0; k < 3; ++k) plane[k] += w[k] / t.whole;
    const double allowed = 5e-3 * expected + t.blur * std::hypot(plane[0], plane[1]);
    if (std::fabs(double{depth} - expected) <= allowed) return {};
    return "depth " + std::to_string(depth) + " instead of " + std::to_string(expected);
  }

  const DrawKernels& kernels_;
  PictureSetup setup_;
  std::shared_ptr<const CpuMesh> mesh_;
  ViewGeometry geometry_;
  std::size_t seen_ = 0;
};

TEST(CpuHostileTriangles, CoverWhatAPlainDrawingCovers) {
  const char* wanted = std::getenv("STADION_FUZZED_TRIANGLES");
  const unsigned long long triangles = wanted ? std::strtoull(wanted, nullptr, 10) : 50'000;
  const auto kernels = drawKernelsHere();
  std::size_t seen = 0;
  unsigned seed = 0;
  for (unsigned long long done = 0; done < triangles; done += kTrianglesAMesh, ++seed) {
    HostileMesh mesh(seed, *kernels[seed % kernels.size()]);
    const std::string wrong = mesh.compare();
    ASSERT_EQ(wrong, "") << "mesh " << seed;
    seen += mesh.samplesSeen();
  }
  EXPECT_GT(seen, triangles / 4);
}

}  // namespace
}  // namespace stadion
