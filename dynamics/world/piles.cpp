#include "dynamics/world/piles.h"

#include "dynamics/world/pile_step.h"

#include <algorithm>
#include <cmath>

namespace stadion {

namespace {

constexpr double kParted = 1e-3;          ///< a pair that touched counts as touching up to this gap [m]
constexpr std::size_t kContactsEach = 6;  ///< space for so many of each member is made at once
constexpr std::size_t kLeast = 4;         ///< a smaller pile dissolves
constexpr double kLeaving = 0.1;          ///< least speed of a body that may leave a pile for good [m/s]
constexpr double kQuietWay = 1.2e-3;      ///< a surface point that stays within this is quiet [m]
constexpr double kQuietTime = 0.3;        ///< before a body sleeps among quiet ones [s]
constexpr double kWaking = 1e-9;          ///< quiet time of a body that has been woken softly [s]

bool in(const std::vector<ContactSide>& list, ContactSide p) {
  return std::find(list.begin(), list.end(), p) != list.end();
}
/// The points of a pair come one after the other.
void note(std::vector<ContactSide>& list, ContactSide p) {
  if (list.empty() || list.back() != p) list.push_back(p);
}

/// The contacts of each member, one after the other.
struct ContactLists {
  std::vector<std::uint32_t> begin, of;
  explicit ContactLists(const Pile& pile) : begin(pile.members + 1, 0) {
    for (const PileContact& c : pile.contacts) {
      ++begin[c.a + 1];
      if (c.b < pile.members) ++begin[c.b + 1];
    }
    for (std::size_t i = 0; i < pile.members; ++i) begin[i + 1] += begin[i];
    of.resize(begin.back());
    std::vector<std::uint32_t> next = begin;
    for (std::uint32_t k = 0; k < pile.contacts.size(); ++k) {
      const PileContact& c = pile.contacts[k];
      of[next[c.a]++] = k;
      if (c.b < pile.members) of[next[c.b]++] = k;
    }
  }
};

constexpr std::size_t kPile = 16;         ///< islands of so many bodies become a pile
constexpr std::size_t kRestlessPile = 5;  ///< the same if they are not solved exactly

/// How long each member has hardly moved; whether it is time to sleep for those among their like.
std::vector<char> sleepCandidates(const PileStep& step) {
  const Pile& pile = step.pile;
  const std::size_t n = pile.members;
  std::vector<char> calm(n, 1);
  for (std::size_t i = 0; i < n; ++i) {
    RigidBody& b = *step.members[i].body;
    const PileBody &start = pile.start[i], &end = pile.bodies[i];
    b.contact.drift += pile.shift[i] + 0.5 * pile.h * (start.v + end.v);
    b.contact.twist += 0.5 * pile.h * (start.omega + end.omega);
    b.contact.quietTime += pile.h;
    if (b.contact.drift.norm() + b.contact.twist.norm() * b.reach > kQuietWay) {
      b.contact.quietTime = 0;
      b.contact.drift.setZero();
      b.contact.twist.setZero();
    }
    calm[i] = b.contact.quietTime >= kQuietTime;
  }
  std::vector<char> may = calm;
  for (const PileContact& c : pile.contacts) {
    if (c.b < n) {
      may[c.a] = may[c.a] && calm[c.b];
      may[c.b] = may[c.b] && calm[c.a];
    } else {
      const PileBody& fixed = pile.bodies[c.b];
      may[c.a] = may[c.a] && fixed.v.isZero(0) && fixed.omega.isZero(0);
    }
  }
  return may;
}

}  // namespace

void Piles::join(RigidBody& b, PileStep& step) {
  const double tau = step.tau;
  if (!b.contact.inPile) {
    const double quiet = b.mode == BodyMode::Rest ? kWaking : b.contact.quietTime;
    waking_.enterContact(b, tau);
    if (b.mode != BodyMode::Contact) return;
    b.contact.inPile = true;
    b.contact.unsolved = false;
    b.contact.quietTime = quiet;
    b.contact.dueAge = 0;
    b.contact.drift.setZero();
    b.contact.twist.setZero();
  }
  PileStep::Member m;
  PileBody c;
  m.body = &b;
  m.p = b.position(tau);
  m.round = b.centred;
  m.bound = b.bound.radius;
  m.middle = m.round ? m.p : Vec3(b.poseAt(tau) * b.bound.centre);
  const Vec3 L = b.angularMomentum(tau);
  c.v = b.velocity(tau);
  c.inverseMass = b.inverseMass;
  Mat3 inverse = Mat3::Zero();
  if (m.round && b.inertia.x() == b.inertia.y() && b.inertia.y() == b.inertia.z()) {
    c.roundInertia = 1 / b.inertia.x();
    c.omega = c.roundInertia * L;
  } else {
    m.round = false;
    const Mat3 R = b.orientation(tau).toRotationMatrix();
    inverse = R * b.inertia.cwiseInverse().asDiagonal() * R.transpose();
    c.omega = inverse * L;
  }
  m.way = step.pile.h * (c.v.norm() + (m.round ? 0 : c.omega.norm() * b.reach));
  b.contact.slot = static_cast<std::uint32_t>(step.members.size());
  step.members.push_back(m);
  step.pile.bodies.push_back(c);
  step.pile.inverseInertia.push_back(inverse);
}

/// What the member leans on, and the forces as a guess for the next step. False if nothing is near.
bool Piles::noteNeighbours(const PileStep& step, std::size_t i, std::span<const std::uint32_t> list,
                           std::vector<ContactSide>& near) {
  const Pile& pile = step.pile;
  RigidBody& b = *step.members[i].body;
  b.contact.touching.clear();
  b.contact.warmStarts.clear();
  near.clear();
  for (const std::uint32_t k : list) {
    const PileContact& c = pile.contacts[k];
    const bool first = c.a == i;
    const ContactSide other = first ? step.notes[k].other : ContactSide{true, step.members[c.a].body->id};
    note(b.contact.touching, other);
    if (c.gap < kTouching || (c.gap < kParted && in(b.contact.leaning, other))) note(near, other);
    if (!(c.pressed > 0)) continue;
    const Vec3 force = (c.pressed * c.n + c.tangential) / pile.h;
    const std::uint64_t key = first ? step.notes[k].key : step.notes[k].reverse;
    b.contact.warmStarts.push_back({key, first ? force : Vec3(-force), pile.h});
  }
  std::ranges::sort(near);
  if (near != b.contact.leaning) {
    const std::vector<ContactSide> left = b.contact.leaning;
    rememberTouching(memory_, b, near);
    for (const ContactSide p : left)  // a body that leaned on it may fall now
      if (p.isBody && !in(near, p))
        if (RigidBody* o = objects_.body(p.id); o && o->mode == BodyMode::Rest)
          waking_.enterContact(*o, step.tau);
  }
  return !list.empty();
}

/// The member's arc of the step.
void Piles::follow(const PileStep& step, std::size_t i) {
  const Pile& pile = step.pile;
  const double tau = step.tau, h = pile.h;
  RigidBody& b = *step.members[i].body;
  const PileBody &start = pile.start[i], &end = pile.bodies[i];
  const Quat q = b.orientation(tau);
  const double quiet = b.contact.quietTime;
  const Path path = Path::parabola(step.members[i].p + pile.shift[i], start.v, (end.v - start.v) / h);
  if (step.members[i].round) {
    const Vec3 alpha = (end.omega - start.omega) / h;
    arcs_.setArc(b, tau, path,
                 alpha.isZero(0) ? Spin::free(q, start.omega / start.roundInertia, b.inertia)
                                 : Spin::driven(q, start.omega, alpha, b.inertia.x()),
                 h, BodyMode::Contact);
    b.contact.endL = end.omega / end.roundInertia;
  } else {
    const auto momentum = [&](const Vec3& omega) {
      return Vec3(q * b.inertia.cwiseProduct(q.conjugate() * omega));
    };
    const Vec3 L0 = momentum(start.omega), L1 = momentum(end.omega);
    arcs_.setArc(b, tau, path, Spin::free(q, 0.5 * (L0 + L1), b.inertia), h, BodyMode::Contact);
    b.contact.endL = L1;
  }
  if (b.mode == BodyMode::Contact) {
    b.contact.dueAge = h;
    b.contact.quietTime = quiet;
  }
}

/// Arcs of the step, and which members may sleep.
void Piles::conclude(PileStep& step) {
  const Pile& pile = step.pile;
  const double tau = step.tau;
  const ContactLists lists(pile);
  const std::vector<char> may = sleepCandidates(step);
  std::vector<ContactSide> near;
  for (std::size_t i = 0; i < pile.members; ++i) {
    RigidBody& b = *step.members[i].body;
    const std::span list(lists.of.data() + lists.begin[i], lists.begin[i + 1] - lists.begin[i]);
    if (!noteNeighbours(step, i, list, near)) {
      const Quat q = b.orientation(tau);
      const Vec3 L = b.angularMomentum(tau);
      waking_.wakeOnto({true, b.id}, tau);
      arcs_.startFlight(b, tau, step.members[i].p, pile.start[i].v, q, L);
      foresight_.predict(b, tau);
      continue;
    }
    follow(step, i);
    if (b.mode != BodyMode::Contact) continue;
    b.contact.sleepsNext = may[i] != 0;  // not at once: the others' motion counts on its own
    boxes_.sweep(b, tau);
  }
}

/// Too few are left: they go on as an island. (Not those that hardly move: an island takes overlap back
/// whether or not their motion pays for it.)
void Piles::dissolve(const std::vector<RigidBody*>& due, double tau) {
  for (RigidBody* b : due) {
    const Vec3 L = b->angularMomentum(tau);
    if (b->contact.dueAge > 0)
      arcs_.setArc(*b, tau, Path::parabola(b->position(tau), b->velocity(tau), Vec3::Zero()),
                   Spin::free(b->orientation(tau), L, b->inertia), grid_.islandStep(), BodyMode::Contact);
    b->contact.inPile = false;
    b->contact.endL = L;
  }
}

/// One step of all members of piles, to the next time on the grid of piles.
void Piles::advance(double tau) {
  PileStep step;
  step.tau = tau;
  Pile& pile = step.pile;
  pile.h = grid_.untilPileStep(time_.instantAt(tau));
  std::vector<RigidBody*> due;
  for (RigidBody* b : active_) {
    b->contact.slot = PileStep::kNone;
    if (b->contact.inPile && b->enabled && b->contact.dueAge <= b->age(tau) + kSameTime) due.push_back(b);
  }
  std::ranges::sort(due, {}, &RigidBody::id);
  for (RigidBody* b : due)
    if (b->contact.sleepsNext) {
      arcs_.freeze(*b, tau);
      foresight_.predict(*b, tau);
    }
  std::erase_if(due, [](const RigidBody* b) { return b->mode != BodyMode::Contact; });
  if (due.empty()) return;
  const auto leaves = [&](const RigidBody* b) { return b->velocity(tau).norm() > kLeaving; };
  if (due.size() < kLeast && std::ranges::any_of(due, leaves) && !isPile(due, tau)) return dissolve(due, tau);
  for (RigidBody* b : due) join(*b, step);
  const std::size_t contacts = kContactsEach * due.size();
  pile.contacts.reserve(contacts);
  step.notes.reserve(contacts);
  step.points.reserve(contacts);
  for (std::size_t i = 0; i < step.members.size(); ++i) findContacts(*step.members[i].body, step);
  pile.members = step.members.size();
  linkContacts(step);
  pile.pull.resize(pile.members);
  for (std::size_t i = 0; i < pile.members; ++i) {
    const RigidBody& b = *step.members[i].body;
    pile.pull[i] = fields_.accelerationAt(b, step.members[i].p, pile.bodies[i].v, tau);
    if (b.damping > 0) pile.bodies[i].v *= det::exp(-b.damping * pile.h);
  }
  solvePile(pile);
  conclude(step);
}

/// Returns true if an island is better off as a pile: it is large, not solved exactly, or its balls are in
/// the thick of it.
bool Piles::isPile(const std::vector<RigidBody*>& island, double tau) {
  const bool balls = std::ranges::all_of(island, [](const RigidBody* b) { return b->isBall(); });
  // Thin meshes would sink through each other in a pile's longer steps.
  const bool restless = std::ranges::any_of(island, [](const RigidBody* b) { return b->contact.unsolved; }) &&
                        std::ranges::none_of(island, [](const RigidBody* b) {
                          return std::holds_alternative<MeshShape>(*b->shape);
                        });
  if (island.size() >= (balls ? kPileOfBalls : restless ? kRestlessPile : kPile)) return true;
  return balls && std::ranges::any_of(island, [&](const RigidBody* b) {
           return foresight_.ballsAround(*b, tau) + 1 >= kPileOfBalls;
         });
}

}  // namespace stadion
