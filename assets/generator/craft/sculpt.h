#pragma once
/// Smooth bodies out of lumps that melt into each other, as a sculptor puts clay on clay.
///
/// Units    metres. Negative distances are inside.

#include "assets/generator/craft/part.h"

namespace stadion::assets {

class Clay {
public:
  /// A ball whose axes are along X, Y and Z. What is put on melts into what is there over `melt` metres.
  Clay& ball(Point middle, Point radii, double melt = 0.02);
  /// The same on both sides of x = 0.
  Clay& balls(Point middle, Point radii, double melt = 0.02);
  /// A rod with round ends that may differ.
  Clay& rod(Point a, Point b, double ra, double rb, double melt = 0.02);
  Clay& rods(Point a, Point b, double ra, double rb, double melt = 0.02);
  /// Takes away a ball.
  Clay& hollow(Point middle, Point radii, double melt = 0.01);
  /// Moves the surface out by so much, where positive.
  Clay& relief(std::function<double(Point)> out);

  /// About how far a point is from the surface.
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
