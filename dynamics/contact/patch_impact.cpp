#include "dynamics/contact/patch_impact.h"

#include "dynamics/collision/touch_seams.h"
#include "dynamics/contact/contact_area.h"
#include "dynamics/contact/contact_solver.h"
#include "dynamics/shapes/convex_core.h"

#include <algorithm>

namespace stadion {
namespace {

constexpr double kSameImpact = 1e-5;  ///< way that the last point of an impact has still to go [m]
constexpr double kSoon = 1e-4;        ///< and time [s]
constexpr double kSameSide = 0.99;    ///< cosine between the normals of its points

bool strikesWithAPoint(const Side& s, const SolverBody& m, const Vec3& n) {
  ConvexCore core;
  const Pose turned{Vec3::Zero(), s.body ? Quat(m.q * s.body->X_CN.q) : m.q};
  return isConvex(*s.shape) && coreOf(*s.shape, turned, core) && pointed(core, n, kSameImpact);
}

double closing(const SolverBody& a, const SolverBody& b, const Gap& g) {
  return g.normal.dot(b.velocityAt(g.point) - a.velocityAt(g.point));
}

/// The points at which two solids strike together, and what they push.
class FlatLanding {
public:
  /// What the points of one side push.
  struct Push {
    Vec3 impulse = Vec3::Zero(), arm = Vec3::Zero();
    double pushed = 0;  ///< along the normals [N s]
  };

  FlatLanding(const Side& a, double tau, const Gap& first, const SolverBody& ma, const SolverBody& mb)
      : a_(a), tau_(tau), first_(first), ma_(ma), mb_(mb) {}

  /// Looks for points that may strike `side`, whose part is null for the first side.
  void gather(const Side& side, PatchSide* part, double bounce, double grip);
  /// Chooses those that strike with the first one, after all sides have been gathered.
  void choose();
  std::size_t size() const { return contacts_.size(); }
  /// Adds the friction over the areas between the points of `side`.
  void flatten(const Side& side, PatchSide* part, double grip);
  bool solve();
  /// Sums up one side after solve(). Every side is asked for once.
  Push pushOf(const PatchSide* part);
  /// Whether all sides together push, and add no energy.
  bool isSound() const { return !(work_ > 0 || !(pushed_ > 0)); }
  const std::vector<SolverBody>& after() const { return after_; }
  /// The place about which the push acts.
  Vec3 middleOf(const Push& push) const {
    return push.pushed > 0 ? Vec3(ma_.p + push.arm / push.pushed) : first_.point;
  }

private:
  struct Strike {
    PatchSide* part;
    double bounce, grip;
  };

  const Side& a_;
  double tau_;
  const Gap& first_;
  const SolverBody &ma_, &mb_;              ///< before the impact
  std::vector<SolverBody> before_, after_;  ///< of solve()
  std::vector<ManifoldPoint> points_;       ///< gather()'s own
  std::vector<Bearing> near_;               ///< what has been gathered
  std::vector<Strike> strikes_;             ///< the same, by point
  std::vector<SolverContact> contacts_;
  std::vector<PatchSide*> whose_;   ///< by contact; null: the first side's
  std::vector<Gap> gaps_;           ///< by point
  std::vector<FlatContact> flats_;  ///< own the areas
  double work_ = 0, pushed_ = 0;
};

void FlatLanding::gather(const Side& side, PatchSide* part, double bounce, double grip) {
  manifold(a_, side, tau_, std::max(first_.distance, 0.0) + kSameImpact, points_);
  for (const ManifoldPoint& p : points_) {
    near_.push_back({side.key, side.shape, side.at(tau_).pose, p.gap});
    strikes_.push_back({part, bounce, grip});
  }
}

void FlatLanding::choose() {
  // A scheme of steps reports a touch early. The others are as far away then, and strike with the first one.
  const double early = first_.distance > kSameImpact ? first_.distance : 0;
  const std::vector<char> hidden = hiddenAmong(near_);
  for (std::size_t i = 0; i < near_.size(); ++i) {
    const Gap& gap = near_[i].gap;
    const Strike& strike = strikes_[i];
    const double comes = closing(ma_, mb_, gap);
    if ((!hidden.empty() && hidden[i]) || gap.normal.dot(first_.normal) < kSameSide ||
        !(gap.distance - early < kSoon * comes))
      continue;
    SolverContact c;
    c.b = 1;
    c.placeAt(gap.point, gap.normal, ma_.p, mb_.p);
    c.friction = strike.grip;
    c.floor = strike.bounce * comes;
    contacts_.push_back(c);
    whose_.push_back(strike.part);
    gaps_.push_back(gap);
    if (strike.part) strike.part->closing = std::max(strike.part->closing, comes);
  }
}

void FlatLanding::flatten(const Side& side, PatchSide* part, double grip) {
  const auto begin = static_cast<std::size_t>(std::ranges::find(whose_, part) - whose_.begin());
  const auto count = static_cast<std::size_t>(std::ranges::count(whose_, part));
  if (!(grip > 0) || count < 3) return;
  for (FlatContact& flat : flatContacts(a_, {&side, 1}, tau_, std::span(gaps_).subspan(begin, count))) {
    SolverContact c;
    c.b = 1;
    c.friction = grip;
    c.area = flat.area.get();
    c.placeAt(flat.plane.origin, flat.plane.n, ma_.p, mb_.p);
    for (const std::uint32_t k : flat.points)
      contacts_[begin + k].patch = static_cast<std::int32_t>(contacts_.size());
    contacts_.push_back(c);
    whose_.push_back(part);
    flats_.push_back(std::move(flat));
  }
}

bool FlatLanding::solve() {
  after_ = {ma_, mb_};
  if (!solveContacts(after_, contacts_)) return false;
  before_ = {ma_, mb_};
  return true;
}

FlatLanding::Push FlatLanding::pushOf(const PatchSide* part) {
  Push sum;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    if (whose_[i] != part) continue;
    const SolverContact& c = contacts_[i];
    work_ += 0.5 * c.impulse.dot(c.velocity(before_) + c.velocity(after_));
    if (c.area) {
      sum.impulse += c.push.rightCols<2>() * c.impulse.tail<2>();
      continue;
    }
    sum.impulse += c.push * c.impulse;
    sum.arm += c.impulse[0] * c.pushA;
    sum.pushed += c.impulse[0];
  }
  pushed_ += sum.pushed;
  return sum;
}

}  // namespace

std::optional<PatchImpact> collidePatch(const Side& a, const Side& b, double tau, const Gap& first,
                                        SolverBody& ma, SolverBody& mb, double restitution, double friction,
                                        std::vector<PatchSide>& beside) {
  if (!(closing(ma, mb, first) > 0) || strikesWithAPoint(a, ma, first.normal) ||
      strikesWithAPoint(b, mb, first.normal))
    return {};
  FlatLanding landing(a, tau, first, ma, mb);
  landing.gather(b, nullptr, restitution, friction);
  for (PatchSide& part : beside) {
    part.closing = 0;
    landing.gather(part.side, &part, part.restitution, part.friction);
  }
  landing.choose();
  if (landing.size() < 2) return {};
  landing.flatten(b, nullptr, friction);
  for (PatchSide& part : beside) landing.flatten(part.side, &part, part.friction);
  if (!landing.solve()) return {};
  const FlatLanding::Push own = landing.pushOf(nullptr);
  for (PatchSide& part : beside) {
    const FlatLanding::Push push = landing.pushOf(&part);
    part.impulse = push.impulse;
    part.middle = landing.middleOf(push);
  }
  if (!landing.isSound()) return {};
  const PatchImpact result{own.impulse, landing.middleOf(own)};
  ma = landing.after()[0];
  mb = landing.after()[1];
  return result;
}

}  // namespace stadion
