#include "dynamics/contact/flat_friction.h"

#include "engine/maths/functions.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr double kStraight = 1e-3;  ///< spin, relative to the slide, below which its series is more exact
constexpr double kThin = 1e-4;      ///< an area this much narrower than long is a line
constexpr double kAgrees = 1e-12;   ///< of a direction on the limit surface
constexpr int kSearch = 40;         ///< steps towards one at most

double planarCross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// log(1 + x) for x >= 0, also of the smallest.
double logOfOneMore(double x) {
  if (x > 0.1) return det::log(1 + x);
  const double z = x / (2 + x), q = z * z;
  double sum = 0;
  for (int k = 15; k > 0; k -= 2) sum = sum * q + 1.0 / k;
  return 2 * z * sum;
}

/// What the integrals need of one side, seen from a point: the integral of the distance along it, and of its
/// inverse.
struct EdgeIntegrals {
  double away, near, far;  ///< from the line; from its ends
  double distance, inverse;
};

EdgeIntegrals seenFrom(const Vec2& p, const Vec2& from, const Vec2& along, const Vec2& out, double length) {
  const Vec2 d = from - p;
  EdgeIntegrals s;
  s.away = out.dot(d);
  const double a = along.dot(d), b = a + length;
  s.near = std::sqrt(a * a + s.away * s.away);
  s.far = std::sqrt(b * b + s.away * s.away);
  const double farther = length * (a + b) / (s.far + s.near);  // far - near, without cancellation
  s.inverse = 0;
  if (std::fabs(s.away) > 1e-14 * length) {
    if (a >= 0) {
      s.inverse = logOfOneMore((length + farther) / (a + s.near));
    } else if (b <= 0) {
      s.inverse = logOfOneMore((length - farther) / (s.far - b));
    } else {
      s.inverse = det::log((b + s.far) / std::fabs(s.away) * ((s.near - a) / std::fabs(s.away)));
    }
  }
  s.distance = 0.5 * (length * s.far + a * farther + s.away * s.away * s.inverse);
  return s;
}

}  // namespace

void ContactArea::addPolygon(const Vec2* corners, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) addEdge(corners[i], corners[(i + 1) % count]);
}

/// Edges between two parts that lie side by side bound nothing.
void ContactArea::cancelInner() {
  double size = 0;
  for (const Edge& e : edges_)
    size = std::max({size, e.from.cwiseAbs().maxCoeff(), e.to.cwiseAbs().maxCoeff()});
  const double same = 1e-9 * size;
  const auto before = [](const Vec2& a, const Vec2& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  };
  const auto low = [&](const Edge& e) -> const Vec2& { return before(e.from, e.to) ? e.from : e.to; };
  std::ranges::stable_sort(edges_, [&](const Edge& a, const Edge& b) { return low(a).x() < low(b).x(); });
  std::vector<char> inner(edges_.size(), 0);
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    if (inner[i] != 0) continue;
    for (std::size_t k = i + 1; k < edges_.size() && low(edges_[k]).x() <= low(edges_[i]).x() + same; ++k) {
      if (inner[k] != 0 || !((edges_[i].from - edges_[k].to).cwiseAbs().maxCoeff() <= same) ||
          !((edges_[i].to - edges_[k].from).cwiseAbs().maxCoeff() <= same))
        continue;
      inner[i] = inner[k] = 1;
      break;
    }
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < edges_.size(); ++i)
    if (inner[i] == 0 && (edges_[i].to - edges_[i].from).squaredNorm() > same * same)
      edges_[kept++] = edges_[i];
  edges_.resize(kept);
}

/// Moments about the middle, by triangles between it and the sides.
void ContactArea::measure() {
  for (const Side& s : sides_) {
    const Vec2 a = s.from, b = s.from + s.length * s.along;
    const double twice = planarCross(a, b);
    area_ += 0.5 * twice;
    xx_ += twice * (a.x() * a.x() + a.x() * b.x() + b.x() * b.x()) / 12;
    yy_ += twice * (a.y() * a.y() + a.y() * b.y() + b.y() * b.y()) / 12;
    xy_ += twice * (2 * a.x() * a.y() + a.x() * b.y() + b.x() * a.y() + 2 * b.x() * b.y()) / 24;
    const auto third = [&](int i, int j, int k) {
      const double ends = a[i] * a[j] * a[k] + b[i] * b[j] * b[k];
      const double mixed = a[i] * a[j] * b[k] + a[i] * b[j] * a[k] + b[i] * a[j] * a[k] + a[i] * b[j] * b[k] +
                           b[i] * a[j] * b[k] + b[i] * b[j] * a[k];
      return twice * (ends / 20 + mixed / 60);
    };
    xxx_ += third(0, 0, 0);
    xxy_ += third(0, 0, 1);
    xyy_ += third(0, 1, 1);
    yyy_ += third(1, 1, 1);
  }
  for (double* m : {&xx_, &xy_, &yy_, &xxx_, &xxy_, &xyy_, &yyy_}) *m /= area_;
}

bool ContactArea::close() {
  if (edges_.size() > 4) cancelInner();
  if (edges_.size() < 3) return false;
  const Vec2 origin = edges_.front().from;
  Vec2 sum = Vec2::Zero();
  double twice = 0, extent = 0;
  for (const Edge& e : edges_) {
    const Vec2 a = e.from - origin, b = e.to - origin;
    const double c = planarCross(a, b);
    twice += c;
    sum += c * (a + b) / 3;
    extent = std::max(extent, b.squaredNorm());
  }
  if (!(twice > kThin * extent)) return false;
  size_ = 0.5 * twice;
  middle_ = origin + sum / twice;
  double distance = 0;
  for (const Edge& e : edges_) {
    const double length = (e.to - e.from).norm();
    const Vec2 along = (e.to - e.from) / length, out(along.y(), -along.x());
    const EdgeIntegrals s = seenFrom(middle_, e.from, along, out, length);
    distance += s.away * s.distance / 3;
    sides_.push_back({e.from - middle_, along, out, length});
  }
  radius_ = distance / size_;
  if (!(radius_ > 0)) return false;
  for (Side& s : sides_) {
    s.from /= radius_;
    s.length /= radius_;
  }
  measure();
  return true;
}

/// Where the slip is nearly the same everywhere the integrals are small differences of great numbers: their
/// series about an even slip.
ContactArea::Resistance ContactArea::nearlyStraight(const Vec3& slip) const {
  const double speed = slip.tail<2>().norm(), e = slip[0] / speed;
  const Vec2 t = slip.tail<2>() / speed, n(-t.y(), t.x());
  const double tt = xx_ * t.x() * t.x() + 2 * xy_ * t.x() * t.y() + yy_ * t.y() * t.y();
  const double tn = xx_ * t.x() * n.x() + xy_ * (t.x() * n.y() + t.y() * n.x()) + yy_ * t.y() * n.y();
  const double ttn =
      xxx_ * t.x() * t.x() * n.x() + xxy_ * (t.x() * t.x() * n.y() + 2 * t.x() * t.y() * n.x()) +
      xyy_ * (t.y() * t.y() * n.x() + 2 * t.x() * t.y() * n.y()) + yyy_ * t.y() * t.y() * n.y();
  Resistance r;
  r.force.tail<2>() = (1 - 0.5 * e * e * tt) * t + e * e * tn * n;
  r.force[0] = e * tt + 1.5 * e * e * ttn;
  r.loss = r.force.dot(slip);
  const Vec2 mixed = e * (2 * tn * n - tt * t) / speed;
  r.slope(0, 0) = tt / speed;
  r.slope(0, 1) = r.slope(1, 0) = mixed.x();
  r.slope(0, 2) = r.slope(2, 0) = mixed.y();
  r.slope.bottomRightCorner<2, 2>() = n * n.transpose() / speed;
  return r;
}

ContactArea::Resistance ContactArea::against(const Vec3& slip) const {
  const double spin = slip[0];
  const Vec2 slide = slip.tail<2>();
  if (!(spin * spin > kStraight * kStraight * slide.squaredNorm())) return nearlyStraight(slip);
  const Vec2 about = Vec2(-slide.y(), slide.x()) / spin;
  double mean = 0;
  Vec2 away = Vec2::Zero();
  Eigen::Matrix2d turn = Eigen::Matrix2d::Zero();
  for (const Side& s : sides_) {
    const EdgeIntegrals seen = seenFrom(about, s.from, s.along, s.out, s.length);
    mean += seen.away * seen.distance / 3;
    away += seen.distance * s.out;
    turn += ((seen.far - seen.near) * s.along + seen.away * seen.inverse * s.out) * s.out.transpose();
  }
  mean /= area_;
  away /= area_;
  turn /= area_;
  const double sign = spin > 0 ? 1 : -1, size = std::fabs(spin);
  Resistance r;
  r.force << sign * (mean + about.dot(away)), -sign * away.y(), sign * away.x();
  r.loss = size * mean;
  Eigen::Matrix2d slope;
  slope << turn(1, 1), -0.5 * (turn(1, 0) + turn(0, 1)), -0.5 * (turn(1, 0) + turn(0, 1)), turn(0, 0);
  slope /= size;
  const Vec2 mixed = -slope * slide / spin;
  r.slope.bottomRightCorner<2, 2>() = slope;
  r.slope(0, 1) = r.slope(1, 0) = mixed.x();
  r.slope(0, 2) = r.slope(2, 0) = mixed.y();
  r.slope(0, 0) = -mixed.dot(slide) / spin;
  return r;
}

/// The greatest of force . slip / loss; Newton's method on the sphere of slips.
ContactArea::Need ContactArea::needFor(const Vec3& force) const {
  const double size = force.norm();
  if (!(size > 0)) return {};
  Vec3 slip = force / size;
  Resistance r = against(slip);
  double share = force.dot(slip) / r.loss;
  for (int i = 0; i < kSearch; ++i) {
    const Vec3 off = force / share - r.force;
    if (off.norm() < kAgrees) break;
    const Vec3 newton = (r.slope + slip * slip.transpose()).ldlt().solve(off);
    bool better = false;
    for (Vec3 step : {newton, off}) {
      if (!step.allFinite()) continue;
      for (int k = 0; k < 6 && !better; ++k, step *= 0.25) {
        const Vec3 next = (slip + step).normalized();
        const Resistance there = against(next);
        if (const double now = force.dot(next) / there.loss; now > share) {
          slip = next;
          r = there;
          share = now;
          better = true;
        }
      }
      if (better) break;
    }
    if (!better) break;
  }
  return {share, slip};
}

/// How much of the line from p along n is in the area.
double ContactArea::chord(const Vec2& p, const Vec2& n) const {
  const Vec2 t(n.y(), -n.x());
  double length = 0;
  for (const Side& s : sides_) {
    const Vec2 from = s.from - p, to = from + s.length * s.along;
    const double a = t.dot(from), b = t.dot(to);
    if ((a < 0) == (b < 0)) continue;
    const double at = n.dot(from) + (n.dot(to) - n.dot(from)) * (a / (a - b));
    length += a < 0 ? at : -at;
  }
  return std::fabs(length);
}

/// On an elastic bed pressure goes evenly from side to side; where it would pull, the faces part. So the area
/// is narrower along the way to the load's centre, and across it as narrow as it is there.
double ContactArea::widthUnder(const Vec2& off) const {
  const double size = off.norm();
  if (!(size > 1e-9)) return 1;
  const Vec2 t = off / size, n(-t.y(), t.x());
  double reach = 0;
  for (const Side& s : sides_) reach = std::max(reach, t.dot(s.from));
  const double share = size / std::max(reach, 1e-300);
  constexpr double kMiddleThird = 1.0 / 3;
  const double along =
      share < kMiddleThird ? std::sqrt(1 - 3 * share * share) : std::max(0.0, 1 - share) * 1.2247448713915890;
  const double across = std::min(1.0, chord(off, n) / std::max(chord(Vec2::Zero(), n), 1e-300));
  const double tt = xx_ * t.x() * t.x() + 2 * xy_ * t.x() * t.y() + yy_ * t.y() * t.y(), nn = xx_ + yy_ - tt;
  return std::sqrt((along * along * tt + across * across * nn) / (xx_ + yy_));
}

}  // namespace stadion
