#include "dynamics/contact/contact_active_set.h"

#include "dynamics/contact/contact_order.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace stadion {
namespace {

constexpr double kRegularisation = 1e-9;  ///< regularisation, relative to the diagonal
constexpr double kExact = 1e-13;          ///< residual at which the linear solution is done [m/s]
constexpr double kRound = 1e-12;          ///< violations below this are rounding [m/s]
constexpr int kMostCorrections = 24;      ///< most corrections of the active set
constexpr int kJointCorrections =
    5;  ///< corrections of all points at once; they may cycle, so later only the worst one is corrected
constexpr double kAreaAgrees = 1e-8;  ///< friction of an area is right to this, relative to its strength
constexpr double kNearly = 0.5;    ///< a direction that is off by less is improved by Newton's method [rad]
constexpr double kUnsolved = 1e3;  ///< a residual as of points that contradict each other: they explode [m/s]
constexpr std::size_t kMostDenseUnknowns = 48;  ///< up to so many unknowns are solved for in one block
constexpr std::size_t kAlwaysTriedPoints = 48;  ///< for so many points a solution is tried, whatever it costs
constexpr double kAssembly = 30;  ///< multiplications for each coefficient, and for what is done with it

bool isFinite(const SolverBody& m) {
  return m.v.allFinite() && m.omega.allFinite();
}

}  // namespace

ContactActiveSet::ContactActiveSet(std::vector<SolverBody>& solverBodies,
                                   std::vector<SolverContact>& contacts, const std::vector<ContactRow>& rows)
    : m_(solverBodies), c_(contacts), rows_(rows), order_(contacts.size()) {
  std::iota(order_.begin(), order_.end(), 0u);
  if (contacts.size() <= kMostDenseUnknowns / 3) return;
  std::vector<LeaningPair> pairs;
  const auto side = [&](std::uint32_t i) {
    return m_[i].inverseMass > 0 ? i : static_cast<std::uint32_t>(m_.size());
  };
  for (const SolverContact& c : c_) pairs.push_back({side(c.a), side(c.b)});
  std::vector<std::uint32_t> place = placesInLine(m_.size(), pairs);
  place.push_back(0);
  std::ranges::stable_sort(order_, {}, [&](std::uint32_t k) {
    const std::uint32_t a = place[pairs[k][0]], b = place[pairs[k][1]];
    return std::pair(std::max(a, b), std::min(a, b));
  });
}

/// The slip that friction goes against.
Vec2 ContactActiveSet::slipOf(std::size_t contact) const {
  const SolverContact& c = c_[contact];
  const Vec2 u = rows_[contact].velocity(m_).tail<2>();
  return c.slides ? Vec2(0.5 * (u + c.slip)) : u;
}

Vec3 ContactActiveSet::areaSlipOf(std::size_t contact) const {
  const SolverContact& c = c_[contact];
  const Vec3 u = rows_[contact].velocity(m_);
  return c.slides ? Vec3(0.5 * (u + Vec3(c.spin, c.slip.x(), c.slip.y()))) : u;
}

void ContactActiveSet::readActiveSet() {
  kind_.resize(c_.size());
  flow_.assign(c_.size(), Vec3::Zero());
  for (std::size_t k = 0; k < c_.size(); ++k) {
    const SolverContact& c = c_[k];
    if (c.area) {
      const bool loaded = std::ranges::any_of(rows_[k].points, [&](auto i) { return c_[i].impulse[0] > 0; });
      kind_[k] = !loaded || c.friction <= 0 ? Kind::Open : c.limited ? Kind::Slip : Kind::Stick;
      if (kind_[k] == Kind::Slip) flow_[k] = areaSlipOf(k);
      continue;
    }
    if (c.patch >= 0) {
      kind_[k] = c.impulse[0] > 0 ? Kind::Stick : Kind::Open;
      continue;
    }
    const double f = c.impulse.tail<2>().norm();
    kind_[k] = !(c.impulse[0] > 0)                                             ? Kind::Open
               : c.friction > 0 && f >= c.friction * c.impulse[0] * (1 - 1e-9) ? Kind::Slip
                                                                               : Kind::Stick;
  }
}

/// Friction at its limit goes against the slip. Once its direction is nearly known it is found by Newton's
/// method: with friction f across the present direction t, the slip across it is that part's share of the
/// speed, u t = -speed f / mu N.
void ContactActiveSet::listSlip(std::uint32_t contact) {
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

/// Friction of an area at its limit follows the slip by Newton's method, once that is nearly known: across
/// it, in the two directions in which it matters, friction is linear in the slip.
void ContactActiveSet::listArea(std::uint32_t contact) {
  const SolverContact& c = c_[contact];
  const Vec3 flow = flow_[contact];
  if (!(speed_[contact] > 0) || flow.isZero(0)) return;
  const LoadedArea area(c_, rows_[contact], *c.area);
  const Mat3 slope = c.friction * area.load * area.against(flow).slope;
  int least = 0;
  flow.cwiseAbs().minCoeff(&least);
  const Vec3 e = flow.cross(Vec3::Unit(least)).normalized(), f = flow.normalized().cross(e);
  const double ee = e.dot(slope * e), ff = f.dot(slope * f), ef = 0.5 * (e.dot(slope * f) + f.dot(slope * e));
  // Turned so that neither changes the other.
  const double middle = 0.5 * (ee - ff), far = std::sqrt(middle * middle + ef * ef);
  Vec2 turn(1, 0);
  if (far > 0) turn = middle >= 0 ? Vec2(far + middle, ef) : Vec2(ef, far - middle);
  if (turn.isZero(0)) turn = Vec2(1, 0);
  turn.normalize();
  for (const Vec3& across : {Vec3(turn.x() * e + turn.y() * f), Vec3(turn.x() * f - turn.y() * e)}) {
    const double stiff = across.dot(slope * across);
    if (!(stiff > 0)) continue;
    const double before = c.slides ? -across.dot(Vec3(c.spin, c.slip.x(), c.slip.y())) : 0;
    unknowns_.push_back({contact, across, across, before, (c.slides ? 2 : 1) / stiff, false});
  }
}

void ContactActiveSet::listUnknowns() {
  unknowns_.clear();
  axes_.clear();
  for (const std::uint32_t i : order_) {
    const std::size_t k = i;
    if (kind_[k] == Kind::Slip) c_[k].area ? listArea(i) : listSlip(i);
    if (kind_[k] != Kind::Stick) continue;
    if (c_[k].area) {
      for (int axis = 0; axis < 3; ++axis)
        unknowns_.push_back({i, Vec3::Unit(axis), Vec3::Unit(axis), 0, 0, false});
      continue;
    }
    unknowns_.push_back({i, Vec3::UnitX(), Vec3::UnitX(), c_[k].floor, rows_[k].shortfall, true});
    if (const std::int32_t patch = c_[k].patch; patch >= 0) {
      const auto p = static_cast<std::size_t>(patch);
      if (kind_[p] != Kind::Slip || flow_[p].isZero(0)) continue;
      const LoadedArea area(c_, rows_[p], *c_[p].area);
      unknowns_.back().area = patch;
      unknowns_.back().also = -c_[p].friction * area.shareOf(rows_[k].at, flow_[p]);
    } else if (c_[k].friction > 0) {
      for (const Vec3& t : {Vec3(0, 1, 0), Vec3(0, 0, 1)}) unknowns_.push_back({i, t, t, 0, 0, false});
    }
  }
  amount_.assign(unknowns_.size(), 0);
  for (const Unknown& u : unknowns_) axes_.push_back(along(u));
}

void ContactActiveSet::add(ContactAxis& sum, const ContactRow& row, const Vec3& reads,
                           const Vec3& direction) {
  for (int k = 0; k < 3; ++k) {
    const ContactAxis& x = row.axis[static_cast<std::size_t>(k)];
    if (reads[k] != 0) {
      sum.n += reads[k] * x.n;
      sum.spinA += reads[k] * x.spinA;
      sum.spinB += reads[k] * x.spinB;
    }
    if (direction[k] != 0) {
      sum.p += direction[k] * x.p;
      sum.turnA += direction[k] * x.turnA;
      sum.turnB += direction[k] * x.turnB;
    }
  }
}

ContactAxis ContactActiveSet::along(const Unknown& u) const {
  ContactAxis sum;
  add(sum, rows_[u.contact], u.reads, u.direction);
  if (u.area >= 0) add(sum, rows_[static_cast<std::size_t>(u.area)], Vec3::Zero(), u.also);
  return sum;
}

bool ContactActiveSet::isDense() const {
  return unknowns_.size() <= kMostDenseUnknowns;
}

/// Finds where each row of the system begins (`firsts_`). Returns the multiplications that a solution takes.
double ContactActiveSet::planRows() {
  const std::size_t n = unknowns_.size();
  if (isDense()) return static_cast<double>(n * n) * (kAssembly + static_cast<double>(n) / 3);
  firsts_.resize(n);
  std::vector<std::size_t> first(m_.size(), n);
  double work = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const SolverContact& c = c_[unknowns_[i].contact];
    std::size_t from = i;
    for (const std::uint32_t b : {c.a, c.b})
      if (m_[b].inverseMass > 0) {
        first[b] = std::min(first[b], i);
        from = std::min(from, first[b]);
      }
    firsts_[i] = from;
    const auto width = static_cast<double>(i - from + 1);
    work += width * (width + kAssembly);
  }
  return work;
}

/// How an impulse along one unknown changes the velocity that belongs to another.
double ContactActiveSet::changeBy(std::size_t row, std::size_t column) const {
  const ContactRow &c = rows_[unknowns_[column].contact], &d = rows_[unknowns_[row].contact];
  const ContactAxis &x = axes_[row], &y = axes_[column];
  double change = 0;
  if (const double share = m_[c.a].inverseMass; share > 0) {
    if (d.a == c.a) change += x.n.dot(share * y.p) + x.spinA.dot(y.turnA);
    if (d.b == c.a) change -= x.n.dot(share * y.p) + x.spinB.dot(y.turnA);
  }
  if (const double share = m_[c.b].inverseMass; share > 0) {
    if (d.a == c.b) change -= x.n.dot(share * y.p) + x.spinA.dot(y.turnB);
    if (d.b == c.b) change += x.n.dot(share * y.p) + x.spinB.dot(y.turnB);
  }
  return change;
}

/// False if the matrix has no factors.
bool ContactActiveSet::assemble() {
  const std::size_t n = unknowns_.size();
  const auto extra = [&](std::size_t i, double diagonal) {
    return kRegularisation * std::fabs(diagonal) + unknowns_[i].soft + 1e-300;
  };
  r_.resize(static_cast<Eigen::Index>(n));
  if (!isDense()) {
    narrow_.reset(firsts_);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t k = firsts_[i]; k < i; ++k) {
        narrow_.at(i, k) = changeBy(i, k);
        narrow_.at(k, i) = changeBy(k, i);
      }
      const double diagonal = changeBy(i, i);
      narrow_.at(i, i) = diagonal + extra(i, diagonal);
    }
    return narrow_.factor();
  }
  const auto size = static_cast<Eigen::Index>(n);
  K_.resize(size, size);
  for (Eigen::Index j = 0; j < size; ++j) {
    for (Eigen::Index i = 0; i < size; ++i)
      K_(i, j) = changeBy(static_cast<std::size_t>(i), static_cast<std::size_t>(j));
    K_(j, j) += extra(static_cast<std::size_t>(j), K_(j, j));
  }
  lu_.compute(K_);
  return true;
}

void ContactActiveSet::solveFor(Eigen::VectorXd& r) {
  if (isDense()) {
    r = lu_.solve(r).eval();
    return;
  }
  x_.assign(r.data(), r.data() + r.size());
  narrow_.solve(x_);
  std::ranges::copy(x_, r.data());
}

/// Solves and refines; returns the residual left [m/s].
double ContactActiveSet::solveLinearly() {
  double before = 1e300;
  for (int pass = 0; pass < 8; ++pass) {
    for (std::size_t i = 0; i < unknowns_.size(); ++i) {
      const Unknown& u = unknowns_[i];
      const Vec3& impulse = c_[u.contact].impulse;
      const double size = u.normal ? impulse[0] : c_[u.contact].area ? amount_[i] : u.direction.dot(impulse);
      r_[static_cast<Eigen::Index>(i)] =
          u.wanted - u.soft * size - axes_[i].velocity(m_[rows_[u.contact].a], m_[rows_[u.contact].b]);
    }
    if (!r_.allFinite()) return 1e300;  // the greatest of them would pass over what is undefined
    const double worst = r_.cwiseAbs().maxCoeff();
    if (!(worst > kExact) || !(worst < 0.7 * before)) return worst;
    before = worst;
    solveFor(r_);
    if (!r_.allFinite()) return 1e300;
    for (std::size_t i = 0; i < unknowns_.size(); ++i) {
      const Unknown& u = unknowns_[i];
      const double size = r_[static_cast<Eigen::Index>(i)];
      c_[u.contact].impulse += size * u.direction;
      amount_[i] += size;
      if (u.area >= 0) c_[static_cast<std::size_t>(u.area)].impulse += size * u.also;
      axes_[i].give(m_[rows_[u.contact].a], m_[rows_[u.contact].b], size);
    }
  }
  return before;
}

void ContactActiveSet::setImpulse(std::size_t contact, const Vec3& impulse) {
  rows_[contact].give(m_, impulse - c_[contact].impulse);
  c_[contact].impulse = impulse;
}

/// Corrects the active set where a point disagrees, `singly` only the worst; true if all agree.
bool ContactActiveSet::correctActiveSet(bool singly) {
  double largest = 0, worst = 0;
  for (const SolverContact& c : c_) {
    if (c.area) continue;
    largest = std::max(largest, std::fabs(c.impulse[0]));
    worst = std::min(worst, c.impulse[0]);
  }
  // First what pulls; only then is friction worth a look.
  bool agreed = true;
  const double pulls = singly ? std::min(worst, -1e-13 * largest) : 0;
  for (std::size_t k = 0; k < c_.size(); ++k) {
    if (c_[k].area || kind_[k] == Kind::Open || !(c_[k].impulse[0] < 0)) continue;
    const bool rounding = c_[k].impulse[0] >= -1e-13 * largest;
    if (!rounding && c_[k].impulse[0] > pulls) continue;
    agreed = agreed && rounding;
    setImpulse(k, Vec3::Zero());
    kind_[k] = Kind::Open;
  }
  if (!agreed) return false;
  worst = -kRound;
  std::vector<double>& over = over_;
  over.assign(c_.size(), 0);
  for (std::size_t k = 0; k < c_.size(); ++k)
    if (kind_[k] == Kind::Open && !c_[k].area) {
      over[k] = rows_[k].velocity(m_)[0] - c_[k].floor;
      worst = std::min(worst, over[k]);
    }
  for (std::size_t k = 0; k < c_.size(); ++k) {
    if (over[k] >= -kRound || (singly && over[k] > worst)) continue;
    kind_[k] = Kind::Stick;
    agreed = false;
  }
  return agreed && correctFriction(largest);
}

bool ContactActiveSet::correctFriction(double largest) {
  bool agreed = true;
  slip_.resize(c_.size());
  areaSlip_.resize(c_.size());
  for (std::size_t k = 0; k < c_.size(); ++k)
    if (kind_[k] == Kind::Slip) c_[k].area ? void(areaSlip_[k] = areaSlipOf(k)) : void(slip_[k] = slipOf(k));
  for (std::size_t k = 0; k < c_.size(); ++k) {
    const SolverContact& c = c_[k];
    if (c.area) {
      agreed = correctArea(k) && agreed;
      continue;
    }
    if (kind_[k] == Kind::Open || leavesFriction(k)) continue;
    const Vec2 f = c.impulse.tail<2>();
    const double most = c.friction * c.impulse[0], size = f.norm();
    const bool beyond = size > most * (1 + 1e-10) + 1e-15 * largest;
    const double speed = kind_[k] == Kind::Slip ? slip_[k].norm() : 0;
    Vec2 wanted = f;
    if (speed < kRound) {  // it sticks
      if (!beyond) continue;
      wanted = f * (most / size);
      speed_[k] = 0;
      kind_[k] = Kind::Slip;
    } else if (slip_[k].dot(f) > 0) {
      kind_[k] = Kind::Stick;
    } else {
      const double off = (slip_[k] / speed + f / std::max(size, 1e-300)).norm();
      if (off < 1e-9) continue;
      wanted = -slip_[k] * (most / speed);
      speed_[k] = off < kNearly ? speed : 0;
    }
    setImpulse(k, {c.impulse[0], wanted.x(), wanted.y()});
    agreed = false;
  }
  return agreed;
}

/// The same for an area.
bool ContactActiveSet::correctArea(std::size_t k) {
  SolverContact& c = c_[k];
  if (c.friction <= 0) return true;
  const LoadedArea area(c_, rows_[k], *c.area);
  const double most = c.friction * area.load;
  if (!(most > 0)) {
    const bool open = kind_[k] == Kind::Open && c.impulse.isZero(0);
    setImpulse(k, Vec3::Zero());
    kind_[k] = Kind::Open;
    return open;
  }
  if (kind_[k] == Kind::Open) {
    kind_[k] = Kind::Stick;
    return false;
  }
  const Vec3 slip = kind_[k] == Kind::Slip ? areaSlip_[k] : Vec3(Vec3::Zero());
  const double speed = slip.norm();
  if (speed < kRound) {
    const ContactArea::Need need = area.needFor(-c.impulse / most);
    if (!(need.share > 1 + 1e-10)) return true;
    kind_[k] = Kind::Slip;
    flow_[k] = need.slip;
    speed_[k] = 0;
    setImpulse(k, c.impulse / need.share);
    return false;
  }
  const Vec3 wanted = -most * area.against(slip).force;
  const double off = (c.impulse - wanted).norm() / most;
  if (off < kAreaAgrees) return true;
  if (c.impulse.dot(slip) > 0) {
    kind_[k] = Kind::Stick;
    return false;
  }
  flow_[k] = slip;
  speed_[k] = off < kNearly ? speed : 0;
  setImpulse(k, wanted);
  return false;
}

bool ContactActiveSet::solve(double& work) {
  // Points that contradict each other have no solution, and what came of it would explode.
  const std::vector<SolverBody> solverBodies = m_;
  const std::vector<SolverContact> contacts = c_;
  if (trySolving(work)) return true;
  m_ = solverBodies;
  c_ = contacts;
  return false;
}

bool ContactActiveSet::trySolving(double& work) {
  readActiveSet();
  speed_.assign(c_.size(), 0);
  for (int i = 0; i < kMostCorrections; ++i) {
    listUnknowns();
    work -= planRows();
    if (work < 0 && (i > 0 || c_.size() > kAlwaysTriedPoints)) return false;
    double left = 0;
    if (!unknowns_.empty()) {
      if (!assemble()) return false;
      left = solveLinearly();
    }
    if (!(left < kUnsolved)) return false;
    if (correctActiveSet(i >= kJointCorrections)) return left < 1e-10 && std::ranges::all_of(m_, isFinite);
  }
  return false;
}

}  // namespace stadion
