#pragma once
/// Steps of many bodies, as many at a time as S has lanes. Internal to dynamics/flight/.
///
/// Linkage  internal; includes nothing but step_kernel.h (see lanes.h). Laws and numbers come as plain arrays
///          of doubles, since their types are each file's own.

#include "dynamics/flight/step_kernel.h"

namespace stadion {
namespace {

template <class S>
[[gnu::always_inline]] inline S load(const double* from) {
  S s;
  __builtin_memcpy(&s, from, sizeof s);
  return s;
}
template <class S>
[[gnu::always_inline]] inline void store(double* to, const S& s) {
  __builtin_memcpy(to, &s, sizeof s);
}

template <class S>
[[gnu::always_inline]] inline Motion<S> loadMotion(double* const* a, unsigned long i) {
  const auto at = [a, i](int k) { return load<S>(a[k] + i); };
  return {
      {at(0), at(1), at(2)}, {at(3), at(4), at(5)}, {at(6), at(7), at(8), at(9)}, {at(10), at(11), at(12)}};
}
template <class S>
[[gnu::always_inline]] inline void storeMotion(double* const* a, unsigned long i, const Motion<S>& m) {
  const S all[] = {m.p.x, m.p.y, m.p.z, m.v.x, m.v.y, m.v.z, m.q.w, m.q.x, m.q.y, m.q.z, m.L.x, m.L.y, m.L.z};
  for (int k = 0; k < 13; ++k) store(a[k] + i, all[k]);
}

/// `count` is a whole number of lanes; `step(motion)` is one step.
template <class S, class Step>
[[gnu::always_inline]] inline void eachLane(double* const* arrays, unsigned long count, const Step& step) {
  for (unsigned long i = 0; i < count; i += sizeof(S) / sizeof(double)) {
    Motion<S> m = loadMotion<S>(arrays, i);
    step(m);
    storeMotion(arrays, i, m);
  }
}

template <class T>
[[gnu::always_inline]] inline T fromNumbers(const double* numbers) {
  T t;
  __builtin_memcpy(&t, numbers, sizeof t);
  return t;
}

template <class S>
[[gnu::always_inline]] inline void rodSteps(const double* law, const double* numbers, double* const* arrays,
                                            unsigned long count) {
  const auto l = fromNumbers<RodLaw>(law);
  const auto n = fromNumbers<StepNumbers>(numbers);
  eachLane<S>(
      arrays, count, [&l, &n ](Motion<S> & m) __attribute__((always_inline)) { revolvedStep<0>(l, n, m); });
}
template <class S>
[[gnu::always_inline]] inline void plateSteps(const double* law, const double* numbers, double* const* arrays,
                                              unsigned long count) {
  const auto l = fromNumbers<PlateLaw>(law);
  const auto n = fromNumbers<StepNumbers>(numbers);
  eachLane<S>(
      arrays, count, [&l, &n ](Motion<S> & m) __attribute__((always_inline)) { revolvedStep<2>(l, n, m); });
}
template <class S>
[[gnu::always_inline]] inline void ballSteps(const double* law, const double* numbers, double* const* arrays,
                                             unsigned long count) {
  const auto l = fromNumbers<BallLaw>(law);
  const auto n = fromNumbers<StepNumbers>(numbers);
  eachLane<S>(
      arrays, count, [&l, &n ](Motion<S> & m) __attribute__((always_inline)) { ballStep(l, n, m); });
}
template <int Axis, class S>
[[gnu::always_inline]] inline void freeSteps(const double* numbers, double* const* arrays,
                                             unsigned long count) {
  const auto n = fromNumbers<StepNumbers>(numbers);
  eachLane<S>(
      arrays, count, [&n](Motion<S> & m) __attribute__((always_inline)) { freeStep<Axis>(n, m); });
}

}  // namespace
}  // namespace stadion
