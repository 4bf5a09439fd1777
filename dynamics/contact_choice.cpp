#include "dynamics/contact_choice.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr double kTrace = 1e-9;   ///< regularisation, relative to the diagonal
constexpr double kExact = 1e-13;  ///< residual at which the linear solution is done [m/s]
constexpr double kRound = 1e-12;  ///< violations below this are rounding [m/s]

}  // namespace

/// The slip that friction goes against.
Vec2 ContactChoice::slipOf(const SolverContact& c) const {
  const Vec2 u = c.velocity(m_).tail<2>();
  return c.slides ? Vec2(0.5 * (u + c.slip)) : u;
}

void ContactChoice::read() {
  kind_.resize(c_.size());
  for (std::size_t k = 0; k < c_.size(); ++k) {
    const SolverContact& c = c_[k];
    const double f = c.impulse.tail<2>().norm();
    kind_[k] = !(c.impulse[0] > 0)                                             ? Kind::Open
               : c.friction > 0 && f >= c.friction * c.impulse[0] * (1 - 1e-9) ? Kind::Slip
                                                                               : Kind::Stick;
  }
}

void ContactChoice::list() {
  unknowns_.clear();
  for (std::size_t k = 0; k < c_.size(); ++k) {
    const auto i = static_cast<std::uint32_t>(k);
    if (kind_[k] == Kind::Open) continue;
    Vec3 along = Vec3::UnitX();
    if (kind_[k] == Kind::Slip) {
      const Vec2 f = c_[k].impulse.tail<2>();
      along.tail<2>() = c_[k].friction * f / std::max(f.norm(), 1e-300);
    }
    unknowns_.push_back({i, 0, along});
    if (kind_[k] == Kind::Stick && c_[k].friction > 0)
      unknowns_.push_back({i, 1, Vec3::UnitY()}), unknowns_.push_back({i, 2, Vec3::UnitZ()});
  }
}

void ContactChoice::assemble() {
  const auto n = static_cast<Eigen::Index>(unknowns_.size());
  K_.setZero(n, n);
  r_.resize(n);
  for (Eigen::Index j = 0; j < n; ++j) {
    const Unknown& u = unknowns_[static_cast<std::size_t>(j)];
    const SolverContact& c = c_[u.contact];
    const Vec3 p = c.push * u.direction;
    const Mobile &a = m_[c.a], &b = m_[c.b];
    const Vec3 va = a.inverseMass * p, wa = a.inverseInertia * c.pushA.cross(p);
    const Vec3 vb = -b.inverseMass * p, wb = -(b.inverseInertia * c.pushB.cross(p));
    for (Eigen::Index i = 0; i < n; ++i) {
      const Unknown& row = unknowns_[static_cast<std::size_t>(i)];
      const SolverContact& d = c_[row.contact];
      Vec3 change = Vec3::Zero();
      if (a.inverseMass > 0) {
        if (d.a == c.a) change += va + wa.cross(d.armA);
        if (d.b == c.a) change -= va + wa.cross(d.armB);
      }
      if (b.inverseMass > 0) {
        if (d.a == c.b) change += vb + wb.cross(d.armA);
        if (d.b == c.b) change -= vb + wb.cross(d.armB);
      }
      K_(i, j) = d.rows.col(row.axis).dot(change);
    }
  }
  for (Eigen::Index i = 0; i < n; ++i) K_(i, i) += kTrace * std::fabs(K_(i, i)) + 1e-300;
}

/// Solves and refines; returns the residual left [m/s].
double ContactChoice::solve() {
  const Eigen::PartialPivLU<Eigen::MatrixXd> lu(K_);
  double before = 1e300;
  for (int pass = 0; pass < 8; ++pass) {
    for (std::size_t i = 0; i < unknowns_.size(); ++i) {
      const Unknown& u = unknowns_[i];
      const SolverContact& c = c_[u.contact];
      r_[static_cast<Eigen::Index>(i)] = (u.axis == 0 ? c.floor : 0) - c.velocity(m_)[u.axis];
    }
    const double worst = r_.cwiseAbs().maxCoeff();
    if (!(worst > kExact) || !(worst < 0.7 * before)) return worst;
    before = worst;
    const Eigen::VectorXd x = lu.solve(r_);
    if (!x.allFinite()) return 1e300;
    for (std::size_t i = 0; i < unknowns_.size(); ++i) {
      SolverContact& c = c_[unknowns_[i].contact];
      const Vec3 step = x[static_cast<Eigen::Index>(i)] * unknowns_[i].direction;
      c.impulse += step;
      giveImpulse(m_, c, step);
    }
  }
  return before;
}

/// Corrects the choice where a point disagrees; true if all agree.
bool ContactChoice::mend() {
  bool agreed = true;
  double largest = 0;
  for (const SolverContact& c : c_) largest = std::max(largest, std::fabs(c.impulse[0]));
  const auto put = [&](SolverContact& c, const Vec3& impulse) {
    giveImpulse(m_, c, impulse - c.impulse);
    c.impulse = impulse;
  };
  // First what pulls; only then is friction worth a look.
  for (std::size_t k = 0; k < c_.size(); ++k) {
    SolverContact& c = c_[k];
    if (kind_[k] == Kind::Open || c.impulse[0] >= 0) continue;
    if (c.impulse[0] < -1e-13 * largest) agreed = false;
    put(c, Vec3::Zero());
    kind_[k] = Kind::Open;
  }
  for (std::size_t k = 0; k < c_.size() && agreed; ++k) {
    if (kind_[k] != Kind::Open || c_[k].velocity(m_)[0] >= c_[k].floor - kRound) continue;
    kind_[k] = Kind::Stick, agreed = false;
  }
  if (!agreed) return false;
  for (std::size_t k = 0; k < c_.size(); ++k) {
    SolverContact& c = c_[k];
    if (kind_[k] == Kind::Open || c.friction <= 0) continue;
    const Vec2 f = c.impulse.tail<2>();
    const double most = c.friction * c.impulse[0], size = f.norm();
    if (kind_[k] == Kind::Stick && size > most * (1 + 1e-10) + 1e-15 * largest) {
      Vec3 impulse = c.impulse;
      impulse.tail<2>() = f * (most / size);
      put(c, impulse);
      kind_[k] = Kind::Slip, agreed = false;
    } else if (kind_[k] == Kind::Slip && size > 0) {
      const Vec2 u = slipOf(c);
      const double speed = u.norm();
      if (speed < kRound) continue;
      if (u.dot(f) > 0) {
        kind_[k] = Kind::Stick, agreed = false;
      } else if ((u / speed + f / size).norm() > 1e-9) {
        Vec3 impulse = c.impulse;
        impulse.tail<2>() = -u * (most / speed);
        put(c, impulse);
        agreed = false;
      }
    }
  }
  return agreed;
}

bool ContactChoice::settle() {
  // Points that contradict each other have no solution, and what came of it would explode.
  const std::vector<Mobile> mobiles = m_;
  const std::vector<SolverContact> contacts = c_;
  if (attempt()) return true;
  m_ = mobiles, c_ = contacts;
  return false;
}

bool ContactChoice::attempt() {
  read();
  for (int i = 0; i < 12; ++i) {
    list();
    double left = 0;
    if (!unknowns_.empty()) {
      assemble();
      left = solve();
    }
    if (mend()) return left < 1e-10;
  }
  return false;
}

}  // namespace stadion
