#pragma once
/// The motion of one body between two of its events, known for any age of the arc without stepping.
///
/// Translation and rotation separate (the fields act at the centre of mass): a `Path` carries the centre, a
/// `Spin` the orientation. Age is seconds since the arc began. All of this is exact, with three exceptions:
///   - `Path` under fields that are not uniform: a quintic through a step of a fifth-order integrator
///   - `Spin` of asymmetric bodies: a Taylor polynomial of order 16, with a horizon for an error below 1e-13
///   - `Spin::steered`, a body that the air turns: through a step of the same integrator

#include "engine/maths/maths.h"

#include <algorithm>
#include <array>
#include <limits>

namespace stadion {

/// The age up to which the last two terms, c_16 t^16 and c_15 t^15, of a Taylor series stay below the
/// tolerance. (Two, since one may vanish by symmetry.)
double reachOfSeries(double c16, double c15, double tolerance);

/// The rate of change of a rotation vector w whose rotation has the angular velocity `omega`, to w^4.
Vec3 rateOfTurn(const Vec3& w, const Vec3& omega);

/// Where the centre of mass goes.
struct Path {
  enum class Kind { Polynomial, Damped };
  Kind kind = Kind::Polynomial;
  static constexpr int kMostDegree = 16;
  int degree = 0;
  double damping = 0;  ///< [1/s]
  double spare = 0;    ///< bound on the acceleration of a polynomial of degree > 2 [m/s2]
  /// Coefficients up to `degree`, and one to spare for code that reads four numbers at once. Damped:
  /// position, velocity, acceleration.
  std::array<Vec3, kMostDegree + 2> c;

  Path() {
    c[0].setZero();
    c[1].setZero();
    c[2].setZero();
    c.back().setZero();
  }
  Path(const Path& o) : Path() { *this = o; }
  Path& operator=(const Path& o);
  static Path still(const Vec3& p);
  /// Uniform acceleration a, with velocity lost at the rate `damping`.
  static Path parabola(const Vec3& p, const Vec3& v, const Vec3& a, double damping = 0);
  /// Quintic through position, velocity and acceleration at both ends of a step of h seconds.
  static Path hermite(const Vec3 (&start)[3], const Vec3 (&end)[3], double h);

  Vec3 position(double age) const {
    if (isParabola()) return c[0] + age * (c[1] + age * c[2]);
    return isSeries() ? seriesPosition(age) : curvedPosition(age);
  }
  Vec3 velocity(double age) const { return isParabola() ? Vec3(c[1] + 2 * age * c[2]) : curvedVelocity(age); }
  /// Sets `spare` for ages up to `horizon`.
  void boundAcceleration(double horizon);
  /// At least the magnitude of the acceleration at any age within the horizon.
  double accelerationBound() const;
  bool isSeries() const { return degree == kMostDegree; }
  bool isParabola() const { return kind == Kind::Polynomial && degree <= 2; }

private:
  Vec3 seriesPosition(double age) const;
  Vec3 curvedPosition(double age) const;
  Vec3 curvedVelocity(double age) const;
  Vec3 dampedPosition(double age) const;
  Vec3 polynomialPosition(double age) const;
};

/// Members that every kind of spin has; see Spin.
struct SpinTerms {
  enum class Kind { Still, Uniform, Symmetric, Taylor, Driven, Steered };
  Kind kind = Kind::Still;
  int axis = 2;                 ///< axis of symmetry
  Quat q0 = Quat::Identity();   ///< at age 0, C to World
  Vec3 L = Vec3::Zero();        ///< angular momentum in World, constant but for Driven, Steered [kg m2/s]
  Vec3 omega = Vec3::Zero();    ///< Uniform, Driven, Steered: at age 0, in World [rad/s]
  Vec3 alpha = Vec3::Zero();    ///< Driven: constant angular acceleration in World [rad/s2]
  Vec3 inverse = Vec3::Ones();  ///< inverse principal moments [1/(kg m2)]
  double horizon = std::numeric_limits<double>::infinity();  ///< greatest valid age [s]
};

/// How the body turns.
struct Spin : SpinTerms {
  static constexpr int kOrder = 16;
  static constexpr std::size_t kSteered = 7;  ///< how much of the series a steered one has
  /// Taylor: of (w, x, y, z). Steered: of the turn beside the free motion from the second power on, of the
  /// angular momentum from the first on, then the bounds of speed and of its change.
  std::array<Eigen::Vector4d, kOrder + 1> series;

  Spin() = default;
  Spin(const Spin& o) : SpinTerms(o) { copySeries(o); }
  Spin& operator=(const Spin& o) {
    SpinTerms::operator=(o);
    copySeries(o);
    return *this;
  }

  /// Free rotation from orientation q and world angular momentum L.
  static Spin free(const Quat& q, const Vec3& L, const Vec3& inertia);
  static Spin still(const Quat& q);
  /// How it turns at one end of a step.
  struct End {
    Quat q;       ///< C to World
    Vec3 L;       ///< [kg m2/s]
    Vec3 torque;  ///< in World [N m]
  };
  /// A body under torques through a step of h seconds of which both ends are known: it moves as if it were
  /// free, and makes a small smooth turn beside, which carries it to the second end.
  static Spin steered(const End& start, const End& end, double h, const Vec3& inertia);
  /// Returns the motion to which `steered` adds a small turn. For a body of revolution this is the exact free
  /// motion, for others an even turn.
  static Spin unsteered(const Quat& q, const Vec3& L, const Vec3& inertia);
  /// A ball under constant torque.
  static Spin driven(const Quat& q, const Vec3& omega, const Vec3& alpha, double inertia);

  Quat orientation(double age) const {
    if (kind == Kind::Still) return q0;
    return kind == Kind::Taylor ? seriesOrientation(age) : turnedOrientation(age);
  }
  Vec3 angularVelocity(double age) const;
  /// For an orientation that is known already.
  Vec3 angularVelocity(double age, const Quat& orientation) const;
  Vec3 angularMomentum(double age) const;
  /// At least the angular speed at any age up to `age`.
  double speedBound(double age) const;
  /// Steered: at least how fast the angular velocity changes [rad/s2].
  double steeredChange() const { return series[6][1]; }

private:
  Quat seriesOrientation(double age) const;
  Quat turnedOrientation(double age) const;
  Quat steeredOrientation(double age) const;
  Quat precession(double age) const;
  /// Steered: for `axis`, of what else is beside the small turn: an even one, none.
  static constexpr int kEven = 3, kStanding = 4;
  void copySeries(const Spin& o) {
    if (kind == Kind::Taylor)
      series = o.series;
    else if (kind == Kind::Steered)
      std::copy_n(o.series.begin(), kSteered, series.begin());
  }
};

}  // namespace stadion
