#pragma once
/// The exact solution of a small contact problem, once it is known which points push, stick and slip.

#include "dynamics/contact_solver.h"

#include <Eigen/LU>

namespace stadion {

/// Adds an impulse, in the contact's own basis.
inline void giveImpulse(std::vector<Mobile>& m, const SolverContact& c, const Vec3& impulse) {
  const Vec3 p = c.push * impulse;
  Mobile &a = m[c.a], &b = m[c.b];
  a.v += a.inverseMass * p, a.omega += a.inverseInertia * c.pushA.cross(p);
  b.v -= b.inverseMass * p, b.omega -= b.inverseInertia * c.pushB.cross(p);
}

class ContactChoice {
public:
  ContactChoice(std::vector<Mobile>& mobiles, std::vector<SolverContact>& contacts)
      : m_(mobiles), c_(contacts) {}

  /// Reads the choice off the present impulses, solves for it and mends it until every point agrees. False if
  /// it does not settle; everything is then as it was.
  bool settle();

private:
  bool attempt();
  enum class Kind : std::uint8_t { Open, Stick, Slip };
  struct Unknown {
    std::uint32_t contact;
    int axis;        ///< whose velocity is prescribed
    Vec3 direction;  ///< of the impulse, in the contact's basis
  };
  void read();
  void list();
  void assemble();
  double solve();
  bool mend();
  Vec2 slipOf(const SolverContact& c) const;

  std::vector<Mobile>& m_;
  std::vector<SolverContact>& c_;
  std::vector<Kind> kind_;
  std::vector<Unknown> unknowns_;
  Eigen::MatrixXd K_;
  Eigen::VectorXd r_;
};

}  // namespace stadion
