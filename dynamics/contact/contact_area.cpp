#include "dynamics/contact/contact_area.h"

#include "dynamics/contact/contact_solver.h"
#include "dynamics/shapes/convex_core.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr double kAligned = 0.9999;          ///< cosine between a face and the plane that it lies in
constexpr std::size_t kMostPieces = 1024;    ///< convex parts of a face
constexpr std::size_t kMostPairs = 1 << 14;  ///< and pairs of them
/// The sixteen corners around a disc, so much nearer to its middle, have its mean radius.
constexpr double kRimWider = 0.99348693742900583;
constexpr double kThinnest = 1e-3;   ///< three points of a flatter triangle lie on a line
constexpr double kFlatGap = 1e-5;    ///< points farther apart are not in contact [m]
constexpr double kDeepArea = 1e-3;   ///< those that overlap by more are pushed out: no face carries them [m]
constexpr double kOneSide = 0.9999;  ///< cosine of normals that are one face's

using Ring = std::vector<Vec2>;

/// The face of one side as convex parts, counter-clockwise.
struct FacePieces {
  bool endless = false;
  std::vector<Ring> rings;
};

struct Frame2 {
  const ContactPlane& plane;
  Vec3 towards;  ///< outward normal of the faces sought
  Aabb box;      ///< where they may be, in World
};

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

void putAround(Ring& ring) {
  double twice = 0;
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) twice += cross(ring[i] - ring[0], ring[i + 1] - ring[0]);
  if (twice < 0) std::ranges::reverse(ring);
}

template <class At>
void addRing(FacePieces& pieces, std::size_t count, At at) {
  Ring ring;
  for (std::size_t i = 0; i < count; ++i) ring.push_back(at(i));
  putAround(ring);
  pieces.rings.push_back(std::move(ring));
}

/// Triangles of a mesh that lie in the plane.
void meshPieces(const MeshShape& mesh, const Pose& X, const Frame2& f, FacePieces& pieces) {
  const Mat3 R = X.q.toRotationMatrix();
  Aabb local;
  for (int i = 0; i < 8; ++i)
    local.include(X.inverse() * Vec3(i & 1 ? f.box.hi.x() : f.box.lo.x(), i & 2 ? f.box.hi.y() : f.box.lo.y(),
                                     i & 4 ? f.box.hi.z() : f.box.lo.z()));
  const Vec3 n = R.transpose() * f.towards, at = X.inverse() * f.plane.origin;
  mesh.tree.eachOverlapping(local, [&](std::uint32_t i) {
    const Triangle& t = mesh.tree.triangles()[i];
    const double facing = t.normal.dot(n);
    if ((mesh.tree.closed() ? facing : std::fabs(facing)) < kAligned) return;
    if (std::fabs(t.normal.dot(t.v[0] - at)) > f.plane.thick || pieces.rings.size() > kMostPieces) return;
    addRing(pieces, 3, [&](std::size_t k) { return f.plane.on(X * t.v[k]); });
  });
}

void corePieces(const Shape& shape, const Pose& X, const Frame2& f, FacePieces& pieces) {
  ConvexCore c;
  if (!coreOf(shape, X, c) || c.radius > 0) return;
  const Feature face = featureTowards(c, f.towards, true);
  if (face.count < 3 || face.normal.dot(f.towards) < kAligned) return;
  if (c.kind == ConvexCore::Kind::Hull) {  // the feature itself may be thinned out
    for (const ConvexShape::Face& h : c.hull->faces)
      if ((c.R * h.normal).dot(f.towards) > kAligned &&
          std::fabs(h.offset - h.normal.dot(c.R.transpose() * (f.plane.origin - c.p))) < f.plane.thick)
        addRing(pieces, h.count, [&](std::size_t i) {
          return f.plane.on(c.p + c.R * c.hull->points[c.hull->loops[h.first + i]]);
        });
  } else if (c.kind == ConvexCore::Kind::Cylinder) {
    const Vec3 middle = c.p + face.normal * c.half.z();
    addRing(pieces, static_cast<std::size_t>(face.count),
            [&](std::size_t i) { return f.plane.on(middle + kRimWider * (face.points[i] - middle)); });
  } else {
    addRing(pieces, static_cast<std::size_t>(face.count),
            [&](std::size_t i) { return f.plane.on(face.points[i]); });
  }
}

void addPieces(const Side& s, double tau, const Frame2& f, FacePieces& pieces) {
  const Pose X = s.at(tau).pose;
  if (const auto* plane = std::get_if<PlaneShape>(s.shape); plane && !plane->bounded())
    pieces.endless = pieces.endless || (X.q * plane->normal()).dot(f.towards) > kAligned;
  else if (const auto* mesh = std::get_if<MeshShape>(s.shape))
    meshPieces(*mesh, X, f, pieces);
  else
    corePieces(*s.shape, X, f, pieces);
}

/// What of a convex ring is left of the line from p to q.
void clip(Ring& ring, const Vec2& p, const Vec2& q, Ring& scratch) {
  scratch.clear();
  const Vec2 d = q - p;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
    const double ha = cross(d, a - p), hb = cross(d, b - p);
    if (ha >= 0) scratch.push_back(a);
    if ((ha > 0 && hb < 0) || (ha < 0 && hb > 0)) scratch.push_back(a + (b - a) * (ha / (ha - hb)));
  }
  ring.swap(scratch);
}

Eigen::AlignedBox2d boxOf(const Ring& ring) {
  Eigen::AlignedBox2d box;
  for (const Vec2& x : ring) box.extend(x);
  return box;
}

/// The common part of two faces.
bool addCommon(const FacePieces& a, const FacePieces& b, ContactArea& area) {
  std::vector<Eigen::AlignedBox2d> boxes;
  for (const Ring& r : b.rings) boxes.push_back(boxOf(r));
  if (a.rings.size() * b.rings.size() > kMostPairs) return false;
  Ring ring, scratch;
  for (const Ring& r : a.rings) {
    const Eigen::AlignedBox2d box = boxOf(r);
    for (std::size_t i = 0; i < b.rings.size(); ++i) {
      if (!box.intersects(boxes[i])) continue;
      ring = r;
      const Ring& by = b.rings[i];
      for (std::size_t k = 0; k < by.size() && ring.size() > 2; ++k)
        clip(ring, by[k], by[(k + 1) % by.size()], scratch);
      if (ring.size() > 2) area.addPolygon(ring.data(), ring.size());
    }
  }
  return true;
}

/// Whether side a is the smaller one; several pieces together count as large.
bool isSmaller(const Side& a, std::span<const Side> b) {
  return b.size() > 1 || a.bound().radius <= b[0].bound().radius;
}

std::shared_ptr<const ContactArea> areaIn(const Side& a, std::span<const Side> b, double tau,
                                          const ContactPlane& plane) {
  // Meshes are looked through no farther than the smaller side reaches.
  const auto reachOf = [](const Side& s) { return s.bound().radius; };
  const Side& small = isSmaller(a, b) ? a : b[0];
  Frame2 f{plane, -plane.n, {}};
  if (!(reachOf(small) < 1e299)) return {};
  const Vec3 centre = small.at(tau).pose * small.bound().centre;
  for (int i = 0; i < 3; ++i) {
    // Of the ball around it a disc: what is near the plane.
    const double across = std::sqrt(std::max(0.0, 1 - plane.n[i] * plane.n[i]));
    const double middle = centre[i] - plane.n[i] * plane.n.dot(centre - plane.origin);
    f.box.lo[i] = middle - across * reachOf(small) - plane.thick;
    f.box.hi[i] = middle + across * reachOf(small) + plane.thick;
  }
  FacePieces fa, fb;
  addPieces(a, tau, f, fa);
  if (!fa.endless && fa.rings.empty()) return {};
  f.towards = plane.n;
  for (const Side& piece : b) addPieces(piece, tau, f, fb);
  const std::size_t pieces = std::max(fa.rings.size(), fb.rings.size());
  if ((fa.endless && fb.endless) || (!fb.endless && fb.rings.empty()) || pieces > kMostPieces) return {};
  auto area = std::make_shared<ContactArea>();
  if (fa.endless || fb.endless) {
    for (const Ring& r : fa.endless ? fb.rings : fa.rings) area->addPolygon(r.data(), r.size());
  } else if (!addCommon(fa, fb, *area)) {
    return {};
  }
  return area->close() ? area : nullptr;
}

/// Whether some three of the points are the corners of a triangle.
bool spreadOut(const std::vector<Vec3>& points) {
  if (points.size() < 3) return false;
  Vec3 far = Vec3::Zero();
  for (const Vec3& p : points)
    if ((p - points[0]).squaredNorm() > far.squaredNorm()) far = p - points[0];
  return std::ranges::any_of(
      points, [&](const Vec3& p) { return far.cross(p - points[0]).norm() > kThinnest * far.squaredNorm(); });
}

}  // namespace

std::vector<FlatContact> flatContacts(const Side& a, std::span<const Side> b, double tau,
                                      std::span<const Gap> points) {
  std::vector<FlatContact> flats;
  std::vector<char> used(points.size(), 0);
  std::vector<Vec3> at;
  for (std::size_t i = 0; i + 2 < points.size(); ++i) {
    if (used[i] != 0 || points[i].distance > kFlatGap || points[i].distance < -kDeepArea) continue;
    FlatContact flat;
    at.clear();
    double deepest = 0;
    ContactPlane& plane = flat.plane;
    for (std::size_t k = i; k < points.size(); ++k) {
      const Gap& g = points[k];
      if (used[k] != 0 || g.distance > kFlatGap || g.normal.dot(points[i].normal) < kOneSide) continue;
      used[k] = 1;
      flat.points.push_back(static_cast<std::uint32_t>(k));
      at.push_back(g.point);
      deepest = std::max(deepest, std::fabs(g.distance));
    }
    if (!spreadOut(at)) continue;
    for (const Vec3& x : at) plane.origin += x / static_cast<double>(at.size());
    const Mat3 basis = basisAround(points[i].normal);
    plane.n = basis.col(0);
    plane.t1 = basis.col(1);
    plane.t2 = basis.col(2);
    plane.thick = 2 * kFlatGap + 1.5 * deepest;
    flat.area = areaIn(a, b, tau, plane);
    if (!flat.area) continue;
    plane.origin = plane.at(flat.area->middle());
    flat.carrier = isSmaller(a, b) ? Carrier::A : Carrier::B;
    flats.push_back(std::move(flat));
  }
  return flats;
}

}  // namespace stadion
