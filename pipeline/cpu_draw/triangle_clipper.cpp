#include "pipeline/cpu_draw/triangle_clipper.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>

namespace stadion {
namespace {

constexpr double kClipMargin = 64;  ///< around the picture [pixels]

double planeProduct(const std::array<double, 3>& a, const std::array<double, 3>& b,
                    const std::array<double, 3>& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// The first and the last pixel with a sample in a stretch; false: there is none.
bool pixelSpan(double from, double to, int samples, int size, short& first, short& last) {
  const double low = std::ceil(from * samples - 0.5), high = std::floor(to * samples - 0.5);
  const double a = std::max(std::floor(low / samples), 0.0),
               b = std::min(std::floor(high / samples), size - 1.0);
  if (!(low <= high && a <= b)) return false;
  first = static_cast<short>(a);
  last = static_cast<short>(b);
  return true;
}

}  // namespace

/// A polygon that is cut at a border again and again, without asking for memory.
class TriangleClipper::Polygon {
public:
  /// A cut adds a corner, or by rounding at most half of those there are: after five cuts 19.
  static constexpr std::size_t kMost = 20;

  explicit Polygon(const std::array<Corner, 3>& corners) : size_(3) {
    std::ranges::copy(corners, at_.begin());
  }

  std::span<const Corner> corners() const { return {at_.data(), size_}; }

  /// Keeps the part on whose corners `distance`, which is linear, is not negative.
  template <class Distance>
  void cut(const Distance& distance) {
    if (std::ranges::all_of(corners(), [&](const Corner& c) { return distance(c) >= 0; })) return;
    const Polygon whole = *this;
    size_ = 0;
    for (std::size_t i = 0; i < whole.size_; ++i) {
      const Corner &a = whole.at_[i], &b = whole.at_[(i + 1) % whole.size_];
      const double da = distance(a), db = distance(b);
      if (da >= 0) at_[size_++] = a;
      if ((da >= 0) == (db >= 0)) continue;
      // From the end that lies nearer to the border: the other one may be so far away that rounding would
      // lose the first. And neighbours that share the edge get the same point.
      const bool fromA = std::fabs(da) < std::fabs(db);
      const Corner &from = fromA ? a : b, &to = fromA ? b : a;
      const double t = fromA ? da / (da - db) : db / (db - da);
      at_[size_++] = {from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1]),
                      from[2] + t * (to[2] - from[2])};
    }
  }

private:
  std::array<Corner, kMost> at_;
  std::size_t size_;
};

/// Calls work(distance) for the near plane and the four margins: a corner within has no negative distance.
template <class Work>
void TriangleClipper::forEachBorder(const Work& work) const {
  const double most = static_cast<double>(by_.mostDepth);
  if (parallel_) {
    work([&](const Corner& c) { return most - c[2]; });
  } else {
    work([&](const Corner& c) { return c[2] - 1 / most; });
  }
  const auto w = [this](const Corner& c) { return parallel_ ? 1.0 : c[2]; };
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const double size = axis == 0 ? by_.width : by_.height;
    work([&](const Corner& c) { return c[axis] + kClipMargin * w(c); });
    work([&](const Corner& c) { return (size + kClipMargin) * w(c) - c[axis]; });
  }
}

bool TriangleClipper::isOutside(const std::array<Corner, 3>& corners) const {
  bool outside = false;
  forEachBorder([&](const auto& distance) {
    outside = outside || std::ranges::all_of(corners, [&](const Corner& c) { return distance(c) < 0; });
  });
  return outside;
}

TriangleClipper::Polygon TriangleClipper::clipped(const std::array<Corner, 3>& corners) const {
  Polygon p(corners);
  forEachBorder([&](const auto& distance) { p.cut(distance); });
  return p;
}

std::optional<TriangleClipper::Plane> TriangleClipper::planeOf(const std::array<Corner, 3>& p) const {
  Plane plane{0, 0, 0};
  if (parallel_) {
    const double bx = p[1][0] - p[0][0], by = p[1][1] - p[0][1], cx = p[2][0] - p[0][0],
                 cy = p[2][1] - p[0][1];
    const double bz = p[1][2] - p[0][2], cz = p[2][2] - p[0][2], area = bx * cy - by * cx;
    plane.right = (bz * cy - cz * by) / area;
    plane.up = (cz * bx - bz * cx) / area;
    plane.at = p[0][2] - plane.right * p[0][0] - plane.up * p[0][1];
  } else {
    // 1 / w is the sum of the planes that are 1 / w at one corner and 0 at the others.
    const double whole = planeProduct(p[0], p[1], p[2]);
    for (std::size_t k = 0; k < 3; ++k) {
      const Corner &b = p[(k + 1) % 3], &c = p[(k + 2) % 3];
      plane.right += (b[1] * c[2] - b[2] * c[1]) / whole;
      plane.up += (b[2] * c[0] - b[0] * c[2]) / whole;
      plane.at += (b[0] * c[1] - b[1] * c[0]) / whole;
    }
  }
  if (!std::isfinite(plane.right + plane.up + plane.at)) return {};
  return plane;
}

void TriangleClipper::clip(const std::array<std::array<float, 3>, 3>& corners, const PixelMatrix& m,
                           unsigned triangle, bool grow, std::vector<TriangleRecord>& out) const {
  std::array<Corner, 3> placed;
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const float* rows[] = {m.x, m.y, m.w};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float* r = rows[axis];
      placed[k][axis] =
          double{r[0]} * corners[k][0] + double{r[1]} * corners[k][1] + double{r[2]} * corners[k][2] + r[3];
      sum += std::fabs(placed[k][axis]);
    }
  }
  if (!std::isfinite(sum) || isOutside(placed)) return;
  const std::optional<Plane> plane = planeOf(placed);
  if (!plane) return;
  const Polygon seen = clipped(placed);
  std::array<std::array<double, 2>, Polygon::kMost> at;
  std::size_t size = 0;
  double nearest = -1e30;
  for (const Corner& c : seen.corners()) {
    const double w = parallel_ ? 1 : c[2];
    at[size++] = {c[0] / w, c[1] / w};
    nearest = std::max(nearest, parallel_ ? c[2] : 1 / w);
  }
  double area = 0;
  for (std::size_t i = 1; i + 1 < size; ++i)
    area +=
        (at[i][0] - at[0][0]) * (at[i + 1][1] - at[0][1]) - (at[i][1] - at[0][1]) * (at[i + 1][0] - at[0][0]);
  if (area == 0 || (by_.facing > 0 && area < 0) || (by_.facing < 0 && area > 0)) return;
  unsigned flags = kClipped;
  if (by_.mirrored > 0 ? area < 0 : area > 0) flags |= kFacesAway;
  if (grow) flags |= kGrown;
  const float most = std::min(static_cast<float>(nearest), by_.mostDepth);
  for (std::size_t i = 1; i + 1 < size; ++i)
    emit({at[0], at[i], at[i + 1]}, *plane, most, triangle, flags, out);
}

void TriangleClipper::emit(const std::array<std::array<double, 2>, 3>& at, const Plane& plane, float most,
                           unsigned triangle, unsigned flags, std::vector<TriangleRecord>& out) const {
  auto p = at;
  std::ranges::sort(p, {}, [](const auto& q) { return static_cast<float>(q[1]); });
  TriangleRecord r{};
  const auto [left, right] = std::minmax({p[0][0], p[1][0], p[2][0]});
  if (!pixelSpan(left, right, by_.samples, by_.width, r.left, r.right) ||
      !pixelSpan(p[0][1], p[2][1], by_.samples, by_.height, r.low, r.high))
    return;
  const auto x = [&](std::size_t k) { return static_cast<float>(p[k][0]); };
  const auto y = [&](std::size_t k) { return static_cast<float>(p[k][1]); };
  r.x0 = x(0);
  r.y0 = y(0);
  r.x1 = x(1);
  r.y1 = y(1);
  r.y2 = y(2);
  r.slopeLong = (x(2) - x(0)) / (y(2) - y(0));
  r.slopeLow = (x(1) - x(0)) / (y(1) - y(0));
  r.slopeHigh = (x(2) - x(1)) / (y(2) - y(1));
  if ((x(2) - x(0)) * (y(1) - y(0)) - (y(2) - y(0)) * (x(1) - x(0)) < 0) flags |= kLongEdgeIsLeft;
  const float step = std::bit_cast<float>(std::bit_cast<std::uint32_t>(most) & 0x7f800000U) * 1.1920929e-7f;
  const double steep = std::max(std::fabs(plane.right), std::fabs(plane.up));
  const double offset =
      static_cast<double>(by_.slopeOffset) * steep + static_cast<double>(by_.stepOffset * step);
  r.depthX = static_cast<float>(plane.right);
  r.depthY = static_cast<float>(plane.up);
  r.depth = static_cast<float>(plane.at + plane.right * r.left + plane.up * r.low + offset);
  r.mostDepth = most + static_cast<float>(offset);
  r.triangle = triangle;
  r.sourceAndFlags = by_.source << kFlagBits | flags;
  out.push_back(r);
}

}  // namespace stadion
