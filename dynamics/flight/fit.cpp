#include "dynamics/flight/fit.h"

#include "dynamics/flight/fit_flight.h"
#include "dynamics/flight/least_squares.h"
#include "engine/maths/angles.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

using Numbers = Eigen::VectorXd;
constexpr int kFitRounds = 40;

/// What is tuned: numbers that make a rung.
struct Tuning {
  Numbers start, scale;
  std::function<FittedRung(const Numbers&)> make;
};

/// Of all flights one after another; and a little for every number that goes far from its start, so that what
/// the flights do not tell stays.
Residuals residualsOf(const FitTask& task, const FitTolerance& tolerance, const Tuning& tuning) {
  return [&task, tolerance, &tuning](const Numbers& x) {
    const FittedRung rung = tuning.make(x);
    Numbers all = 1e-2 * (x - tuning.start).cwiseQuotient(tuning.scale);
    for (const Trajectory& f : task.flights) {
      const Numbers more = apart(flyBeside(f, task, rung.model, rung.bias), f, fitAxis(task), tolerance);
      const Eigen::Index n = all.size();
      all.conservativeResize(n + more.size());
      all.tail(more.size()) = more;
    }
    return all;
  };
}

FittedRung tuned(const FitTask& task, const FitTolerance& tolerance, const Tuning& tuning) {
  return tuning.make(
      leastSquares(residualsOf(task, tolerance, tuning), tuning.start, tuning.scale, kFitRounds));
}

/// A model of numbers; `start` says of which kind.
FittedRung ofKind(FlightKind kind, const Numbers& x) {
  const auto limits = coefficientsOf(kind);
  std::vector<double> c(limits.size());
  for (std::size_t i = 0; i < c.size(); ++i)
    c[i] = std::clamp(x[static_cast<Eigen::Index>(i)], limits[i].least, limits[i].most);
  FittedRung rung;
  rung.kind = kind;
  rung.model = *modelFrom(kind, c);
  return rung;
}

Tuning tuningOf(const FlightModel& start) {
  const FlightKind kind = kindOf(start);
  const std::vector<double> c = coefficientsOf(start);
  Tuning t;
  t.start = Eigen::Map<const Numbers>(c.data(), static_cast<Eigen::Index>(c.size()));
  t.scale = 0.3 * t.start.cwiseAbs();
  if (kind == FlightKind::Plate)
    t.scale[6] = 0.1 * c[0] * c[4] / std::max(c[1], 1e-9);  // none is known of damping
  if (kind == FlightKind::Ball) t.scale[0] = 1e-9 * c[0];   // the radius is known
  t.scale = t.scale.cwiseMax(1e-12);
  t.make = [kind](const Numbers& x) { return ofKind(kind, x); };
  return t;
}

/// From several starts, whatever lands best.
FittedRung bestOf(const FitTask& task, const FitTolerance& tolerance,
                  const std::vector<FlightModel>& starts) {
  std::optional<FittedRung> best;
  for (const FlightModel& start : starts) {
    FittedRung rung = tuned(task, tolerance, tuningOf(start));
    rung.errors = errorsOf(task, rung.model, rung.bias);
    if (!best || rung.errors.landing < best->errors.landing) best = std::move(rung);
  }
  return *best;
}

/// The greatest angle of attack of the flights, as tables count it.
double greatestAlpha(const FitTask& task) {
  double most = 0;
  for (const Trajectory& f : task.flights)
    for (const TrajectorySample& s : f) {
      const Vec3 u = s.at.v - task.air.wind, k = s.at.q * Vec3::Unit(fitAxis(task));
      const double between = det::atan2(k.cross(u).norm(), k.dot(u));
      most = std::max(most, fitAxis(task) == 0 ? between : std::fabs(between - 90 * kDegree));
    }
  return most;
}

/// Rows of a table as a model has them, per area and length.
std::vector<FlightTableRow> rowsOf(const FlightModel& model, double area, double length) {
  const bool rod = symmetryAxis(model).value_or(0) == 0;
  constexpr double kDense = 1, kSpeed = 20;
  const double pressure = 0.5 * kDense * kSpeed * kSpeed * area;
  std::vector<FlightTableRow> rows;
  for (const double degrees : {0., 2.5, 5., 7.5, 10., 15., 20., 25., 30., 35., 40., 50., 60., 75., 90.}) {
    const auto [s, c] = det::sincos(degrees * kDegree);
    const Vec3 h(c, 0, -s), up(s, 0, c);
    const Wrench f = aerodynamics(model, kDense, kSpeed * h, Vec3::Zero());
    const Vec3 across = rod ? Vec3::UnitZ() : Vec3::UnitX();
    const double drag = (aerodynamics(model, kDense, kSpeed * h, across).torque - f.torque).dot(across);
    rows.push_back({degrees * kDegree, -f.force.dot(h) / pressure, f.force.dot(up) / pressure,
                    -f.torque.y() / (pressure * length),
                    -drag / (0.5 * kDense * area * length * length * kSpeed)});
  }
  return rows;
}

/// A table about what a closed form says: its rows at the angles that were flown, and its damping.
Tuning tableTuning(const FitTask& task, const FlightModel& form) {
  const int axis = fitAxis(task);
  const double area = std::max(axis == 0 ? task.shape.sideArea : task.shape.topArea, 1e-9);
  const double length = std::max(axis == 0 ? task.shape.length : task.shape.width, 1e-6);
  const std::vector<FlightTableRow> rows = rowsOf(form, area, length);
  const double most = greatestAlpha(task);
  std::size_t flown = 2;
  while (flown < rows.size() && rows[flown - 1].alpha < most) ++flown;
  constexpr double FlightTableRow::*kColumns[] = {&FlightTableRow::drag, &FlightTableRow::lift,
                                                  &FlightTableRow::moment};
  Tuning t;
  const auto count = static_cast<Eigen::Index>(3 * flown + 1);
  t.start = Numbers::Zero(count);
  t.scale = Numbers::Constant(count, 0.05);
  t.make = [=](const Numbers& x) {
    FittedRung rung;
    rung.kind = FlightKind::Table;
    rung.area = area;
    rung.length = length;
    rung.rows = rows;
    for (std::size_t c = 0; c < 3; ++c) {
      double largest = 1e-6;  // of the column where it was flown
      for (std::size_t i = 0; i < flown; ++i) largest = std::max(largest, std::fabs(rows[i].*kColumns[c]));
      for (std::size_t i = 0; i < flown; ++i) {
        const bool zero = c > 0 && i == 0;  // nothing lifts or turns it at no angle
        const double more = zero ? 0 : x[static_cast<Eigen::Index>(3 * i + c)] * largest;
        rung.rows[i].*kColumns[c] += more;
      }
    }
    for (FlightTableRow& r : rung.rows) {
      r.drag = std::max(r.drag, 0.0);
      r.damping = std::max(r.damping + x[count - 1] * 0.2, 0.0);
    }
    rung.model = tableFrom(rung.rows, area, length, axis);
    return rung;
  };
  return t;
}

/// The bias' rate that keeps the axis nearest to what was recorded; it moves no landing.
FittedRung fittedBias(const FitTask& task, const FitTolerance& tolerance) {
  Tuning t;
  t.start = Numbers::Constant(1, 1.2);
  t.scale = Numbers::Constant(1, 0.5);
  t.make = [&task](const Numbers& x) {
    FittedRung rung;
    rung.kind = FlightKind::Bias;
    rung.bias = biasFor(task.shape, BiasForm::Flow, std::max(x[0], 0.0));
    return rung;
  };
  return tuned(task, tolerance, t);
}

}  // namespace

FitErrors errorsOf(const FitTask& task, const FlightModel& model, const Bias& bias) {
  FitErrors worst;
  const auto raise = [](double& to, double by) { to = by <= to ? to : by; };  // a NaN counts as worst
  for (const Trajectory& f : task.flights) {
    const FitErrors e = errorsBetween(flyBeside(f, task, model, bias), f, fitAxis(task));
    raise(worst.landing, e.landing);
    raise(worst.attitude, e.attitude);
  }
  return worst;
}

std::vector<FittedRung> fitRungs(const FitTask& task, const FitTolerance& tolerance) {
  std::vector<FittedRung> rungs(1);
  const FlightShape& shape = task.shape;
  if (shape.round()) {
    rungs.push_back(bestOf(task, tolerance, {ballFrom(shape)}));
  } else {
    const FlightKind kind = shape.elongated() ? FlightKind::Rod : FlightKind::Plate;
    std::vector<FlightModel> starts;
    if (kind == FlightKind::Rod)
      starts = {rodFrom(shape), javelinFlight(shape.length)};
    else
      starts = {plateFrom(shape), discusFlight(shape.width)};
    rungs.push_back(bestOf(task, tolerance, starts));
    rungs.push_back(tuned(task, tolerance, tableTuning(task, rungs.back().model)));
    rungs.push_back(fittedBias(task, tolerance));
  }
  for (FittedRung& r : rungs) {
    r.errors = errorsOf(task, r.model, r.bias);
    // The axis of a round body points nowhere.
    r.good =
        r.errors.landing <= tolerance.landing && (shape.round() || r.errors.attitude <= tolerance.attitude);
  }
  return rungs;
}

}  // namespace stadion
