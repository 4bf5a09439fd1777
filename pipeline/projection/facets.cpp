#include "pipeline/projection/facets.h"

#include "engine/maths/eigen.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace stadion {
namespace {

constexpr std::uint32_t kSteps = 24;  ///< samples of a part of the output, along each side
constexpr std::uint32_t kRound = 8;   ///< borders between facets lie at multiples of so many pixels
constexpr std::uint32_t kMostFacetPixels = 8192;  ///< a side of a facet's picture
constexpr double kFlattest = 0.2;                 ///< cosine of the flattest ray to a facet
constexpr double kFilterBorder = 3;               ///< around a facet's picture, for the filter [pixels]
constexpr double kDensest = 0.1;   ///< share of the samples where the facet may be coarser than the output
constexpr double kViewCost = 2e5;  ///< of a further view, in pixels

/// A point, and how far it is to the next pixels' points [m].
struct PixelStep {
  Vec3 at, across, down;
};

/// The points of a part of the output that lie on the screen.
struct Sampled {
  std::vector<Vec3> points;
  std::vector<PixelStep> steps;
};

struct Part {
  std::uint32_t left, top, right, bottom;
};

/// Samples one part of the output.
class Sampling {
public:
  Sampling(const Projector& projector, const ThrownImage& image, const Part& part)
      : projector_(projector), image_(image), part_(part) {}

  Sampled run() {
    for (std::uint32_t j = 0; j <= kSteps; ++j)
      for (std::uint32_t i = 0; i <= kSteps; ++i) {
        const Vec2 at = place(i, j);
        const auto point = pointAt(at);
        if (i < kSteps) edge(at, point, place(i + 1, j));
        if (j < kSteps) edge(at, point, place(i, j + 1));
        if (point) add(at, *point);
      }
    return std::move(found_);
  }

private:
  Vec2 place(std::uint32_t i, std::uint32_t j) const {
    return {part_.left + (part_.right - part_.left) * double(i) / kSteps,
            part_.top + (part_.bottom - part_.top) * double(j) / kSteps};
  }

  std::optional<Vec3> pointAt(const Vec2& place) const {
    return image_.pointAt(Vec2(place.x() / projector_.width, place.y() / projector_.height));
  }

  void add(const Vec2& at, const Vec3& point) {
    found_.points.push_back(point);
    const auto right = pointAt(at + Vec2(1, 0)), left = pointAt(at - Vec2(1, 0));
    const auto down = pointAt(at + Vec2(0, 1)), up = pointAt(at - Vec2(0, 1));
    if (right && left && down && up)
      found_.steps.push_back({point, 0.5 * (*right - *left), 0.5 * (*down - *up)});
  }

  /// If the screen ends between two places, adds the last point before its end.
  void edge(Vec2 a, std::optional<Vec3> pointA, Vec2 b) {
    auto pointB = pointAt(b);
    if (pointA.has_value() == pointB.has_value()) return;
    if (!pointA) {
      std::swap(a, b);
      std::swap(pointA, pointB);
    }
    while ((b - a).norm() > 0.5) {
      const Vec2 middle = 0.5 * (a + b);
      const auto point = pointAt(middle);
      (point ? a : b) = middle;
      if (point) pointA = point;
    }
    found_.points.push_back(*pointA);
  }

  const Projector& projector_;
  const ThrownImage& image_;
  const Part part_;
  Sampled found_;
};

/// The usual place, and the places farthest from it in 14 directions.
std::array<Vec3, 15> eyesOf(const VisitorPlace& visitor) {
  std::array<Vec3, 15> eyes;
  eyes[0] = visitor.eye;
  std::size_t n = 1;
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {-1.0, 1.0}) eyes[n++] = visitor.eye + sign * visitor.reach * Vec3::Unit(axis);
  for (unsigned corner = 0; corner < 8; ++corner) {
    const Vec3 way(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
    eyes[n++] = visitor.eye + visitor.reach * way.normalized();
  }
  return eyes;
}

/// A plane with axes, on which a facet lies.
struct Sheet {
  Vec3 at, right, up, normal;  ///< unit; the normal points to the visitor
};

/// The sheet through the points, as upright as the output's picture is.
Sheet sheetThrough(const Sampled& s, const Vec3& eye, bool facingEye) {
  Vec3 middle = Vec3::Zero(), across = Vec3::Zero();
  for (const Vec3& p : s.points) middle += p / static_cast<double>(s.points.size());
  for (const PixelStep& step : s.steps) across += step.across;
  Mat3 spread = Mat3::Zero();
  for (const Vec3& p : s.points) spread += (p - middle) * (p - middle).transpose();
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(spread);
  Sheet sheet{
      middle, {}, {}, facingEye ? Vec3((eye - middle).normalized()) : Vec3(solver.eigenvectors().col(0))};
  if (sheet.normal.dot(eye - middle) < 0) sheet.normal = -sheet.normal;
  Vec3 right = across - across.dot(sheet.normal) * sheet.normal;
  if (!(right.norm() > 1e-12)) right = sheet.normal.unitOrthogonal();
  sheet.right = right.normalized();
  sheet.up = sheet.normal.cross(sheet.right);
  return sheet;
}

/// Where the ray from the eye through the point meets the sheet, along its axes; nothing if the ray is too
/// flat.
std::optional<Vec2> onSheet(const Sheet& sheet, const Vec3& eye, const Vec3& point) {
  const Vec3 ray = point - eye;
  const double toSheet = sheet.normal.dot(sheet.at - eye), along = sheet.normal.dot(ray);
  if (!(along < -kFlattest * ray.norm()) || !(toSheet < -kMinEyeDistance)) return std::nullopt;
  const Vec3 hit = eye + ray * (toSheet / along) - sheet.at;
  return Vec2(hit.dot(sheet.right), hit.dot(sheet.up));
}

struct Extent {
  Vec2 low = Vec2::Constant(1e300), high = Vec2::Constant(-1e300);
};

std::optional<Extent> extentOn(const Sheet& sheet, const Sampled& s, const VisitorPlace& visitor) {
  Extent e;
  for (const Vec3& eye : eyesOf(visitor))
    for (const Vec3& p : s.points) {
      const auto at = onSheet(sheet, eye, p);
      if (!at) return std::nullopt;
      e.low = e.low.cwiseMin(*at);
      e.high = e.high.cwiseMax(*at);
    }
  return e;
}

/// How large a pixel of the facet's picture may be, along the sheet's axes [m].
Vec2 pitchOn(const Sheet& sheet, const Sampled& s, const Vec3& eye) {
  std::array<std::vector<double>, 2> sizes;
  for (const PixelStep& step : s.steps) {
    const auto at = onSheet(sheet, eye, step.at);
    Vec2 size = Vec2::Zero();
    for (const Vec3& way : {step.across, step.down})
      if (const auto next = onSheet(sheet, eye, step.at + way); at && next)
        size = size.cwiseMax((*next - *at).cwiseAbs());
    for (int axis = 0; axis < 2; ++axis)
      if (size[axis] > 0) sizes[static_cast<std::size_t>(axis)].push_back(size[axis]);
  }
  Vec2 pitch(1e300, 1e300);
  for (int axis = 0; axis < 2; ++axis) {
    auto& all = sizes[static_cast<std::size_t>(axis)];
    if (all.empty()) continue;
    const auto at = all.begin() + static_cast<std::ptrdiff_t>(kDensest * static_cast<double>(all.size()));
    std::nth_element(all.begin(), at, all.end());
    pitch[axis] = *at;
  }
  return pitch;
}

struct Fitted {
  Facet facet;
  Vec2 pixels;
};

Wall rectangleOn(const Sheet& sheet, const Extent& e) {
  const auto corner = [&](double x, double y) { return Vec3(sheet.at + x * sheet.right + y * sheet.up); };
  return {{}, corner(e.low.x(), e.low.y()), corner(e.high.x(), e.low.y()), corner(e.low.x(), e.high.y())};
}

std::optional<Fitted> fit(const Part& part, const Sampled& s, const VisitorPlace& visitor) {
  for (const bool facingEye : {false, true}) {
    const Sheet sheet = sheetThrough(s, visitor.eye, facingEye);
    auto e = extentOn(sheet, s, visitor);
    if (!e) continue;
    const Vec2 pitch = pitchOn(sheet, s, visitor.eye), size = e->high - e->low;
    if (!(size.minCoeff() > 0) || !(pitch.maxCoeff() < 1e300)) continue;
    e->low -= kFilterBorder * pitch;
    e->high += kFilterBorder * pitch;
    return Fitted{{rectangleOn(sheet, *e), part.left, part.top, part.right, part.bottom},
                  (e->high - e->low).cwiseQuotient(pitch)};
  }
  return std::nullopt;
}

std::uint32_t borderAt(std::uint32_t size, std::uint32_t number, std::uint32_t parts) {
  if (number == parts) return size;
  return std::uint32_t(std::uint64_t{size} * number / parts) / kRound * kRound;
}

/// The facets of columns x rows parts; nothing if one of them cannot be flat.
std::optional<Facets> split(const Projector& projector, const ThrownImage& image, const VisitorPlace& visitor,
                            std::uint32_t columns, std::uint32_t rows) {
  Facets facets;
  Vec2 pixels = Vec2::Zero();
  for (std::uint32_t r = 0; r < rows; ++r)
    for (std::uint32_t c = 0; c < columns; ++c) {
      const Part part{borderAt(projector.width, c, columns), borderAt(projector.height, r, rows),
                      borderAt(projector.width, c + 1, columns), borderAt(projector.height, r + 1, rows)};
      const Sampled s = Sampling(projector, image, part).run();
      if (s.steps.empty()) continue;  // it lights nothing
      const auto fitted = fit(part, s, visitor);
      if (!fitted) return std::nullopt;
      facets.all.push_back(fitted->facet);
      pixels = pixels.cwiseMax(fitted->pixels);
    }
  const auto side = [](double p) {
    return static_cast<std::uint32_t>(std::clamp(std::ceil(p), 16.0, double{kMostFacetPixels}));
  };
  facets.width = side(pixels.x());
  facets.height = side(pixels.y());
  return facets;
}

}  // namespace

double costOf(const Facets& facets) {
  return static_cast<double>(facets.all.size()) * (double(facets.width) * facets.height + kViewCost);
}

Facets facetsOf(const Projector& projector, const ThrownImage& image, const VisitorPlace& visitor) {
  std::optional<Facets> best;
  const std::uint32_t most = projector.eye ? Facets::kMost : Facets::kMost / 2;
  for (std::uint32_t columns = 1; columns <= most; ++columns)
    for (std::uint32_t rows = 1; rows * columns <= most; ++rows) {
      const auto facets = split(projector, image, visitor, columns, rows);
      if (facets && !facets->all.empty() && (!best || costOf(*facets) < costOf(*best))) best = facets;
    }
  return best ? std::move(*best) : Facets{};
}

}  // namespace stadion
