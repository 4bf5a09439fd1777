#pragma once
/// The convex hull of a cloud of points, with its faces merged to polygons.
///
/// Method   quickhull over triangles: each point outside is taken to be a corner of the hull, farthest first;
///          faces in one plane are merged afterwards.
///          Barber, Dobkin, Huhdanpaa, The Quickhull Algorithm for Convex Hulls, 1996.

#include "engine/maths/maths.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace stadion {

/// A convex body with flat faces. Points in the node's coordinates N; immutable.
struct ConvexShape {
  struct Face {
    Vec3 normal;    ///< unit, outwards
    double offset;  ///< normal . x of its points [m]
    std::uint32_t
        first;  ///< corners: loops[first] .. loops[first + count - 1], counter-clockwise from outside
    std::uint32_t count;
  };
  std::vector<Vec3> points;
  std::vector<Face> faces;
  std::vector<std::uint32_t> loops;
  std::vector<std::array<std::uint32_t, 2>> edges;  ///< edges of the faces; each one is here once
  Vec3 centre = Vec3::Zero();                       ///< middle of the bounds of the corners
  double reach = 0;                                 ///< greatest distance of a corner from the centre [m]
  double inside = 0;                                ///< radius of a ball about the centre that fits [m]

  /// A corner that lies farthest along d; of many corners, found by going uphill from one to the next.
  std::uint32_t farthest(const Vec3& d) const;
  /// Visits the faces whose outward normals are near d: those around that corner, or all of few.
  template <class Visit>
  void eachFaceTowards(const Vec3& d, Visit visit) const {
    if (few()) {
      for (std::uint32_t i = 0; i < faces.size(); ++i) visit(i);
      return;
    }
    const std::uint32_t corner = farthest(d);
    for (std::uint32_t i = firstFace[corner]; i < firstFace[corner + 1]; ++i) visit(facesAround[i]);
  }
  bool few() const { return points.size() <= 24; }  ///< looking through all is faster than walking

  /// The corners next to corner i: neighbours[firstNeighbour[i]] and on, before firstNeighbour[i + 1].
  std::vector<std::uint32_t> neighbours, firstNeighbour;
  std::vector<std::uint32_t> facesAround, firstFace;  ///< the faces that meet in a corner, in the same way
  std::array<std::uint32_t, 8> outermost{};  ///< along (-1, -1, -1), (1, -1, -1), (-1, 1, -1) and so on
};

/// Nothing if the points are not finite or lie in one plane.
std::optional<ConvexShape> convexHull(const std::vector<Vec3>& points);

}  // namespace stadion
