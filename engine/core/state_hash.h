#pragma once
/// The state hash: equal on two runs if and only if (up to chance) every field that it covers is equal.
///
/// It covers named fields, never memory layout or addresses. Scene::stateHash() lists what it covers, and
/// what only a snapshot compares. The fields of a node have a fixed order. The hashes of nodes are added up,
/// so nodes need none (node_hashes.h). Doubles count by their bits; -0 and +0 differ, and no NaN is ever in a
/// scene.

#include "engine/core/message.h"
#include "engine/maths/maths.h"

#include <cstdint>
#include <string_view>

namespace stadion {

class StateHash {
public:
  explicit StateHash(std::uint64_t seed = 0) : value_(seed ^ 0x51a0d10e5ee7c0deULL) {}

  void add(std::uint64_t v);
  void add(std::int64_t v) { add(static_cast<std::uint64_t>(v)); }
  void add(std::uint32_t v) { add(std::uint64_t{v}); }
  void add(bool v) { add(std::uint64_t{v}); }
  void add(double v);
  void add(std::string_view v);
  void add(const Vec3& v);
  void add(const Quat& q);
  void add(const Pose& X) {
    add(X.p);
    add(X.q);
  }
  void add(const Affine& X);
  void add(NodeRef r) { add((std::uint64_t{r.load} << 32) | r.position); }

  std::uint64_t value() const { return value_; }

private:
  std::uint64_t value_;
};

}  // namespace stadion
