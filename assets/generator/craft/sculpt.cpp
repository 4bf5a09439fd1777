#include "assets/generator/craft/sculpt.h"

// The surface is found with "surface nets": one corner in every cell that it crosses, in the middle of the
// crossings of the cell's edges, then drawn to the surface; one quadrilateral around every crossed edge.

namespace stadion::assets {
namespace {

double ballDistance(Point p, Point middle, Point radii) {
  const Point q = p - middle;
  const Point scaled{q.x / radii.x, q.y / radii.y, q.z / radii.z};
  const Point twice{scaled.x / radii.x, scaled.y / radii.y, scaled.z / radii.z};
  const double near = length(scaled), slope = length(twice);
  return slope > 1e-9 ? near * (near - 1) / slope : -std::min({radii.x, radii.y, radii.z});
}

double rodDistance(Point p, Point a, Point b, double ra, double rb) {
  const Point along = b - a;
  const double s = std::clamp(dot(p - a, along) / std::max(dot(along, along), 1e-12), 0.0, 1.0);
  return length(p - a - s * along) - mix(ra, rb, s);
}

/// The smaller of the two, rounded off where they are about equal.
double melted(double a, double b, double over) {
  const double h = std::max(over - std::fabs(a - b), 0.0) / over;
  return std::min(a, b) - 0.25 * h * h * over;
}

class Net {
public:
  Net(const Clay& clay, Point low, Point high, double step) : clay_(clay), low_(low), step_(step) {
    n_[0] = static_cast<int>((high.x - low.x) / step) + 2;
    n_[1] = static_cast<int>((high.y - low.y) / step) + 2;
    n_[2] = static_cast<int>((high.z - low.z) / step) + 2;
    for (int k = 0; k < n_[2]; ++k)
      for (int j = 0; j < n_[1]; ++j)
        for (int i = 0; i < n_[0]; ++i) value_.push_back(clay.distance(corner(i, j, k)));
    cell_.assign(value_.size(), kNone);
  }

  Part cast() {
    for (int k = 0; k + 1 < n_[2]; ++k)
      for (int j = 0; j + 1 < n_[1]; ++j)
        for (int i = 0; i + 1 < n_[0]; ++i) place(i, j, k);
    for (int k = 1; k + 1 < n_[2]; ++k)
      for (int j = 1; j + 1 < n_[1]; ++j)
        for (int i = 1; i + 1 < n_[0]; ++i) join(i, j, k);
    return std::move(part_);
  }

private:
  static constexpr std::uint32_t kNone = 0xffffffff;

  Point corner(int i, int j, int k) const { return low_ + step_ * Point{double(i), double(j), double(k)}; }
  std::size_t at(int i, int j, int k) const {
    return (static_cast<std::size_t>(k) * static_cast<std::size_t>(n_[1]) + static_cast<std::size_t>(j)) *
               static_cast<std::size_t>(n_[0]) +
           static_cast<std::size_t>(i);
  }

  void place(int i, int j, int k) {
    Point sum{0, 0, 0};
    int crossings = 0;
    const auto edge = [&](std::array<int, 3> a, std::array<int, 3> b) {
      const double u = value_[at(i + a[0], j + a[1], k + a[2])], v = value_[at(i + b[0], j + b[1], k + b[2])];
      if ((u < 0) == (v < 0)) return;
      sum =
          sum + mix(corner(i + a[0], j + a[1], k + a[2]), corner(i + b[0], j + b[1], k + b[2]), u / (u - v));
      ++crossings;
    };
    for (int a = 0; a < 2; ++a)
      for (int b = 0; b < 2; ++b)
        edge({0, a, b}, {1, a, b}), edge({a, 0, b}, {a, 1, b}), edge({a, b, 0}, {a, b, 1});
    if (crossings == 0) return;
    Point p = 1.0 / crossings * sum;
    for (int n = 0; n < 3; ++n) p = p - 0.8 * clay_.distance(p) * clay_.outward(p);
    // Not out of the cell, so that no triangle turns over.
    const Point a = corner(i, j, k), b = corner(i + 1, j + 1, k + 1);
    p = {std::clamp(p.x, a.x, b.x), std::clamp(p.y, a.y, b.y), std::clamp(p.z, a.z, b.z)};
    cell_[at(i, j, k)] = static_cast<std::uint32_t>(part_.vertices.size());
    part_.vertices.push_back({p, {1, 1, 1}, {}, clay_.outward(p)});
  }

  void join(int i, int j, int k) {
    const bool inside = value_[at(i, j, k)] < 0;
    const auto around = [&](bool next, std::size_t a, std::size_t b, std::size_t c, std::size_t d) {
      if (inside == next) return;
      std::array<std::uint32_t, 4> q{cell_[a], cell_[b], cell_[c], cell_[d]};
      if (!inside) std::swap(q[1], q[3]);
      part_.triangles.push_back({q[0], q[1], q[2]}), part_.triangles.push_back({q[0], q[2], q[3]});
    };
    around(value_[at(i + 1, j, k)] < 0, at(i, j - 1, k - 1), at(i, j, k - 1), at(i, j, k), at(i, j - 1, k));
    around(value_[at(i, j + 1, k)] < 0, at(i - 1, j, k - 1), at(i - 1, j, k), at(i, j, k), at(i, j, k - 1));
    around(value_[at(i, j, k + 1)] < 0, at(i - 1, j - 1, k), at(i, j - 1, k), at(i, j, k), at(i - 1, j, k));
  }

  const Clay& clay_;
  Point low_;
  double step_;
  std::array<int, 3> n_{};
  std::vector<double> value_;
  std::vector<std::uint32_t> cell_;
  Part part_;
};

}  // namespace

Clay& Clay::on(int bone, const Pose& X) {
  const auto point = [](const Vec3& v) { return Point{v.x(), v.y(), v.z()}; };
  const Mat3 m = X.q.toRotationMatrix();
  bone_ = bone, turned_ = true;
  axes_ = {point(m.col(0)), point(m.col(1)), point(m.col(2))};
  origin_ = point(X.p);
  return *this;
}

void Clay::put(Kind kind, Point a, Point b, double ra, double rb, double melt) {
  Lump lump{kind, a, b, ra, rb, melt, {}, 0, bone_, turned_, axes_, origin_};
  const bool rod = kind == Kind::Rod;
  const Point middle = rod ? 0.5 * (a + b) : a;
  lump.reach = rod ? 0.5 * length(b - a) + std::max(ra, rb) : std::max({b.x, b.y, b.z});
  lump.middle = turned_ ? origin_ + middle.x * axes_[0] + middle.y * axes_[1] + middle.z * axes_[2] : middle;
  lumps_.push_back(lump);
  if (kind == Kind::Hollow) return;
  const auto grow = [&](Point at, double reach) {
    const Point p = turned_ ? origin_ + at.x * axes_[0] + at.y * axes_[1] + at.z * axes_[2] : at;
    low_ = {std::min(low_.x, p.x - reach), std::min(low_.y, p.y - reach), std::min(low_.z, p.z - reach)};
    high_ = {std::max(high_.x, p.x + reach), std::max(high_.y, p.y + reach), std::max(high_.z, p.z + reach)};
  };
  if (rod)
    grow(a, ra), grow(b, rb);
  else
    grow(a, lump.reach);
}

Clay& Clay::ball(Point middle, Point radii, double melt) {
  put(Kind::Ball, middle, radii, 0, 0, melt);
  return *this;
}

Clay& Clay::balls(Point middle, Point radii, double melt) {
  return ball(middle, radii, melt).ball({-middle.x, middle.y, middle.z}, radii, melt);
}

Clay& Clay::rod(Point a, Point b, double ra, double rb, double melt) {
  put(Kind::Rod, a, b, ra, rb, melt);
  return *this;
}

Clay& Clay::rods(Point a, Point b, double ra, double rb, double melt) {
  return rod(a, b, ra, rb, melt).rod({-a.x, a.y, a.z}, {-b.x, b.y, b.z}, ra, rb, melt);
}

Clay& Clay::hollow(Point middle, Point radii, double melt) {
  put(Kind::Hollow, middle, radii, 0, 0, melt);
  return *this;
}

Clay& Clay::relief(std::function<double(Point)> out) {
  relief_ = std::move(out);
  return *this;
}

double Clay::distance(const Lump& lump, Point p) {
  if (lump.turned) {
    const Point q = p - lump.origin;
    p = {dot(lump.axes[0], q), dot(lump.axes[1], q), dot(lump.axes[2], q)};
  }
  return lump.kind == Kind::Rod ? rodDistance(p, lump.a, lump.b, lump.ra, lump.rb)
                                : ballDistance(p, lump.a, lump.b);
}

double Clay::distance(Point p) const {
  double d = 1e3;
  for (const Lump& lump : lumps_) {
    if (lump.kind == Kind::Hollow) {
      d = -melted(-d, distance(lump, p), lump.melt);
      continue;
    }
    // What is too far away to melt changes nothing. A flat ball's distance may seem half of what it is.
    if (turned_ && length(p - lump.middle) - lump.reach > 2 * std::max(d, 0.0) + 2 * lump.melt + 0.02)
      continue;
    d = melted(d, distance(lump, p), lump.melt);
  }
  return relief_ ? d - relief_(p) : d;
}

Point Clay::outward(Point p) const {
  constexpr double h = 5e-4;
  const Point g{distance(p + Point{h, 0, 0}) - distance(p - Point{h, 0, 0}),
                distance(p + Point{0, h, 0}) - distance(p - Point{0, h, 0}),
                distance(p + Point{0, 0, h}) - distance(p - Point{0, 0, h})};
  return length(g) > 1e-9 ? normalized(g) : Point{0, 0, 1};
}

Part Clay::cast(double step, const std::function<Rgb(Point, Point)>& colour) const {
  const Point room = 2.5 * step * Point{1, 1, 1} + Point{0.02, 0.02, 0.02};
  return cast(step, low_ - room, high_ + room, colour);
}

Part Clay::cast(double step, Point low, Point high, const std::function<Rgb(Point, Point)>& colour) const {
  Part part = Net(*this, low, high, step).cast();
  for (Vertex& v : part.vertices) v.colour = colour(v.p, v.n);
  return part;
}

double Clay::open(Point p, Point outward, double reach) const {
  return std::clamp(distance(p + reach * outward) / reach, 0.0, 1.0);
}

std::vector<double> Clay::pulls(Point p, std::size_t bones, double over) const {
  std::vector<double> least(bones, 1e3);
  double nearest = 1e3;
  for (const Lump& lump : lumps_) {
    if (lump.kind == Kind::Hollow) continue;
    const double d = distance(lump, p);
    double& of = least[static_cast<std::size_t>(lump.bone)];
    of = std::min(of, d), nearest = std::min(nearest, d);
  }
  for (double& d : least) d = det::exp(std::max((nearest - d) / over, -30.0));
  return least;
}

Part mirrored(Part part) {
  for (Vertex& v : part.vertices) v.p.x = -v.p.x, v.n.x = -v.n.x;
  for (auto& t : part.triangles) std::swap(t[1], t[2]);
  return part;
}

}  // namespace stadion::assets
