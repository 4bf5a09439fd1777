#include "dynamics/contact_choice.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr double kTrace = 1e-9;    ///< regularisation, relative to the diagonal
constexpr double kExact = 1e-13;   ///< residual at which the linear solution is done [m/s]
constexpr double kRound = 1e-12;   ///< violations below this are rounding [m/s]
constexpr int kMends = 24;         ///< of a choice at most ...
constexpr int kTogether = 5;       ///< ... and those of all points at once; they may go round in circles
constexpr double kNearly = 0.5;    ///< a direction that is off by less is improved by Newton's method [rad]
constexpr double kUnsolved = 1e3;  ///< a residual as of points that contradict each other: they explode [m/s]
constexpr double kAssembly = 30;   ///< multiplications for each coefficient, and for what is done with it

bool isFinite(const Mobile& m) {
  return m.v.allFinite() && m.omega.allFinite();
}

}  // namespace

/// The slip that friction goes against.
Vec2 ContactChoice::slipOf(std::size_t contact) const {
  const SolverContact& c = c_[contact];
  const Vec2 u = rows_[contact].velocity(m_).tail<2>();
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

/// Friction at its limit goes against the slip. Once its direction is nearly known it is found by Newton's
/// method: with friction f across the present direction t, the slip across it is that part's share of the
/// speed, u t = -speed f / mu N.
void ContactChoice::listSlip(std::uint32_t contact) {
  const SolverContact& c = c_[contact];
  Vec2 f = c.impulse.tail<2>();
  f /= std::max(f.norm(), 1e-300);
  unknowns_.push_back({contact,
                       Vec3(1, 0, 0),
                       {1, c.friction * f.x(), c.friction * f.y()},
                       c.floor,
                       rows_[contact].shortfall,
                       true});
  if (!(speed_[contact] > 0)) return;
  const Vec3 across(0, -f.y(), f.x());
  const double share = speed_[contact] / std::max(c.friction * c.impulse[0], 1e-300);
  if (c.slides)
    unknowns_.push_back({contact, across, across, -across.tail<2>().dot(c.slip), 2 * share, false});
  else
    unknowns_.push_back({contact, across, across, 0, share, false});
}

void ContactChoice::list() {
  unknowns_.clear(), axes_.clear();
  for (std::size_t k = 0; k < c_.size(); ++k) {
    const auto i = static_cast<std::uint32_t>(k);
    if (kind_[k] == Kind::Slip) listSlip(i);
    if (kind_[k] != Kind::Stick) continue;
    unknowns_.push_back({i, Vec3::UnitX(), Vec3::UnitX(), c_[k].floor, rows_[k].shortfall, true});
    if (c_[k].friction > 0)
      for (const Vec3& t : {Vec3(0, 1, 0), Vec3(0, 0, 1)}) unknowns_.push_back({i, t, t, 0, 0, false});
  }
  for (const Unknown& u : unknowns_) axes_.push_back(along(rows_[u.contact], u));
}

ContactAxis ContactChoice::along(const ContactRow& row, const Unknown& u) {
  ContactAxis sum;
  for (int k = 0; k < 3; ++k) {
    const ContactAxis& x = row.axis[static_cast<std::size_t>(k)];
    if (u.reads[k] != 0)
      sum.n += u.reads[k] * x.n, sum.spinA += u.reads[k] * x.spinA, sum.spinB += u.reads[k] * x.spinB;
    if (u.direction[k] != 0)
      sum.p += u.direction[k] * x.p, sum.turnA += u.direction[k] * x.turnA,
          sum.turnB += u.direction[k] * x.turnB;
  }
  return sum;
}

void ContactChoice::assemble() {
  const auto n = static_cast<Eigen::Index>(unknowns_.size());
  K_.setZero(n, n);
  r_.resize(n);
  for (Eigen::Index j = 0; j < n; ++j) {
    const Unknown& u = unknowns_[static_cast<std::size_t>(j)];
    const ContactRow& c = rows_[u.contact];
    const ContactAxis& y = axes_[static_cast<std::size_t>(j)];
    const Vec3 va = m_[c.a].inverseMass * y.p, vb = m_[c.b].inverseMass * y.p;
    const bool movesA = m_[c.a].inverseMass > 0, movesB = m_[c.b].inverseMass > 0;
    for (Eigen::Index i = 0; i < n; ++i) {
      const ContactRow& d = rows_[unknowns_[static_cast<std::size_t>(i)].contact];
      const ContactAxis& x = axes_[static_cast<std::size_t>(i)];
      double change = 0;
      if (movesA && d.a == c.a) change += x.n.dot(va) + x.spinA.dot(y.turnA);
      if (movesA && d.b == c.a) change -= x.n.dot(va) + x.spinB.dot(y.turnA);
      if (movesB && d.a == c.b) change -= x.n.dot(vb) + x.spinA.dot(y.turnB);
      if (movesB && d.b == c.b) change += x.n.dot(vb) + x.spinB.dot(y.turnB);
      K_(i, j) = change;
    }
    K_(j, j) += kTrace * std::fabs(K_(j, j)) + u.soft + 1e-300;
  }
}

/// Solves and refines; returns the residual left [m/s].
double ContactChoice::solve() {
  const Eigen::PartialPivLU<Eigen::MatrixXd> lu(K_);
  double before = 1e300;
  for (int pass = 0; pass < 8; ++pass) {
    for (std::size_t i = 0; i < unknowns_.size(); ++i) {
      const Unknown& u = unknowns_[i];
      const Vec3& impulse = c_[u.contact].impulse;
      const double size = u.normal ? impulse[0] : u.direction.dot(impulse);
      r_[static_cast<Eigen::Index>(i)] =
          u.wanted - u.soft * size - axes_[i].velocity(m_[rows_[u.contact].a], m_[rows_[u.contact].b]);
    }
    if (!r_.allFinite()) return 1e300;  // the greatest of them would pass over what is undefined
    const double worst = r_.cwiseAbs().maxCoeff();
    if (!(worst > kExact) || !(worst < 0.7 * before)) return worst;
    before = worst;
    const Eigen::VectorXd x = lu.solve(r_);
    if (!x.allFinite()) return 1e300;
    for (std::size_t i = 0; i < unknowns_.size(); ++i) {
      const Unknown& u = unknowns_[i];
      const double size = x[static_cast<Eigen::Index>(i)];
      c_[u.contact].impulse += size * u.direction;
      axes_[i].give(m_[rows_[u.contact].a], m_[rows_[u.contact].b], size);
    }
  }
  return before;
}

void ContactChoice::put(std::size_t contact, const Vec3& impulse) {
  rows_[contact].give(m_, impulse - c_[contact].impulse);
  c_[contact].impulse = impulse;
}

/// Corrects the choice where a point disagrees, `singly` only the worst; true if all agree.
bool ContactChoice::mend(bool singly) {
  double largest = 0, worst = 0;
  for (const SolverContact& c : c_) {
    largest = std::max(largest, std::fabs(c.impulse[0]));
    worst = std::min(worst, c.impulse[0]);
  }
  // First what pulls; only then is friction worth a look.
  bool agreed = true;
  const double pulls = singly ? std::min(worst, -1e-13 * largest) : 0;
  for (std::size_t k = 0; k < c_.size(); ++k) {
    if (kind_[k] == Kind::Open || !(c_[k].impulse[0] < 0)) continue;
    const bool rounding = c_[k].impulse[0] >= -1e-13 * largest;
    if (!rounding && c_[k].impulse[0] > pulls) continue;
    agreed = agreed && rounding;
    put(k, Vec3::Zero());
    kind_[k] = Kind::Open;
  }
  if (!agreed) return false;
  worst = -kRound;
  std::vector<double>& over = over_;
  over.assign(c_.size(), 0);
  for (std::size_t k = 0; k < c_.size(); ++k)
    if (kind_[k] == Kind::Open)
      over[k] = rows_[k].velocity(m_)[0] - c_[k].floor, worst = std::min(worst, over[k]);
  for (std::size_t k = 0; k < c_.size(); ++k) {
    if (over[k] >= -kRound || (singly && over[k] > worst)) continue;
    kind_[k] = Kind::Stick, agreed = false;
  }
  return agreed && mendFriction(largest);
}

bool ContactChoice::mendFriction(double largest) {
  bool agreed = true;
  slip_.resize(c_.size());
  for (std::size_t k = 0; k < c_.size(); ++k)
    if (kind_[k] == Kind::Slip) slip_[k] = slipOf(k);
  for (std::size_t k = 0; k < c_.size(); ++k) {
    const SolverContact& c = c_[k];
    if (kind_[k] == Kind::Open || c.friction <= 0) continue;
    const Vec2 f = c.impulse.tail<2>();
    const double most = c.friction * c.impulse[0], size = f.norm();
    const bool beyond = size > most * (1 + 1e-10) + 1e-15 * largest;
    const double speed = kind_[k] == Kind::Slip ? slip_[k].norm() : 0;
    Vec2 wanted = f;
    if (speed < kRound) {  // it sticks
      if (!beyond) continue;
      wanted = f * (most / size), speed_[k] = 0;
      kind_[k] = Kind::Slip;
    } else if (slip_[k].dot(f) > 0) {
      kind_[k] = Kind::Stick;
    } else {
      const double off = (slip_[k] / speed + f / std::max(size, 1e-300)).norm();
      if (off < 1e-9) continue;
      wanted = -slip_[k] * (most / speed), speed_[k] = off < kNearly ? speed : 0;
    }
    put(k, {c.impulse[0], wanted.x(), wanted.y()});
    agreed = false;
  }
  return agreed;
}

bool ContactChoice::settle(double& work) {
  // Points that contradict each other have no solution, and what came of it would explode.
  const std::vector<Mobile> mobiles = m_;
  const std::vector<SolverContact> contacts = c_;
  if (attempt(work)) return true;
  m_ = mobiles, c_ = contacts;
  return false;
}

bool ContactChoice::attempt(double& work) {
  read();
  speed_.assign(c_.size(), 0);
  for (int i = 0; i < kMends; ++i) {
    list();
    const auto n = static_cast<double>(unknowns_.size());
    work -= n * n * (kAssembly + n / 3);
    if (i > 0 && work < 0) return false;
    double left = 0;
    if (!unknowns_.empty()) {
      assemble();
      left = solve();
    }
    if (!(left < kUnsolved)) return false;
    if (mend(i >= kTogether)) return left < 1e-10 && std::ranges::all_of(m_, isFinite);
  }
  return false;
}

}  // namespace stadion
