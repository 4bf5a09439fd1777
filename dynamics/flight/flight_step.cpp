#include "dynamics/flight/flight_step.h"

#include "dynamics/flight/model_laws.h"
#include "dynamics/flight/step_kernel.h"
#include "dynamics/flight/swarm_step.h"
#include "dynamics/maths/double4.h"

#include <array>
#include <cstring>

namespace stadion {
namespace {

using AnyLaw = std::variant<std::monostate, RodLaw, PlateLaw, BallLaw, TableLaw<TableFlight::Piece>>;

StepNumbers numbersFor(const FlightBody& body, const FlightAir& air, double h) {
  StepNumbers n{};
  for (int i = 0; i < 3; ++i) {
    n.gravity[i] = air.gravity[i];
    n.wind[i] = air.wind[i];
  }
  n.h = h;
  n.half = 0.5 * h;
  n.fall = 0.125 * h * h;
  n.quarterTurn = 0.25 * h / body.across;
  n.spinTurn = 0.5 * h * (1 / body.along - 1 / body.across);
  n.inverseAcross = 1 / body.across;
  n.twist = 0.5 * air.density * h;
  n.kick = n.twist / body.mass;
  return n;
}

Motion<double> motionOf(const FlightState& s) {
  return {plain(s.p), plain(s.v), {s.q.w(), s.q.x(), s.q.y(), s.q.z()}, plain(s.L)};
}

void put(const Motion<double>& m, FlightState& s) {
  s.p = vec(m.p);
  s.v = vec(m.v);
  s.L = vec(m.L);
  s.q = Quat(m.q.w, m.q.x, m.q.y, m.q.z);
}

template <class T>
std::array<double, sizeof(T) / sizeof(double)> asNumbers(const T& t) {
  std::array<double, sizeof(T) / sizeof(double)> a;
  std::memcpy(a.data(), &t, sizeof t);
  return a;
}

}  // namespace

struct FlightStepper::Numbers {
  FlightModel model;  ///< a table's law points into it
  AnyLaw law;
  StepNumbers n;
  int axis;

  void step(Motion<double>& m) const {
    switch (law.index()) {
    case 0: return axis == 0 ? freeStep<0>(n, m) : freeStep<2>(n, m);
    case 1: return revolvedStep<0>(*std::get_if<1>(&law), n, m);
    case 2: return revolvedStep<2>(*std::get_if<2>(&law), n, m);
    case 3: return ballStep(*std::get_if<3>(&law), n, m);
    default:
      return axis == 0 ? revolvedStep<0>(*std::get_if<4>(&law), n, m)
                       : revolvedStep<2>(*std::get_if<4>(&law), n, m);
    }
  }
};

Vec3 momentumOf(const FlightBody& body, int axis, const Quat& q, const Vec3& w_A) {
  Vec3 inertia = Vec3::Constant(body.across);
  inertia[axis] = body.along;
  return q * inertia.cwiseProduct(w_A);
}

Vec3 angularVelocityOf(const FlightBody& body, int axis, const FlightState& s) {
  Vec3 inverse = Vec3::Constant(1 / body.across);
  inverse[axis] = 1 / body.along;
  return inverse.cwiseProduct(s.q.conjugate() * s.L);
}

FlightSwarm::FlightSwarm(std::size_t bodies)
    : bodies_(bodies), stride_((bodies + 3) / 4 * 4), numbers_(kArrays * stride_) {
  std::fill_n(array(6), stride_, 1.0);  // lanes without a body do not turn
}

FlightState FlightSwarm::at(std::size_t i) const {
  const auto n = [this, i](std::size_t k) { return numbers_[k * stride_ + i]; };
  return {{n(0), n(1), n(2)}, {n(3), n(4), n(5)}, Quat(n(6), n(7), n(8), n(9)), {n(10), n(11), n(12)}};
}

void FlightSwarm::set(std::size_t i, const FlightState& s) {
  const double n[kArrays] = {s.p.x(), s.p.y(), s.p.z(), s.v.x(), s.v.y(), s.v.z(), s.q.w(),
                             s.q.x(), s.q.y(), s.q.z(), s.L.x(), s.L.y(), s.L.z()};
  for (std::size_t k = 0; k < kArrays; ++k) array(k)[i] = n[k];
}

FlightStepper::FlightStepper(const FlightModel& model, const FlightBody& body, const FlightAir& air,
                             double seconds, int axis) {
  auto n = std::make_unique<Numbers>();
  n->model = model;
  n->n = numbersFor(body, air, seconds);
  n->axis = symmetryAxis(model).value_or(axis);
  if (const auto* rod = std::get_if<RodFlight>(&n->model)) n->law = lawOf(*rod);
  if (const auto* plate = std::get_if<PlateFlight>(&n->model)) n->law = lawOf(*plate);
  if (const auto* ball = std::get_if<SportsBall>(&n->model)) n->law = lawOf(*ball);
  if (const auto* table = std::get_if<TableFlight>(&n->model); table && !table->pieces.empty())
    n->law = lawOf(*table);
  numbers_ = std::move(n);
}
FlightStepper::FlightStepper(FlightStepper&&) noexcept = default;
FlightStepper::~FlightStepper() = default;

void FlightStepper::step(FlightState& state) const {
  Motion<double> m = motionOf(state);
  numbers_->step(m);
  put(m, state);
}

void FlightStepper::step(FlightSwarm& swarm) const {
  const SwarmSteps& steps = hasAvx2() ? kFourSteps : kTwoSteps;
  const auto n = asNumbers(numbers_->n);
  std::array<double*, FlightSwarm::kArrays> arrays;
  for (std::size_t k = 0; k < arrays.size(); ++k) arrays[k] = swarm.array(k);
  const std::size_t count = (swarm.size() + 3) / 4 * 4;
  switch (numbers_->law.index()) {
  case 0: return (numbers_->axis == 0 ? steps.freeX : steps.freeZ)(n.data(), arrays.data(), count);
  case 1: return steps.rods(asNumbers(std::get<1>(numbers_->law)).data(), n.data(), arrays.data(), count);
  case 2: return steps.plates(asNumbers(std::get<2>(numbers_->law)).data(), n.data(), arrays.data(), count);
  case 3: return steps.balls(asNumbers(std::get<3>(numbers_->law)).data(), n.data(), arrays.data(), count);
  default:
    for (std::size_t i = 0; i < swarm.size(); ++i) {
      FlightState s = swarm.at(i);
      step(s);
      swarm.set(i, s);
    }
  }
}

}  // namespace stadion
