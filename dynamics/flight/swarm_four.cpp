/// Four bodies at a time; this file alone is compiled for AVX2 and defines nothing that others could share.

#include "dynamics/flight/swarm_kernel.h"
#include "dynamics/flight/swarm_step.h"

namespace stadion {
namespace {

void rods(const double* law, const double* numbers, double* const* arrays, unsigned long count) {
  rodSteps<Four>(law, numbers, arrays, count);
}
void plates(const double* law, const double* numbers, double* const* arrays, unsigned long count) {
  plateSteps<Four>(law, numbers, arrays, count);
}
void balls(const double* law, const double* numbers, double* const* arrays, unsigned long count) {
  ballSteps<Four>(law, numbers, arrays, count);
}
void freeX(const double* numbers, double* const* arrays, unsigned long count) {
  freeSteps<0, Four>(numbers, arrays, count);
}
void freeZ(const double* numbers, double* const* arrays, unsigned long count) {
  freeSteps<2, Four>(numbers, arrays, count);
}

}  // namespace

const SwarmSteps kFourSteps{rods, plates, balls, freeX, freeZ};

}  // namespace stadion
