#pragma once
/// What a step of a pile may do to the energy of bodies that push each other: lower it.
///
/// Groups   bodies that any contact point of the step has joined, through members only. A group that leans on
///          something that moves by itself is not bounded: it may be lifted.

#include "dynamics/contact/pile_solver.h"

namespace stadion {

class PileEnergy {
public:
  explicit PileEnergy(const Pile& pile);

  /// After the jump, `before` being the velocities before it: no group gains kinetic energy.
  void boundJump(Pile& pile, const std::vector<PileBody>& before);
  /// After the shift: what it lifts is paid with what the jump took and with a little motion; `deep` is the
  /// overlap from which on it costs nothing [m].
  void payShift(Pile& pile, double deep);
  /// After the forces: their work on a group is negative at both ends of the step, thus throughout.
  void boundWork(Pile& pile);

private:
  struct Group {
    double before = 0, start = 0, end = 0;    ///< v M v [J]
    double across = 0;                        ///< start M end
    double fallsAtStart = 0, fallsAtEnd = 0;  ///< h v M g
    double lifts = 0;                         ///< by the shift [J]
    bool driven = false, deep = false;
  };
  std::uint32_t of(std::uint32_t i);
  void join(const Pile& pile);
  double product(const Pile& pile, std::size_t i, const PileBody& a, const PileBody& b) const;
  static void slow(PileBody& body, double share) {
    body.v *= share;
    body.omega *= share;
  }

  std::vector<std::uint32_t> parent_;
  std::vector<char> pushed_, driven_;
  std::vector<Group> groups_;  ///< at the root's index
  std::vector<double> taken_;  ///< from each body by the jump [J]
};

}  // namespace stadion
