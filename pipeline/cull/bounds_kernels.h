#pragma once
/// The tests of a tree's bounds against volumes, eight bounds at a time. Internal to pipeline/cull/.
///
/// A bound is outside a plane, inside, or so near to it that single precision cannot say. What is outside any
/// plane of a volume is surely outside the volume, what is inside all surely in it or touches it; the rest is
/// unsure and for others to decide in double precision.
///
/// Includes  nothing: the file that is compiled for AVX2 uses this, too, and must share no function.

namespace stadion {

/// The planes of a volume, in a tree's coordinates: inside is normal . p + offset >= 0.
struct VolumePlanes {
  float normal[8][3];
  float offset[8];
  float rounding[8];  ///< rounding error of `offset` [m]
  unsigned count;
};

/// Single precision is off by at most this part of the numbers that went into a test: 2^-24 of each for the
/// bound, for the plane, and for each step of their sum, twice over.
constexpr float kRounding = 1.5e-6f;

/// Eight neighbours in a tree, and what is known of the box around them: bit by bit, the volumes that it may
/// touch, and those that it is wholly inside of.
struct TreeGroup {
  unsigned group;
  unsigned touches, inside;
};

/// A sphere, the volumes that it surely touches, and those of which it is unsure.
struct TreeSphere {
  unsigned place;
  unsigned seen, unsure;
};

struct BoundsKernels {
  /// Tests boxes. Writes to `out` the boxes that any volume may touch, as groups of the level below, and
  /// returns their number. `out` has room for eight times `groups`. `nodes`: number of nodes of the level.
  /// `tested[v]` counts bounds.
  unsigned (*boxes)(const float* boxes, unsigned nodes, const VolumePlanes* volumes, const TreeGroup* in,
                    unsigned groups, TreeGroup* out, unsigned long long* tested);
  /// Tests spheres in the same way.
  unsigned (*spheres)(const float* spheres, unsigned nodes, const VolumePlanes* volumes, const TreeGroup* in,
                      unsigned groups, TreeSphere* out, unsigned long long* tested);
};

/// Four floats at a time, on every machine.
extern const BoundsKernels kFourBounds;
/// Eight, where there is AVX2. Both do the same to the bit.
extern const BoundsKernels kEightBounds;

}  // namespace stadion
