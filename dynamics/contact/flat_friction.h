#pragma once
/// Friction of a flat contact whose pressure is even over its area: force and spin moment together.
///
/// Formula  a flat contact that slides with u and spins with w moves about one point P of its plane. Its
///          force is mu N times the mean of the directions of slip, its moment mu N times the mean distance
///          from P; both are integrals over the area and become sums over its edges (Stokes). All forces and
///          moments that it can resist form a convex body, its limit surface; what it resists is the point of
///          that surface whose normal is the slip.
/// Sources  Goyal, Ruina, Papadopoulos, Planar sliding with dry friction, Wear 143 (1991); Farkas, Bartels,
///          Unger, Wolf, Frictional coupling between sliding and spinning motion, Phys. Rev. Lett. 90 (2003)
///          248302.

#include "engine/maths/maths.h"

#include <array>
#include <vector>

namespace stadion {

/// Where two flat faces touch: an area of any shape, with holes, in several parts.
class ContactArea {
public:
  /// Adds the part to the left of a closed chain of edges; a chain may be given in any order.
  void addEdge(const Vec2& from, const Vec2& to) { edges_.push_back({from, to}); }
  void addPolygon(const Vec2* corners, std::size_t count);
  /// Makes the area ready to resist. False if it is none, or hardly any.
  bool close();

  /// Centroid of the area, in the coordinates of the edges [m].
  const Vec2& middle() const { return middle_; }
  double radius() const { return radius_; }  ///< mean distance of its points from there [m]
  double size() const { return size_; }      ///< [m2]

  /// Slip and friction as three numbers: spin (times the radius, as a speed), and two along the plane.
  /// Per unit of mu N; `slope` is its change with the slip; `loss` the power that it takes.
  struct Resistance {
    Vec3 force = Vec3::Zero();
    Mat3 slope = Mat3::Zero();
    double loss = 0;
  };
  /// Friction against this slip about the middle. Zero slip is not allowed.
  Resistance against(const Vec3& slip) const;

  /// How much of its strength is needed to resist `force`, and for more than 1 the slip that would follow.
  struct Need {
    double share = 0;
    Vec3 slip = Vec3::Zero();
  };
  Need needFor(const Vec3& force) const;

  /// Load whose centre is `off` from the middle (in units of the radius) presses on less of the area: how
  /// wide that is, relative to all of it.
  double widthUnder(const Vec2& off) const;

private:
  struct Edge {
    Vec2 from, to;
  };
  struct Side {  ///< a side of the area, in units of the radius from the middle
    Vec2 from, along, out;
    double length;
  };
  void cancelInner();
  void measure();
  double chord(const Vec2& p, const Vec2& n) const;
  Resistance nearlyStraight(const Vec3& slip) const;
  std::vector<Edge> edges_;
  std::vector<Side> sides_;
  Vec2 middle_ = Vec2::Zero();
  double radius_ = 0, size_ = 0;
  double area_ = 0;                               ///< in units of the radius
  double xx_ = 0, xy_ = 0, yy_ = 0;               ///< second moments ...
  double xxx_ = 0, xxy_ = 0, xyy_ = 0, yyy_ = 0;  ///< ... and third ones, likewise
};

}  // namespace stadion
