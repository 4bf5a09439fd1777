#pragma once
/// Smooth bodies of lumps that blend into each other, like a sculptor's clay.
///
/// Units    metres. Negative distances are inside.

#include "assets/generator/craft/part.h"

namespace stadion::assets {

class Clay {
public:
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

private:
  enum class Kind { Ball, Rod, Hollow };
  struct Lump {
    Kind kind;
    Point a, b;
    double ra, rb, melt;
  };
  void grow(Point middle, double reach);

  std::vector<Lump> lumps_;
  std::function<double(Point)> relief_;
  Point low_{1e9, 1e9, 1e9}, high_{-1e9, -1e9, -1e9};
};

/// The mirror image on the other side of x = 0.
Part mirrored(Part part);

}  // namespace stadion::assets
