#pragma once
/// Bodies of revolution as meshes.

#include "engine/asset/mesh.h"
#include "engine/maths/angles.h"

#include <cmath>
#include <utility>
#include <vector>

namespace stadion::bodies {

/// The axis of the profile.
enum class Along { X, Z };

/// `profile` lists places on the axis and radii there, both in metres. Ends with a radius are closed by a
/// lid.
inline Mesh revolved(const std::vector<std::pair<double, double>>& profile, int sides, Along along) {
  Mesh m;
  const auto put = [&](double a, double r, double angle) {
    const auto s = static_cast<float>(a), u = static_cast<float>(r * std::cos(angle)),
               v = static_cast<float>(r * std::sin(angle));
    m.positions.push_back(along == Along::X ? std::array<float, 3>{s, u, v} : std::array<float, 3>{u, v, s});
  };
  for (const auto& [a, r] : profile)
    for (int i = 0; i < sides; ++i) put(a, r, 2 * kPi * i / sides);
  const auto n = static_cast<std::uint32_t>(sides);
  for (std::uint32_t ring = 0; ring + 1 < profile.size(); ++ring)
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = ring * n + i, b = ring * n + (i + 1) % n;
      m.indices.insert(m.indices.end(), {a, b, b + n, a, b + n, a + n});
    }
  for (const bool end : {false, true}) {
    const auto centre = static_cast<std::uint32_t>(m.positions.size());
    put((end ? profile.back() : profile.front()).first, 0, 0);
    const std::uint32_t first = end ? static_cast<std::uint32_t>(profile.size() - 1) * n : 0;
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = first + i, b = first + (i + 1) % n;
      if (end)
        m.indices.insert(m.indices.end(), {a, b, centre});
      else
        m.indices.insert(m.indices.end(), {b, a, centre});
    }
  }
  return m;
}

/// A men's javelin, tip at x = 0 and tail at x = -2.65; its centre of mass is at x = -1.05.
inline Mesh javelin(int sides = 24) {
  std::vector<std::pair<double, double>> profile;
  const double x[] = {0, .15, .525, 1.05, 1.30, 1.85, 2.50, 2.65},
               d[] = {.003, .020, .024, .027, .027, .0245, .011, .0035};
  for (int i = 7; i >= 0; --i) profile.emplace_back(-x[i], 0.5 * d[i]);
  return revolved(profile, sides, Along::X);
}

/// A men's discus about the z axis, 22 cm wide and 4.5 cm thick.
inline Mesh discus(int sides = 48) {
  return revolved({{-.0225, .025}, {-.006, .106}, {0, .11}, {.006, .106}, {.0225, .025}}, sides, Along::Z);
}

/// A ball with poles on the z axis.
inline Mesh ball(double radius, int sides = 32) {
  std::vector<std::pair<double, double>> profile;
  for (int i = 0; i <= sides / 2; ++i) {
    const double a = kPi * (2.0 * i / sides - 0.5);
    profile.emplace_back(radius * std::sin(a), radius * std::max(std::cos(a), 0.0));
  }
  return revolved(profile, sides, Along::Z);
}

}  // namespace stadion::bodies
