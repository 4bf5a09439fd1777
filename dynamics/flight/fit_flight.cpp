#include "dynamics/flight/fit_flight.h"

#include "engine/maths/angles.h"

#include <cmath>

namespace stadion {
namespace {

constexpr double kFinest = 1.0 / 240;  ///< [s]
constexpr double kLongest = 5;         ///< how much later than recorded it may land [s]

/// A body on its way; steps of any length.
class Flier {
public:
  Flier(const RigidFlight& start, const FitTask& task, const FlightModel& model, const Bias& bias)
      : task_(task), model_(model), bias_(bias), axis_(symmetryAxis(model).value_or(fitAxis(task))) {
    now_ = {start.p, start.v, start.q, momentumOf(task.body, axis_, start.q, start.w)};
  }

  RigidFlight now() const { return {now_.p, now_.v, now_.q, angularVelocityOf(task_.body, axis_, now_)}; }

  void advance(double seconds) {
    const int steps = std::max(1, static_cast<int>(std::ceil(seconds / kFinest - 1e-9)));
    const double h = seconds / steps;
    if (!stepper_ || h != step_)
      stepper_ = std::make_unique<FlightStepper>(model_, task_.body, task_.air, h, axis_);
    step_ = h;
    for (int i = 0; i < steps; ++i) {
      now_.q = biased(bias_, now_.q, now_.v, 0.5 * h);
      stepper_->step(now_);
      now_.q = biased(bias_, now_.q, now_.v, 0.5 * h);
    }
  }

private:
  const FitTask& task_;
  const FlightModel& model_;
  const Bias& bias_;
  int axis_;
  double step_ = 0;
  FlightState now_;
  std::unique_ptr<FlightStepper> stepper_;
};

/// The moment between two at which the centre comes down to `height`.
TrajectorySample comesDown(const Trajectory& between, double height) {
  double low = between[0].t, high = between[1].t;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (low + high);
    (sampleAt(between, middle).p.z() > height ? low : high) = middle;
  }
  return {high, sampleAt(between, high)};
}

}  // namespace

int fitAxis(const FitTask& task) {
  return task.shape.elongated() ? 0 : 2;
}

Trajectory flyBeside(const Trajectory& recorded, const FitTask& task, const FlightModel& model,
                     const Bias& bias) {
  const double height = recorded.back().at.p.z();
  Flier flier(recorded.front().at, task, model, bias);
  Trajectory flown{{recorded.front().t, flier.now()}};
  std::optional<TrajectorySample> landing;
  const auto go = [&](double t) {
    const TrajectorySample before = flown.back();
    flier.advance(t - before.t);
    const TrajectorySample after{t, flier.now()};
    const bool down = after.at.v.z() < 0 && after.at.p.z() <= height;
    if (!landing && down && before.at.p.z() > height) landing = comesDown({before, after}, height);
    flown.push_back(after);
  };
  for (std::size_t i = 1; i < recorded.size(); ++i) go(recorded[i].t);
  const double end = recorded.back().t + kLongest;
  while (!landing && flown.back().t < end && flown.back().at.p.allFinite()) go(flown.back().t + 0.05);
  flown.resize(recorded.size());  // what was flown beyond belongs to the landing alone
  flown.push_back(landing ? *landing : flown.back());
  return flown;
}

Eigen::VectorXd apart(const Trajectory& flown, const Trajectory& recorded, int axis,
                      const FitTolerance& tolerance) {
  const double range = (recorded.back().at.p - recorded.front().at.p).head<2>().norm();
  const double metres = tolerance.landing * std::max(range, 1e-3),
               share = 1 / std::sqrt(double(recorded.size()));
  // An axis that was not asked for still shows what the air does to it.
  const double radians = std::min(tolerance.attitude, 5.0) * kDegree;
  Eigen::VectorXd r(6 * static_cast<Eigen::Index>(recorded.size()) + 2);
  Eigen::Index n = 0;
  for (std::size_t i = 0; i < recorded.size(); ++i) {
    const Vec3 k = Vec3::Unit(axis);
    r.segment<3>(n) = share * (flown[i].at.p - recorded[i].at.p) / metres;
    r.segment<3>(n + 3) = share * (flown[i].at.q * k - recorded[i].at.q * k) / radians;
    n += 6;
  }
  r.tail<2>() = (flown.back().at.p - recorded.back().at.p).head<2>() / metres;
  return r;
}

FitErrors errorsBetween(const Trajectory& flown, const Trajectory& recorded, int axis) {
  const double range = std::max((recorded.back().at.p - recorded.front().at.p).head<2>().norm(), 1e-3);
  FitErrors e;
  e.landing = (flown.back().at.p - recorded.back().at.p).head<2>().norm() / range;
  for (std::size_t i = 0; i < recorded.size(); ++i) {
    const Vec3 a = flown[i].at.q * Vec3::Unit(axis), b = recorded[i].at.q * Vec3::Unit(axis);
    e.attitude += det::atan2(a.cross(b).norm(), a.dot(b)) / kDegree / static_cast<double>(recorded.size());
  }
  return e;
}

}  // namespace stadion
