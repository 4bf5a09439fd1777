#pragma once
/// Smooth bodies of lumps that blend into each other, like a sculptor's clay.
///
/// Units    metres. Negative distances are inside.

#include "assets/generator/craft/part.h"

#include "engine/maths/maths.h"

#include <vector>

namespace stadion::assets {

class Clay {
public:
  /// The next lumps are given in the frame of this bone, which is at X.
  Clay& on(int bone, const Pose& X);
  /// Adds a ball with axes along X, Y and Z. It blends into the existing clay over `melt` metres.
  Clay& ball(Point middle, Point radii, double melt = 0.02);
  /// Adds the same on both sides of x = 0.
  Clay& balls(Point middle, Point radii, double melt = 0.02);
  /// Adds a rod with round ends, which may have different radii.
  Clay& rod(Point a, Point b, double ra, double rb, double melt = 0.02);
  Clay& rods(Point a, Point b, double ra, double rb, double melt = 0.02);
  /// Takes away a ball.
  Clay& hollow(Point middle, Point radii, double melt = 0.01);
  /// Moves the surface outwards by this amount, where it is positive.
  Clay& relief(std::function<double(Point)> out);

  /// Returns the approximate distance of a point from the surface.
  double distance(Point p) const;
  /// Away from the surface, unit.
  Point outward(Point p) const;

  /// The surface, in cells of `step` metres, coloured by `colour(place, outward)`; its normals are the
  /// clay's.
  Part cast(double step, const std::function<Rgb(Point, Point)>& colour) const;
  /// Likewise, within a box alone: the surface ends about there.
  Part cast(double step, Point low, Point high, const std::function<Rgb(Point, Point)>& colour) const;

  /// From 0 in a narrow fold to 1 where the surface is open, looking `reach` metres around.
  double open(Point p, Point outward, double reach) const;

  /// How much each bone's lumps count at a place: 1 for the nearest, e times less every `over` metres.
  std::vector<double> pulls(Point p, std::size_t bones, double over) const;

private:
  enum class Kind { Ball, Rod, Hollow };
  struct Lump {
    Kind kind;
    Point a, b;
    double ra, rb, melt;
    Point middle;  ///< of the sphere around it, in the clay's frame
    double reach;
    int bone;
    bool turned;
    std::array<Point, 3> axes;  ///< of the bone
    Point origin;
  };
  void put(Kind kind, Point a, Point b, double ra, double rb, double melt);
  static double distance(const Lump& lump, Point p);

  std::vector<Lump> lumps_;
  int bone_ = 0;
  bool turned_ = false;
  std::array<Point, 3> axes_{Point{1, 0, 0}, Point{0, 1, 0}, Point{0, 0, 1}};
  Point origin_{0, 0, 0};
  std::function<double(Point)> relief_;
  Point low_{1e9, 1e9, 1e9}, high_{-1e9, -1e9, -1e9};
};

/// The mirror image on the other side of x = 0.
Part mirrored(Part part);

}  // namespace stadion::assets
