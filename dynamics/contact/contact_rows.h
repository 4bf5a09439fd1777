#pragma once
/// Contact points as the solver's inner loops see them: what each axis reads from velocities and what an
/// impulse along it changes, worked out once for each step.

#include "dynamics/contact/contact_solver.h"

#include <array>

namespace stadion {

/// An axis of a contact's basis.
struct ContactAxis {
  Vec3 n = Vec3::Zero(), spinA = Vec3::Zero(), spinB = Vec3::Zero();  ///< the velocity along it
  /// Change of velocities by an impulse of 1 N s.
  Vec3 p = Vec3::Zero(), turnA = Vec3::Zero(), turnB = Vec3::Zero();

  double velocity(const SolverBody& a, const SolverBody& b) const {
    return n.dot(a.v - b.v) + spinA.dot(a.omega) - spinB.dot(b.omega);
  }
  void give(SolverBody& a, SolverBody& b, double impulse) const {
    a.v += a.inverseMass * impulse * p;
    a.omega += impulse * turnA;
    b.v -= b.inverseMass * impulse * p;
    b.omega -= impulse * turnB;
  }
};

struct ContactRow {
  std::uint32_t a = 0, b = 0;
  std::array<ContactAxis, 3> axis;
  double response = 0;  ///< change of the normal velocity by a normal impulse of 1 N s [1/kg]
  /// Part of the normal velocity, for each N s, by which the contact may fall short [1/kg].
  double shortfall = 0;
  double normalMass = 0, tangentMass = 0;  ///< 1 / response (and shortfall); 1 / greatest response across it
  std::vector<std::uint32_t> points;       ///< points that carry this area ...
  std::vector<Vec2> places;                ///< ... and where, as in `at`
  Vec2 at = Vec2::Zero();    ///< place of a point that carries an area, in units of the area's radius
  Mat3 stop = Mat3::Zero();  ///< for an area: the impulse that stops a slip [kg]

  Vec3 velocity(const std::vector<SolverBody>& m) const {
    return {axis[0].velocity(m[a], m[b]), axis[1].velocity(m[a], m[b]), axis[2].velocity(m[a], m[b])};
  }
  void give(std::vector<SolverBody>& m, const Vec3& impulse) const {
    for (int i = 0; i < 3; ++i)
      if (impulse[i] != 0) axis[static_cast<std::size_t>(i)].give(m[a], m[b], impulse[i]);
  }
};

/// Friction of an area under a load whose centre may be off its middle, per unit of mu N.
class LoadedArea {
public:
  LoadedArea(const std::vector<SolverContact>& contacts, const ContactRow& row, const ContactArea& area);

  double load = 0;  ///< [N s]
  ContactArea::Resistance against(const Vec3& slip) const;
  ContactArea::Need needFor(const Vec3& force) const;
  /// How `resistance` times the load changes with the load on a point at `at`.
  Vec3 shareOf(const Vec2& at, const Vec3& slip) const;

private:
  const ContactArea& area_;
  Vec2 centre_ = Vec2::Zero();
  Mat3 to_ = Mat3::Identity();  ///< slip about the middle to slip as the narrower area sees it
};

std::vector<ContactRow> rowsOf(const std::vector<SolverBody>& solverBodies,
                               const std::vector<SolverContact>& contacts);

}  // namespace stadion
