#pragma once
/// Turns a draw list into what one instanced draw call each can draw.
///
/// Ownership  keeps its memory from frame to frame, so that a steady show allocates nothing.
/// Threads    plain data, no GL.

#include "pipeline/draw_list/draw_list.h"

#include <array>
#include <span>
#include <vector>

namespace stadion {

/// Instances of one mesh, level, figure and paint, next to each other in the instance array.
struct InstanceBatch {
  MeshId mesh = kNoMesh;
  std::uint32_t level = 0;
  std::uint32_t figure = 0;  ///< of all of them (DrawItem::figure)
  std::uint32_t paint = 0;   ///< likewise (DrawItem::paint)
  std::uint32_t first = 0, count = 0;
  bool mirrored = false;  ///< the model matrices turn left into right: front faces run clockwise
  /// By view: all that it sees lies within these instances of the batch.
  std::array<std::uint32_t, DrawList::kMostViews> begins{}, ends{};

  /// Returns the instances of the batch that a view may see.
  InstanceBatch seenBy(std::uint32_t view) const {
    InstanceBatch seen = *this;
    seen.first += begins[view];
    seen.count = ends[view] - begins[view];
    return seen;
  }
  void add(std::uint32_t views);
};

using InstanceMatrix = std::array<float, 12>;  ///< (3 x 4), row major, as in DrawItem

class InstanceBatches {
public:
  /// Removes all batches.
  void begin(bool withOwners = false);
  /// Takes up opaque items of a list: those before `end`, by DrawList::kPortion (but for the last ones, if
  /// `end` is the list's), that have not been. Expects those of one mesh and level next to each other, sorted
  /// by view as in a list. Items whose matrix is not finite are left out and counted.
  void addOpaque(std::span<const DrawItem> list, std::size_t end);
  /// Takes up the transparent items, after all opaque ones.
  void addTransparent(std::span<const DrawItem> items);
  void build(std::span<const DrawItem> opaque, std::span<const DrawItem> transparent) {
    begin();
    addOpaque(opaque, opaque.size());
    addTransparent(transparent);
  }
  /// So many opaque items were taken up.
  std::size_t taken() const { return taken_; }

  std::span<const InstanceMatrix> matrices() const { return matrices_; }
  /// From the viewer [m].
  std::span<const float> distances() const { return distances_; }
  /// Whose they are, and how many pixels each may cover; empty unless they were asked for.
  std::span<const NodeRef> owners() const { return owners_; }
  std::span<const float> pixels() const { return pixels_; }
  std::span<const InstanceBatch> opaque() const { return opaque_; }
  /// In the list's order; neighbours of the same mesh share a batch.
  std::span<const InstanceBatch> transparent() const { return transparent_; }
  std::size_t refused() const { return refused_; }

private:
  void addPortion(std::span<const DrawItem> items);
  void addRun(std::span<const DrawItem> run, bool mirrored);
  void add(const DrawItem& item);

  bool withOwners_ = false;
  std::vector<InstanceMatrix> matrices_;
  std::vector<float> distances_;
  std::vector<NodeRef> owners_;
  std::vector<float> pixels_;
  std::vector<InstanceBatch> opaque_, transparent_;
  std::size_t taken_ = 0, refused_ = 0;
};

}  // namespace stadion
