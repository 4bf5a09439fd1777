#pragma once
/// A flat picture of convex pieces that tile the plane: painting a shape cuts the pieces under it.

#include "assets/generator/craft/models.h"

namespace stadion::assets {

/// A point in steps of 1/4096 m: whole numbers compare exactly and fit a float.
struct Spot {
  std::int64_t x, y;
  bool operator==(const Spot&) const = default;
  auto operator<=>(const Spot&) const = default;
};

Spot spot(double x, double y);

using Piece = std::vector<Spot>;  ///< convex, counter-clockwise

class Mosaic {
public:
  /// A first piece; pieces laid must not overlap, and share whole edges.
  void lay(Piece piece, std::uint32_t paint) { tiles_.push_back({std::move(piece), paint}); }
  /// Gives everything inside the convex `shape` another paint.
  void paint(const Piece& shape, std::uint32_t paint);
  /// Appends triangles at z = 0 to the model, without overlaps; their corners meet only corners.
  void triangulateInto(Model& model) const;

private:
  void insert(Spot from, Spot to, Spot at);

  struct Tile {
    Piece outline;
    std::uint32_t paint;
  };
  std::vector<Tile> tiles_;
};

}  // namespace stadion::assets
