#pragma once
/// The compiled forms of swarm_kernel.h. Internal to dynamics/flight/.
///
/// `law` and `numbers` are RodLaw, PlateLaw or BallLaw and StepNumbers as arrays of doubles; `arrays` are the
/// 13 of a FlightSwarm; `count` is a whole number of four.

namespace stadion {

struct SwarmSteps {
  void (*rods)(const double* law, const double* numbers, double* const* arrays, unsigned long count);
  void (*plates)(const double* law, const double* numbers, double* const* arrays, unsigned long count);
  void (*balls)(const double* law, const double* numbers, double* const* arrays, unsigned long count);
  void (*freeX)(const double* numbers, double* const* arrays, unsigned long count);
  void (*freeZ)(const double* numbers, double* const* arrays, unsigned long count);
};

/// Two bodies at a time, on every machine.
extern const SwarmSteps kTwoSteps;
/// Four at a time, where there is AVX2.
extern const SwarmSteps kFourSteps;

}  // namespace stadion
