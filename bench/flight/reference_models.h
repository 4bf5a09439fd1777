#pragma once
/// The exact models that made the reference flights: expensive, for benches and tests only.
///
/// Frames   A, as in dynamics/flight/flight_model.h: javelin +x nose, discus z axis.
/// Sources  Javelin: strips in cross flow, 8 Gauss points on each of 7 segments (the quadrature is part of
///          the definition). Discus: a circular wing with vortex lift, stall and pitch damping. Ball: drag
///          crisis after Goff and Carre (2009), saturating Magnus lift.

#include "dynamics/flight/flight_model.h"

#include <array>

namespace stadion::bench {

class StripJavelin {
public:
  explicit StripJavelin(double density = 1.2);
  Wrench operator()(const Vec3& u, const Vec3& w) const;

private:
  struct Station {
    double ahead;              ///< position ahead of the centre of mass [m]
    double cross, skin, lift;  ///< rho/2 Cdc d, rho/2 Cf pi d, rho kap dS/dx, each times the strip's length
  };
  std::array<Station, 56> stations_;
  double nose_;  ///< rho/2 CA0 Smax
};

class WingDiscus {
public:
  explicit WingDiscus(double density = 1.2) : density_(density) {}
  Wrench operator()(const Vec3& u, const Vec3& w) const;

private:
  double density_;
};

class CrisisBall {
public:
  explicit CrisisBall(double density = 1.2) : density_(density) {}
  Wrench operator()(const Vec3& u, const Vec3& w) const;

private:
  double density_;
};

}  // namespace stadion::bench
