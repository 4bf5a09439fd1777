#include "engine/core/state_hash.h"

#include <bit>
#include <xxhash.h>

namespace stadion {

void StateHash::add(std::uint64_t v) {
  // SplitMix64's finaliser over a running value: every bit of every field reaches every bit of the hash.
  std::uint64_t z = (value_ ^ v) + 0x9e3779b97f4a7c15ULL;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  value_ = z ^ (z >> 31);
}

void StateHash::add(double v) {
  add(std::bit_cast<std::uint64_t>(v));
}

void StateHash::add(std::string_view v) {
  add(std::uint64_t{XXH64(v.data(), v.size(), 0)});
}

void StateHash::add(const Vec3& v) {
  for (int i = 0; i < 3; ++i) add(v[i]);
}

void StateHash::add(const Quat& q) {
  for (int i = 0; i < 4; ++i) add(q.coeffs()[i]);
}

void StateHash::add(const Affine& X) {
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 3; ++r) add(X.matrix()(r, c));
}

}  // namespace stadion
