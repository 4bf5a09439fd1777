#pragma once
/// Velocities of bodies in lasting contact: all contact points of an island at once.
///
/// Method   Warm-started Gauss-Seidel sweeps over the points, each with its normal and a friction disc, find
///          the active set: which points push, stick and slip. Small islands then solve exactly for this
///          set, and correct it until it is consistent. The solution is dense, with slight regularisation
///          and refinement, so redundant points and mass ratios do not matter. Larger islands, and those
///          whose set does not settle, continue with sweeps along conjugate directions.

#include "dynamics/body/impulse.h"
#include "dynamics/contact/flat_friction.h"

#include <cstdint>
#include <vector>

namespace stadion {

/// A contact point through one step. Bases are (n, t1, t2), n from b to a; they and the arms differ where the
/// bodies turn during the step: velocities are judged at its end, impulses act in its middle.
struct SolverContact {
  std::uint32_t a = 0, b = 0;                             ///< indices of solverBodies
  Mat3 rows = Mat3::Identity(), push = Mat3::Identity();  ///< bases at the end and in the middle
  Vec3 armA = Vec3::Zero(), armB = Vec3::Zero();          ///< from the centres of mass at the end [m]
  Vec3 pushA = Vec3::Zero(), pushB = Vec3::Zero();        ///< arms in the middle of the step [m]
  double friction = 0;
  double floor = 0;          ///< normal velocity that the step must reach [m/s]
  double give = 0;           ///< the normal velocity may stay this part of the impulse's effect below `floor`
  Vec2 slip = Vec2::Zero();  ///< slip before the step, if `slides`: friction goes against the mean slip [m/s]
  bool slides = false;       ///< known to slip all through the step
  Vec3 impulse = Vec3::Zero();  ///< in `push` [N s]; the guess on entry

  // Points that carry a flat contact leave friction to its area: one more contact, which presses nothing. Its
  // normal axis stands for the spin about the normal, in units of the area's radius.
  std::int32_t patch = -1;            ///< index of that contact; -1: the point has friction of its own
  const ContactArea* area = nullptr;  ///< area of a flat contact; null: this is a point
  double spin = 0;                    ///< slip by the spin about the normal, before the step [m/s]
  bool limited = false;               ///< the friction is at its limit

  /// Takes place at a point of a (at pa) and b (at pb), as at one moment.
  void placeAt(const Vec3& point, const Vec3& n, const Vec3& pa, const Vec3& pb);
  Vec3 velocity(const std::vector<SolverBody>& m) const {
    Vec3 u = rows.transpose() * (m[a].v + m[a].omega.cross(armA) - m[b].v - m[b].omega.cross(armB));
    if (area) u[0] = area->radius() * rows.col(0).dot(m[a].omega - m[b].omega);
    return u;
  }
};

/// A basis with n first, the same for the same n.
Mat3 basisAround(const Vec3& n);

/// How long the exact solution is looked for: in each step of what moves, or once for what stands still and
/// may sleep at once.
enum class Effort : std::uint8_t { Moving, AtRest };

/// Raises every contact's normal velocity to its `floor`, with friction. True if it holds to rounding.
bool solveContacts(std::vector<SolverBody>& solverBodies, std::vector<SolverContact>& contacts,
                   Effort effort = Effort::Moving);

}  // namespace stadion
