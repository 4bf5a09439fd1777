#pragma once
/// One step of a pile of bodies: many contact points, a few sweeps, and contacts that add no energy.
///
/// Method   a step has two parts. At its start velocities jump, so that a body that would meet another
///          within the step bounces, or closes its gap and no more. Through the step every body has one
///          acceleration, from its pull and from the forces at its contact points. These keep the mean
///          velocity from closing more than the gap. Projected Gauss-Seidel sweeps find both; the forces
///          begin with the last step's.
/// Energy   with even accelerations, the work of all contact forces on a set of bodies changes linearly
///          through the step. It is negative throughout if it is negative at both ends. If the sweeps leave
///          it positive, the set is slowed down. The energy of the jump is bounded likewise.
/// Overlap  a shift removes it. The set pays for that with what the jump took and with a little of its
///          motion. Only far deeper overlap, which no step leaves behind, is removed for free.
/// Result   the energy of a pile that nothing moves from outside never rises. This holds for round bodies;
///          others turn with their mean momentum.

#include "engine/maths/maths.h"

#include <cstdint>
#include <vector>

namespace stadion {

/// Behind every three numbers lies a fourth, so that the solver reads four at once.
struct PileBody {
  Vec3 v = Vec3::Zero();
  double inverseMass = 0;
  Vec3 omega = Vec3::Zero();
  double roundInertia = 0;  ///< inverse, of balls; 0: see Pile::inverseInertia
};

struct PileContact {
  std::uint32_t a = 0, b = 0;      ///< indices of bodies
  Vec3 n = Vec3::UnitZ();          ///< from b to a
  double pressed = 0;              ///< impulse on a along n [N s]
  Vec3 tangential = Vec3::Zero();  ///< impulse on a across n [N s]
  double floor = 0;                ///< least normal velocity [m/s]
  double leverA = 0, leverB = 0;   ///< round: how far the centres are from the point, along n [m]
  double friction = 0, restitution = 0;
  double rolling = 0;  ///< moment that resists a's spin, per force along n [m]
  double gap = 0;      ///< [m]
  double normalMass = 0, tangentMass = 0;
  std::int32_t arms = -1;  ///< index into Pile::arms; -1: round
};

struct PileArms {
  Vec3 a = Vec3::Zero(), b = Vec3::Zero();          ///< from the centres of mass to the point [m]
  Vec3 holdA = Vec3::Zero(), holdB = Vec3::Zero();  ///< to where its friction acts: nearer to the middle of a
                                                    ///< flat contact, as the pressure is even there [m]
};

struct Pile {
  double h = 0;             ///< [s]
  std::size_t members = 0;  ///< the bodies behind them are moved by nothing
  std::vector<PileBody> bodies;
  std::vector<Mat3> inverseInertia;  ///< in World, of members that are not round
  std::vector<Vec3> pull;            ///< on the members [m/s2]
  std::vector<PileContact> contacts;
  std::vector<PileArms> arms;

  // Results; `bodies` have the velocities of the step's end, contacts the impulses of their forces.
  std::vector<PileBody> start;  ///< after the jump
  std::vector<Vec3> shift;      ///< shift of the places at the step's start [m]
};

/// On entry the contacts' impulses are a guess of what the forces will do.
void solvePile(Pile& pile);

}  // namespace stadion
