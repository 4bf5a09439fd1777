/// Two bodies at a time, with what every processor of the kind has.

#include "dynamics/flight/swarm_kernel.h"
#include "dynamics/flight/swarm_step.h"

namespace stadion {
namespace {

void rods(const double* law, const double* numbers, double* const* arrays, unsigned long count) {
  rodSteps<Two>(law, numbers, arrays, count);
}
void plates(const double* law, const double* numbers, double* const* arrays, unsigned long count) {
  plateSteps<Two>(law, numbers, arrays, count);
}
void balls(const double* law, const double* numbers, double* const* arrays, unsigned long count) {
  ballSteps<Two>(law, numbers, arrays, count);
}
void freeX(const double* numbers, double* const* arrays, unsigned long count) {
  freeSteps<0, Two>(numbers, arrays, count);
}
void freeZ(const double* numbers, double* const* arrays, unsigned long count) {
  freeSteps<2, Two>(numbers, arrays, count);
}

}  // namespace

const SwarmSteps kTwoSteps{rods, plates, balls, freeX, freeZ};

}  // namespace stadion
