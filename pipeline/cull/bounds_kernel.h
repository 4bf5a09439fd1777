#pragma once
/// The tests of bounds_kernels.h, as many at a time as F has lanes. Internal to pipeline/cull/.
///
/// Bits     by element, in the same order, nothing fused: all forms give the same.
/// Linkage  internal; includes nothing but bounds_kernels.h.

#include "pipeline/cull/bounds_kernels.h"

namespace stadion {
namespace {

typedef float FourFloats __attribute__((vector_size(16)));
typedef float EightFloats __attribute__((vector_size(32)));

constexpr unsigned kLanesOfAGroup = 8;

template <class F>
[[gnu::always_inline]] inline F load(const float* from) {
  F f;
  __builtin_memcpy(&f, from, sizeof f);
  return f;
}
template <class F>
[[gnu::always_inline]] inline F all(float x) {
  return F{} + x;
}
template <class F>
[[gnu::always_inline]] inline F size(const F& x) {
  return x < 0.0f ? -x : x;
}
template <class F>
[[gnu::always_inline]] inline F larger(const F& a, const F& b) {
  return a > b ? a : b;
}

/// A bit for each lane in which a < b.
[[gnu::always_inline]] inline unsigned less(const FourFloats& a, const FourFloats& b) {
  return static_cast<unsigned>(__builtin_ia32_movmskps(FourFloats(a < b)));
}
#ifdef __AVX2__
[[gnu::always_inline]] inline unsigned less(const EightFloats& a, const EightFloats& b) {
  return static_cast<unsigned>(__builtin_ia32_movmskps256(EightFloats(a < b)));
}
#endif

/// On which side of a volume the lanes are: outside a plane, inside of all.
struct Sides {
  unsigned outside, inside;
};

template <class F>
[[gnu::always_inline]] inline F along(const VolumePlanes& v, unsigned plane, const F& x, const F& y,
                                      const F& z) {
  return v.normal[plane][0] * x + (v.normal[plane][1] * y + (v.normal[plane][2] * z + v.offset[plane]));
}

/// As many spheres of a group as F has lanes, from lane `first`.
template <class F>
struct Spheres {
  F x, y, z, radius, rounding;

  [[gnu::always_inline]] inline Spheres(const float* group, unsigned first)
      : x(load<F>(group + first)), y(load<F>(group + 8 + first)), z(load<F>(group + 16 + first)),
        radius(load<F>(group + 24 + first)),
        rounding(kRounding * (size(x) + size(y) + (size(z) + size(radius)))) {}

  /// Bits of those that are there.
  [[gnu::always_inline]] inline unsigned present() const { return less(all<F>(-1), radius); }

  [[gnu::always_inline]] inline Sides sidesOf(const VolumePlanes& v) const {
    Sides s{0, ~0u};
    for (unsigned plane = 0; plane < v.count; ++plane) {
      const F reach = along(v, plane, x, y, z) + radius, limit = rounding + v.rounding[plane];
      s.outside |= less(reach, -limit);
      s.inside &= less(limit, reach);
    }
    return s;
  }
};

template <class F>
struct Boxes {
  const float* group;
  unsigned first;
  F rounding;

  [[gnu::always_inline]] inline Boxes(const float* from, unsigned lane) : group(from), first(lane) {
    const auto most = [this](unsigned k) __attribute__((always_inline)) {
      return larger(size(load<F>(group + 8 * k + first)), size(load<F>(group + 24 + 8 * k + first)));
    };
    rounding = kRounding * (most(0) + (most(1) + most(2)));
  }

  [[gnu::always_inline]] inline unsigned present() const { return ~0u; }

  /// The corner that is farthest along the plane's normal, and the nearest one.
  [[gnu::always_inline]] inline Sides sidesOf(const VolumePlanes& v) const {
    Sides s{0, ~0u};
    for (unsigned plane = 0; plane < v.count; ++plane) {
      const float* axis[3];
      for (unsigned k = 0; k < 3; ++k) axis[k] = group + 8 * k + first + (v.normal[plane][k] < 0 ? 0 : 24);
      const F far = along(v, plane, load<F>(axis[0]), load<F>(axis[1]), load<F>(axis[2]));
      for (unsigned k = 0; k < 3; ++k) axis[k] = group + 8 * k + first + (v.normal[plane][k] < 0 ? 24 : 0);
      const F near = along(v, plane, load<F>(axis[0]), load<F>(axis[1]), load<F>(axis[2]));
      const F limit = rounding + v.rounding[plane];
      s.outside |= less(far, -limit);
      s.inside &= less(limit, near);
    }
    return s;
  }
};

/// All bounds of a group.
template <class F, template <class> class Bounds>
struct Group {
  static constexpr unsigned kLanes = sizeof(F) / sizeof(float), kParts = kLanesOfAGroup / kLanes;

  const float* at;

  [[gnu::always_inline]] inline unsigned present() const {
    unsigned bits = 0;
    for (unsigned part = 0; part < kParts; ++part)
      bits |= (Bounds<F>(at, part * kLanes).present() & ((1u << kLanes) - 1)) << (part * kLanes);
    return bits;
  }
  [[gnu::always_inline]] inline Sides sidesOf(const VolumePlanes& v) const {
    Sides all{0, 0};
    for (unsigned part = 0; part < kParts; ++part) {
      const Sides s = Bounds<F>(at, part * kLanes).sidesOf(v);
      constexpr unsigned kAll = (1u << kLanes) - 1;
      all.outside |= (s.outside & kAll) << (part * kLanes);
      all.inside |= (s.inside & kAll) << (part * kLanes);
    }
    return all;
  }
};

/// By lane of a group: the volumes that it may touch but is not surely inside, and those that it is.
struct Found {
  unsigned maybe[kLanesOfAGroup], surely[kLanesOfAGroup];
};

/// Tests one group against what its box may touch; returns the bits of the lanes that are there.
template <class G>
[[gnu::always_inline]] inline unsigned testGroup(const G& group, unsigned lanes, const TreeGroup& in,
                                                 const VolumePlanes* volumes, Found& found,
                                                 unsigned long long* tested) {
  const unsigned present = group.present() & ((1u << lanes) - 1);
  for (unsigned lane = 0; lane < kLanesOfAGroup; ++lane) {
    found.maybe[lane] = 0;
    found.surely[lane] = in.inside;
  }
  for (unsigned rest = in.touches; rest != 0; rest &= rest - 1) {
    const auto v = static_cast<unsigned>(__builtin_ctz(rest));
    const unsigned bit = 1u << v;
    tested[v] += lanes;
    const Sides s = group.sidesOf(volumes[v]);
    const unsigned kept = present & ~s.outside;
    for (unsigned left = kept; left != 0; left &= left - 1) {
      const auto lane = static_cast<unsigned>(__builtin_ctz(left));
      (s.inside >> lane & 1 ? found.surely[lane] : found.maybe[lane]) |= bit;
    }
  }
  return present;
}

/// `emit(node, maybe, surely)` for each of a level's nodes that any volume may touch.
template <class G, class Emit>
[[gnu::always_inline]] inline void testGroups(const float* bounds, unsigned floatsOfAGroup, unsigned nodes,
                                              const VolumePlanes* volumes, const TreeGroup* in,
                                              unsigned groups, unsigned long long* tested, const Emit& emit) {
  for (unsigned i = 0; i < groups; ++i) {
    const unsigned first = kLanesOfAGroup * in[i].group;
    const unsigned lanes = nodes - first < kLanesOfAGroup ? nodes - first : kLanesOfAGroup;
    Found found;
    const G group{bounds + static_cast<unsigned long>(floatsOfAGroup) * in[i].group};
    for (unsigned left = testGroup(group, lanes, in[i], volumes, found, tested); left != 0;
         left &= left - 1) {
      const auto lane = static_cast<unsigned>(__builtin_ctz(left));
      if ((found.maybe[lane] | found.surely[lane]) != 0)
        emit(first + lane, found.maybe[lane], found.surely[lane]);
    }
  }
}

template <class F>
[[gnu::always_inline]] inline unsigned
testBoxes(const float* boxes, unsigned nodes, const VolumePlanes* volumes, const TreeGroup* in,
          unsigned groups, TreeGroup* out, unsigned long long* tested) {
  unsigned count = 0;
  testGroups<Group<F, Boxes>>(
      boxes, 48, nodes, volumes, in, groups, tested,
      [ out, &count ](unsigned node, unsigned maybe, unsigned surely) __attribute__((always_inline)) {
        out[count++] = {node, maybe, surely};
      });
  return count;
}

template <class F>
[[gnu::always_inline]] inline unsigned
testSpheres(const float* spheres, unsigned nodes, const VolumePlanes* volumes, const TreeGroup* in,
            unsigned groups, TreeSphere* out, unsigned long long* tested) {
  unsigned count = 0;
  testGroups<Group<F, Spheres>>(
      spheres, 32, nodes, volumes, in, groups, tested,
      [ out, &count ](unsigned node, unsigned maybe, unsigned surely) __attribute__((always_inline)) {
        out[count++] = {node, surely, maybe};
      });
  return count;
}

}  // namespace
}  // namespace stadion
