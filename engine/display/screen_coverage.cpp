#include "engine/display/screen_coverage.h"

#include "engine/display/output.h"
#include "engine/maths/functions.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr int kAcross = 64, kDown = 32;  ///< samples
constexpr int kPatches = 40;             ///< of a measured image, across and down

double part(int i, int of) {
  return (i + 0.5) / of;
}

/// Points of the three shapes that have two coordinates from 0 to 1.
struct ShapePoint {
  double u, v;

  Vec3 operator()(const Wall& w) const {
    const WallBasis b = basis(w);
    return w.lowerLeft + u * b.width * b.right + v * b.height * b.up;
  }
  Vec3 operator()(const CylinderScreen& s) const {
    const auto [sine, cosine] = det::sincos(s.left + u * (s.right - s.left));
    return s.centre + Vec3(s.radius * sine, s.radius * cosine, s.bottom + v * (s.top - s.bottom));
  }
  Vec3 operator()(const SphereScreen& s) const {
    const auto [sine, cosine] = det::sincos(s.left + u * (s.right - s.left));
    const double lo = det::sin(s.lowest), hi = det::sin(s.highest);
    const double z = lo + v * (hi - lo), level = std::sqrt(std::max(0.0, 1 - z * z));
    const auto [tiltSine, tiltCosine] = det::sincos(s.tilt);
    const Vec3 upright(level * sine, level * cosine, z);
    return s.centre + s.radius * Vec3(upright.x(), tiltCosine * upright.y() + tiltSine * upright.z(),
                                      tiltCosine * upright.z() - tiltSine * upright.y());
  }
  Vec3 operator()(const MeshScreen&) const { return Vec3::Zero(); }
};

double areaOf(const MeshScreen& mesh, const std::array<std::uint32_t, 3>& t) {
  return 0.5 * (mesh.points[t[1]] - mesh.points[t[0]]).cross(mesh.points[t[2]] - mesh.points[t[0]]).norm();
}

std::vector<Vec3> samplesOfMesh(const MeshScreen& mesh) {
  double total = 0;
  for (const auto& t : mesh.triangles) total += areaOf(mesh, t);
  constexpr int count = kAcross * kDown;
  std::vector<Vec3> samples;
  double passed = 0;
  for (const auto& t : mesh.triangles) {
    passed += areaOf(mesh, t);
    while (samples.size() < count && part(static_cast<int>(samples.size()), count) * total <= passed) {
      // Two irrational steps spread the points of a triangle evenly.
      const double k = static_cast<double>(samples.size());
      double s = std::fmod(k * 0.7548776662466927, 1), r = std::fmod(k * 0.5698402909980532, 1);
      if (s + r > 1) {
        s = 1 - s;
        r = 1 - r;
      }
      const Vec3& a = mesh.points[t[0]];
      samples.push_back(a + s * (mesh.points[t[1]] - a) + r * (mesh.points[t[2]] - a));
    }
  }
  return samples;
}

bool inOutput(double u, double v) {
  return u >= 0 && u <= 1 && v >= 0 && v <= 1;
}

}  // namespace

std::vector<Vec3> samplesOf(const Screen& screen) {
  if (const auto* mesh = std::get_if<MeshScreen>(&screen.surface)) return samplesOfMesh(*mesh);
  std::vector<Vec3> samples;
  for (int row = 0; row < kDown; ++row)
    for (int column = 0; column < kAcross; ++column)
      samples.push_back(std::visit(ShapePoint{part(column, kAcross), part(row, kDown)}, screen.surface));
  return samples;
}

LightTest::LightTest(const Projector& projector, const ScreenSurface& surface)
    : projector_(projector), surface_(surface) {
  if (std::holds_alternative<MeasuredImage>(projector.image)) addPatches();
}

void LightTest::addPatches() {
  const PixelRays rays(projector_, surface_);
  const auto at = [&](int column, int row) {
    return rays.pointLit(Vec2(static_cast<double>(column) / kPatches, static_cast<double>(row) / kPatches));
  };
  for (int row = 0; row < kPatches; ++row)
    for (int column = 0; column < kPatches; ++column) {
      const auto a = at(column, row), b = at(column + 1, row), c = at(column, row + 1),
                 d = at(column + 1, row + 1);
      if (a && b && c) patches_.push_back({*a, *b, *c});
      if (d && b && c) patches_.push_back({*d, *b, *c});
    }
}

bool LightTest::lights(const Vec3& p) const {
  if (const auto* pins = std::get_if<PinnedImage>(&projector_.image)) return betweenPins(*pins, p);
  if (!std::holds_alternative<MeasuredImage>(projector_.image)) return throughLens(p);
  return std::ranges::any_of(patches_, [&](const Patch& patch) {
    const Vec3 e1 = patch.b - patch.a, e2 = patch.c - patch.a, r = p - patch.a;
    const double size = e1.squaredNorm() + e2.squaredNorm();
    if (r.squaredNorm() > 2 * size) return false;
    const Vec3 n = e1.cross(e2);
    const double u = r.cross(e2).dot(n) / n.squaredNorm(), v = e1.cross(r).dot(n) / n.squaredNorm();
    return u >= -1e-3 && v >= -1e-3 && u + v <= 1 + 1e-3;
  });
}

bool LightTest::throughLens(const Vec3& p) const {
  const double width = projector_.width, height = projector_.height;
  const auto* lens = std::get_if<LensImage>(&projector_.image);
  const auto* fisheye = std::get_if<FisheyeImage>(&projector_.image);
  const Pose& X_RP = lens ? lens->X_RP : fisheye->X_RP;
  const Vec3 local = X_RP.q.conjugate() * (p - X_RP.p);
  if (lens) {
    if (!(local.y() > 0)) return false;
    const double w = 1 / lens->throwRatio, h = lens->pixelAspect * w * height / width;
    if (!inOutput(local.x() / local.y() / w + 0.5 - lens->shift.x(),
                  0.5 + lens->shift.y() - local.z() / local.y() / h))
      return false;
  } else {
    const Vec2 aside(local.x(), local.z());
    const double away = det::atan2(aside.norm(), local.y()) / fisheye->angle;
    if (away > 0.5) return false;
    const Vec2 shift = aside.norm() > 0 ? Vec2(away / aside.norm() * aside) : Vec2(Vec2::Zero());
    const double smaller = std::min(width, height);
    if (!inOutput(0.5 + shift.x() * smaller / width, 0.5 - shift.y() * smaller / height)) return false;
  }
  const auto first = surface_.hit(X_RP.p, p - X_RP.p);
  return first && (*first - p).norm() <= 1e-6 * (1 + (p - X_RP.p).norm());
}

bool LightTest::betweenPins(const PinnedImage& image, const Vec3& p) const {
  const auto* wall = std::get_if<Wall>(&surface_.screen().surface);
  const auto outputFromScreen = squareToQuad(image.pins);
  if (!wall || !outputFromScreen) return false;
  const WallBasis& b = surface_.plane();
  const Vec3 r = p - wall->lowerLeft;
  const Vec3 s = *outputFromScreen * Vec3(r.dot(b.right) / b.width, 1 - r.dot(b.up) / b.height, 1);
  return inOutput(s.x() / s.z(), s.y() / s.z());
}

}  // namespace stadion
