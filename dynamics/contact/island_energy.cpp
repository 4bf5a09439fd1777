#include "dynamics/contact/island_energy.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr double kRounding = 1e-13;  ///< relative excess that is none

/// I w [kg m2/s].
Vec3 spun(const SolverBody& m, const Vec3& w) {
  return w.isZero(0) ? Vec3(Vec3::Zero()) : Vec3(m.inverseInertia.inverse() * w);
}

}  // namespace

double boundWork(std::size_t members, const std::vector<SolverBody>& free, std::vector<SolverBody>& end,
                 const std::vector<Vec3>& falls, double allowed) {
  double b = 0, c = 0, size = 0;
  for (std::size_t i = 0; i < members; ++i) {
    const Vec3 dv = end[i].v - free[i].v, dw = end[i].omega - free[i].omega, L = spun(end[i], dw);
    const Vec3 mean = falls.empty() ? free[i].v : Vec3(free[i].v - falls[i]);
    const double along = dv.dot(mean) / end[i].inverseMass, around = L.dot(free[i].omega);
    b += along + around;
    size += std::fabs(along) + std::fabs(around);
    c += 0.5 * (dv.squaredNorm() / end[i].inverseMass + L.dot(dw));
  }
  if (b + c <= allowed + kRounding * (size + c) || !(c > 0)) return b + c;
  const double a = std::clamp((-b + std::sqrt(std::max(0.0, b * b + 4 * c * allowed))) / (2 * c), 0.0, 1.0);
  for (std::size_t i = 0; i < members; ++i) {
    end[i].v = free[i].v + a * (end[i].v - free[i].v);
    end[i].omega = free[i].omega + a * (end[i].omega - free[i].omega);
  }
  return a * (b + a * c);
}

double kineticEnergy(std::size_t members, const std::vector<SolverBody>& bodies) {
  double energy = 0;
  for (std::size_t i = 0; i < members; ++i) {
    const SolverBody& m = bodies[i];
    energy += 0.5 * (m.v.squaredNorm() / m.inverseMass + m.omega.dot(spun(m, m.omega)));
  }
  return energy;
}

double turningWork(std::size_t members, const std::vector<SolverBody>& start,
                   const std::vector<SolverBody>& free) {
  double work = 0;
  for (std::size_t i = 0; i < members; ++i)
    work += 0.5 * (start[i].omega.dot(spun(start[i], start[i].omega)) -
                   free[i].omega.dot(spun(free[i], free[i].omega)));
  return work;
}

double pushOutWork(std::size_t members, const std::vector<SolverBody>& start, const std::vector<Vec3>& pull,
                   double h, double speed) {
  if (!(speed > 0)) return 0;
  double wanted = 0, lifts = 0;
  for (std::size_t i = 0; i < members; ++i) {
    const double m = 1 / start[i].inverseMass;
    wanted += m * speed * speed;
    lifts += m * h * pull[i].norm() * speed;
  }
  return std::max(0.0, wanted + lifts - kineticEnergy(members, start));
}

}  // namespace stadion
