#include "engine/figure/skinning.h"

#include <cmath>
#include <cstring>

namespace stadion {
namespace {

/// Four numbers at a time, by the compiler's vectors.
using Lanes = float __attribute__((vector_size(16)));

constexpr Lanes all(float v) {
  return Lanes{v, v, v, v};
}

/// Columns of a matrix (3 x 4); the fourth number of each is of no use.
struct Columns {
  Lanes x, y, z, origin;
};

Columns columnsOf(const JointMatrix& m) {
  Columns c;
  static_assert(sizeof c == sizeof m);
  std::memcpy(&c, m.data(), sizeof c);
  return c;
}

Columns weighted(const Columns& c, float weight) {
  const Lanes w = all(weight);
  return {c.x * w, c.y * w, c.z * w, c.origin * w};
}

void add(Columns& sum, const Columns& c, float weight) {
  const Lanes w = all(weight);
  sum.x += c.x * w;
  sum.y += c.y * w;
  sum.z += c.z * w;
  sum.origin += c.origin * w;
}

Lanes turned(Lanes v) {
  return __builtin_shufflevector(v, v, 1, 2, 0, 3);
}

Lanes cross(Lanes a, Lanes b) {
  return turned(a * turned(b) - turned(a) * b);
}

float sumOf(Lanes v) {
  return v[0] + v[1] + v[2];
}

std::array<float, 3> firstThree(Lanes v) {
  std::array<float, 3> out;
  std::memcpy(out.data(), &v, sizeof out);
  return out;
}

/// The normal to a surface that the matrix takes somewhere. A matrix that makes it flat keeps it.
std::array<float, 3> normalBy(const Columns& m, const std::array<float, 3>& n) {
  const Lanes x = cross(m.y, m.z);
  const Lanes turnedNormal = x * all(n[0]) + cross(m.z, m.x) * all(n[1]) + cross(m.x, m.y) * all(n[2]);
  const float length = std::sqrt(sumOf(turnedNormal * turnedNormal));
  if (!(length > 0) || !std::isfinite(length)) return n;
  const float mirrors = sumOf(m.x * x) < 0 ? -1.0f : 1.0f;
  return firstThree(turnedNormal * all(mirrors / length));
}

Columns blended(const VertexJoints& carried, std::span<const JointMatrix> palette) {
  Columns m = weighted(columnsOf(palette[carried.joint[0]]), carried.weight[0]);
  for (std::size_t k = 1; k < VertexJoints::kMost; ++k)
    if (carried.weight[k] > 0) add(m, columnsOf(palette[carried.joint[k]]), carried.weight[k]);
  return m;
}

std::array<float, 4> tangentBy(const Columns& m, const std::array<float, 4>& t) {
  const Lanes turnedTangent = m.x * all(t[0]) + m.y * all(t[1]) + m.z * all(t[2]);
  const float length = std::sqrt(sumOf(turnedTangent * turnedTangent));
  if (!(length > 0) || !std::isfinite(length)) return t;
  const std::array<float, 3> unit = firstThree(turnedTangent * all(1 / length));
  const bool mirrors = sumOf(m.x * cross(m.y, m.z)) < 0;
  return {unit[0], unit[1], unit[2], mirrors ? -t[3] : t[3]};
}

}  // namespace

void skin(const SkinSource& from, std::span<const JointMatrix> palette, std::size_t first,
          std::span<SkinnedVertex> out) {
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Columns m = blended(from.joints[first + i], palette);
    const std::array<float, 3>& p = from.positions[first + i];
    out[i].position = firstThree(m.x * all(p[0]) + m.y * all(p[1]) + m.z * all(p[2]) + m.origin);
    out[i].normal = normalBy(m, from.normals[first + i]);
  }
}

void skinTangents(std::span<const std::array<float, 4>> tangents, std::span<const VertexJoints> joints,
                  std::span<const JointMatrix> palette, std::size_t first,
                  std::span<std::array<float, 4>> out) {
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = tangentBy(blended(joints[first + i], palette), tangents[first + i]);
}

}  // namespace stadion
