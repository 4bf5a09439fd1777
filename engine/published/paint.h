#pragma once
/// The paint of a model: how a node colours it beside what its file says.
///
/// Colours  Paint has them as scripts write them (sRGB, 0 to 1), PaintRecord in linear light.
/// Errors   isValid() is false if a restored paint has numbers out of range.

#include "engine/maths/maths.h"

#include <cstddef>
#include <type_traits>

namespace stadion {

/// The state of a node: what its attributes and the commands tint, emit and opacity say.
struct Paint {
  Vec3 tint = Vec3::Ones();  ///< multiplies the base colour
  Vec3 emit = Vec3::Zero();  ///< added to the emission
  double opacity = 1;        ///< multiplies alpha; 0: the model is not drawn

  bool operator==(const Paint& o) const { return tint == o.tint && emit == o.emit && opacity == o.opacity; }
  /// Returns true if it leaves the materials as the file has them.
  bool isNeutral() const { return *this == Paint(); }
  bool isValid() const;

  template <class Self, class Fields>
  static void fields(Self& p, Fields& f) {
    f("tint", p.tint), f("emit", p.emit), f("opacity", p.opacity);
  }
};

/// A paint as App publishes it. Plain, of fixed width, without padding.
struct PaintRecord {
  float tint[3] = {1, 1, 1};
  float opacity = 1;
  float emit[3] = {0, 0, 0};

  /// Returns true if what lies behind the model is seen through it.
  bool isSeeThrough() const { return opacity < kOpaque; }
  bool operator==(const PaintRecord&) const = default;

  /// From here on a surface is opaque, as for the alpha of a material.
  static constexpr float kOpaque = 0.999f;
};
static_assert(std::is_trivially_copyable_v<PaintRecord> && sizeof(PaintRecord) == 28);

/// Expects a valid paint.
PaintRecord recordOf(const Paint& paint);

/// The most different paints of a show at a time. Also the mask of a paint's number in InstanceRecord::flags,
/// so it must be 2^n - 1.
constexpr std::size_t kMostPaints = 2047;
static_assert((kMostPaints & (kMostPaints + 1)) == 0);

}  // namespace stadion
