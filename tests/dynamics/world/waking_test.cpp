/// A sleeping body wakes whenever what holds it up changes: each cause against each kind of sleeper.

#include "engine/maths/functions.h"
#include "tests/dynamics/world/watch.h"

#include <functional>
#include <gtest/gtest.h>
#include <string>

namespace stadion {
namespace {

using namespace scenes;

constexpr double kSize = 0.25;  ///< of each sleeper, from its middle to its surface, about [m]
constexpr double kShelf = 2;    ///< height of what holds the sleepers up [m]
constexpr double kGone = 0.3;   ///< a sleeper that is so far from where it slept has noticed [m]
constexpr double kNotices = 1;  ///< time in which it has to [s]

/// What the sleepers lie on.
enum class Carrier { Box, Sheet, Mesh, HeldBody };
constexpr std::array kCarriers{Carrier::Box, Carrier::Sheet, Carrier::Mesh, Carrier::HeldBody};
/// How they lie: one on the carrier, three on top of each other, one that leans sideways on the carrier, two
/// layers of nine.
enum class Lying { Alone, Chain, Leaning, Pile };

std::string nameOf(Carrier c) {
  static constexpr std::array names{"box", "sheet", "mesh", "held body"};
  return names[static_cast<std::size_t>(c)];
}
std::string nameOf(Lying l) {
  static constexpr std::array names{"alone", "chain", "leaning", "pile"};
  return names[static_cast<std::size_t>(l)];
}

/// Sleepers on a shelf over a floor. What leans lies on a ledge, pulled against the shelf, which is upright.
struct Bedroom {
  World w;
  FieldId gravity = 0, lift = 0;
  Carrier carrier;
  ContactSide shelf;
  Pose shelfPose;
  std::vector<BodyId> sleepers;
  std::vector<Vec3> beds;        ///< where they slept
  std::vector<double> farthest;  ///< that each has been from there since [m]
  Nanoseconds now = 0;

  Bedroom(Carrier c, Lying lying, Solid kind, double gravityLasts = 0) : carrier(c) {
    const bool leans = lying == Lying::Leaning;
    ForceField pull;
    pull.law = LinearField{Vec3(leans ? -kG : 0, 0, -kG), LinearField::Unit::Acceleration};
    pull.duration = fromSeconds(gravityLasts);
    gravity = w.addField(pull, true);
    lift = addGravity(w, Vec3(0, 0, 0.4 * kG));
    addFloor(w, 0.5);
    if (leans)
      w.addCollider({w.addShape(BoxShape{{}, Vec3(5, 5, 0.1)}), at({3, 0, kShelf - 0.1}), {0.2, 0.0, 0.0}});
    shelfPose =
        leans ? Pose{{-0.1, 0, kShelf + 0.5}, det::fromEuler(0, M_PI / 2, 0)} : at({0, 0, kShelf - 0.1});
    addShelf();
    const double gap = 0.002, first = kShelf + kSize + gap;
    const int many = lying == Lying::Chain ? 3 : lying == Lying::Pile ? 18 : 1;
    for (int i = 0; i < many; ++i) {
      const Vec3 column(0.55 * (i % 3 - 1), 0.55 * (i / 3 % 3 - 1), first + i / 9 * (2 * kSize + gap));
      const Vec3 p = lying == Lying::Pile    ? column
                     : lying == Lying::Chain ? Vec3(0, 0, first + i * (2 * kSize + gap))
                                             : Vec3(leans ? kSize + gap : 0, 0, first);
      BodyDef d = solidBody(w, kind, kSize, 1);
      if (kind == Solid::Box || kind == Solid::Convex || kind == Solid::Mesh) {
        const Vec3 half = Vec3::Constant(kSize);
        d.mass = massOfBox({}, half, 1).withMass(1);
        if (kind == Solid::Box) d.shape = w.addShape(BoxShape{{}, half});
        if (kind == Solid::Mesh) d.shape = w.addShape(MeshShape(TriangleTree(boxMesh(half))));
      }
      d.pose.p = p, d.surface = {0.5, 0.0, 0.05};
      sleepers.push_back(w.addBody(d));
      w.hook(sleepers.back(), gravity, 0), w.hook(sleepers.back(), lift, 0);
    }
  }
  static Pose at(const Vec3& p) { return {p, Quat::Identity()}; }
  void addShelf() {
    const Vec3 half(1.5, 1.5, 0.1);
    const Surface surface{0.5, 0.0, 0.05};
    if (carrier == Carrier::HeldBody) {
      BodyDef d;
      d.shape = w.addShape(BoxShape{{}, half}), d.mass = massOfBox({}, half, 1).withMass(5);
      d.pose = shelfPose, d.surface = surface;
      shelf = {true, w.addBody(d)};
      w.hook(shelf.id, gravity, 0);
      w.holdBody(shelf.id);
      return;
    }
    PlaneShape sheet;
    sheet.half = Vec2(1.5, 1.5), sheet.pose.p.z() = 0.1;
    const ShapeId shape = carrier == Carrier::Sheet  ? w.addShape(sheet)
                          : carrier == Carrier::Mesh ? w.addShape(MeshShape(TriangleTree(boxMesh(half))))
                                                     : w.addShape(BoxShape{{}, half});
    shelf = {false, w.addCollider({shape, shelfPose, surface})};
  }
  void play(double seconds, const std::function<void()>& each = {}, double rate = 60) {
    const Nanoseconds start = now;
    for (int i = 1; i <= static_cast<int>(seconds * rate + 0.5); ++i) {
      if (each) each();
      const Nanoseconds to = start + fromSeconds(i / rate);
      w.advance(now, to);
      now = to;
      for (std::size_t k = 0; k < beds.size(); ++k)
        farthest[k] = std::max(farthest[k], (w.state(sleepers[k]).p - beds[k]).norm());
    }
  }
  bool asleep() const {
    return std::ranges::all_of(sleepers, [&](BodyId b) { return w.mode(b) == BodyMode::Rest; });
  }
  /// False: they do not fall asleep.
  bool settles() {
    for (int i = 0; i < 40 && !asleep(); ++i) play(0.5);
    for (const BodyId b : sleepers) beds.push_back(w.state(b).p);
    farthest.assign(beds.size(), 0);
    return asleep();
  }
  void moveShelf(const Pose& end, bool jump = false) {
    shelf.isBody ? w.moveHeld(shelf.id, end, jump) : w.moveCollider(shelf.id, end, jump);
    shelfPose = end;
  }
  void pause(double seconds) {
    w.pause(now, now + fromSeconds(seconds));
    now += fromSeconds(seconds);
  }
  /// A hand takes the sleeper, waits until those around it sleep again, and carries it away.
  void takeAway(std::size_t i, double waits) {
    w.holdBody(sleepers[i]);
    play(waits);
    Pose X = w.pose(sleepers[i]);
    play(0.5, [&] { X.p.y() += 0.1, w.moveHeld(sleepers[i], X); });
  }
  /// What the shelf has turned into may be pushed out again to about where it was.
  bool noticed(std::size_t i, double gone = kGone) const { return farthest[i] > gone; }
};

/// What happens to the shelf, to a field, or to the sleeper below another.
struct Cause {
  const char* name;
  std::function<bool(Bedroom&)> happens;  ///< false: it cannot
};

using Room = Bedroom&;

const std::vector<Cause>& causesOnShelf() {
  static const std::vector<Cause> all{
      {"moved aside",
       [](Room r) {
         r.play(0.4, [&] { r.moveShelf({r.shelfPose.p + Vec3(0, 0.2, 0), r.shelfPose.q}); });
         return true;
       }},
      {"lowered slowly",
       [](Room r) {
         const Vec3 away = r.beds[0].x() > 0.1 ? Vec3(-0.01, 0, 0) : Vec3(0, 0, -0.01);
         r.play(0.8, [&] { r.moveShelf({r.shelfPose.p + away, r.shelfPose.q}); });
         return true;
       }},
      {"turned over",
       [](Room r) {
         r.play(0.5, [&] { r.moveShelf({r.shelfPose.p, det::fromEuler(0, 0.1, 0) * r.shelfPose.q}); });
         return true;
       }},
      {"put elsewhere",
       [](Room r) {
         r.moveShelf({r.shelfPose.p + Vec3(0, 9, 0), r.shelfPose.q}, true);
         return true;
       }},
      {"put elsewhere while the show stands still",
       [](Room r) {
         r.pause(0.5);
         r.moveShelf({r.shelfPose.p + Vec3(0, 9, 0), r.shelfPose.q}, true);
         r.pause(0.5);
         return true;
       }},
      {"disabled",
       [](Room r) {
         return r.shelf.isBody ? r.w.enableBody(r.shelf.id, false) : r.w.enableCollider(r.shelf.id, false);
       }},
      {"removed",
       [](Room r) { return r.shelf.isBody ? r.w.removeBody(r.shelf.id) : r.w.removeCollider(r.shelf.id); }},
      {"let go",
       [](Room r) { return r.shelf.isBody && r.w.releaseBody(r.shelf.id, Vec3::Zero(), Vec3::Zero()); }},
      {"thrown away",
       [](Room r) {
         return r.shelf.isBody && r.w.releaseBody(r.shelf.id, {0, 9, 0}, Vec3::Zero());
       }},
      {"reset to another place",
       [](Room r) {
         return r.shelf.isBody &&
                r.w.placeBody(r.shelf.id, Bedroom::at({0, 50, 50}), Vec3::Zero(), Vec3::Zero());
       }},
      {"no longer seen",
       [](Room r) {
         for (const BodyId b : r.sleepers) r.w.ignorePair(r.shelf, {true, b}, true);
         return true;
       }},
      {"a body, and bodies no longer collide",
       [](Room r) { return r.shelf.isBody && (r.w.setBodiesCollide(false), true); }},
  };
  return all;
}

/// The lift alone carries them away.
const std::vector<Cause>& causesOnFields() {
  static const std::vector<Cause> all{
      {"switched off", [](Room r) { return r.w.switchField(r.gravity, false, r.now); }},
      {"switched off later", [](Room r) { return r.w.switchField(r.gravity, false, r.now + 123'456'789); }},
      {"unhooked",
       [](Room r) {
         for (const BodyId b : r.sleepers) r.w.unhook(b, r.gravity, r.now);
         return true;
       }},
      {"removed", [](Room r) { return r.w.removeField(r.gravity); }},
      {"turned over",
       [](Room r) {
         const Pose X{{}, det::fromEuler(0, M_PI, 0)};
         return r.w.moveField(r.gravity, X, X);
       }},
      {"turned over in the course of a frame",
       [](Room r) {
         return r.w.moveField(r.gravity, Pose{}, {{}, det::fromEuler(0, M_PI, 0)});
       }},
      {"made weaker", [](Room r) { return r.w.setFieldStrength(r.gravity, 0.1, 0.1); }},
      {"scaled",
       [](Room r) {
         return r.w.setFieldLaw(r.lift, LinearField{Vec3(0, 0, 3 * kG), LinearField::Unit::Acceleration});
       }},
      {"changed while the show stands still",
       [](Room r) {
         r.pause(0.5);
         return r.w.setFieldStrength(r.gravity, 0.1, 0.1);
       }},
      {"joined by another",
       [](Room r) {
         const FieldId more = addGravity(r.w, Vec3(0, 0, 2 * kG));
         for (const BodyId b : r.sleepers) r.w.hook(b, more, r.now);
         return true;
       }},
  };
  return all;
}

/// The first of them goes; the one over it falls.
const std::vector<Cause>& causesOnTheLower() {
  static const std::vector<Cause> all{
      {"taken away", [](Room r) { return r.takeAway(0, 0), true; }},
      {"taken away after a while", [](Room r) { return r.takeAway(0, 2), true; }},
      {"put elsewhere",
       [](Room r) {
         return r.w.placeBody(r.sleepers[0], Bedroom::at({0, 60, 9}), {0, 0, 0}, {0, 0, 0});
       }},
      {"put elsewhere by the hand",
       [](Room r) {
         r.w.holdBody(r.sleepers[0]);
         r.play(2);
         return r.w.moveHeld(r.sleepers[0], Bedroom::at({0, 60, 9}), true);
       }},
      {"disabled", [](Room r) { return r.w.enableBody(r.sleepers[0], false); }},
      {"removed", [](Room r) { return r.w.removeBody(r.sleepers[0]); }},
      {"pushed away",
       [](Room r) {
         return r.w.push(r.sleepers[0], {0, 30, 0}, r.beds[0]);
       }},
      {"pulled away by a field of its own",
       [](Room r) {
         const FieldId wind = addGravity(r.w, Vec3(0, 5 * kG, 0));
         return r.w.hook(r.sleepers[0], wind, r.now);
       }},
      {"pulled away by a field that grows",
       [](Room r) {
         const FieldId wind = addGravity(r.w, Vec3(0, 8 * kG, 0));
         r.w.hook(r.sleepers[0], wind, r.now);
         double strength = 0;
         r.play(0.5, [&] { r.w.setFieldStrength(wind, strength, strength + 0.05), strength += 0.05; });
         return true;
       }},
  };
  return all;
}

struct Tried {
  int cells = 0, restless = 0;
  std::string hanging;
};

/// Every `of`th cause, from another one on for each arrangement.
struct Share {
  std::size_t of = 1, next = 0;
};

/// From the sleeper `first` on, all are to notice: those on the shelf move by about kGone, those on another
/// sleeper by most of its height.
void tryAll(const std::vector<Cause>& causes, Carrier c, Lying l, Solid s, std::size_t first, Share& share,
            Tried& tried) {
  const std::size_t offset = share.next++;
  for (std::size_t k = offset % share.of; k < causes.size(); k += share.of) {
    const Cause& cause = causes[k];
    Bedroom room(c, l, s);
    if (!room.settles()) {
      ++tried.restless;
      return;
    }
    // What leans sideways may find a new hold near the old one.
    const double onShelf = l == Lying::Leaning ? 0.3 * kGone : kGone;
    const double gone =
        first > 0 ? std::min(kGone, 0.8 * (room.beds[first] - room.beds[first - 1]).norm()) : onShelf;
    if (!cause.happens(room)) continue;
    room.play(kNotices);
    ++tried.cells;
    std::size_t hang = 0;
    const std::size_t last = l == Lying::Chain && first > 0 ? 2 : room.sleepers.size();
    for (std::size_t i = first; i < last; ++i) hang += !room.noticed(i, gone);
    if (hang > 0)
      tried.hanging += nameOf(c) + ", " + nameOf(l) + ", " + scenes::nameOf(s) + ": " + cause.name + ": " +
                       std::to_string(hang) + " hang\n";
  }
}

void tryShelf(Carrier c, Share& share, Tried& tried) {
  for (const Lying l : {Lying::Alone, Lying::Chain, Lying::Leaning})
    for (const Solid s : kSolids)
      if (l != Lying::Chain || s == Solid::Ball || s == Solid::Box || s == Solid::Mesh)
        tryAll(causesOnShelf(), c, l, s, 0, share, tried);
}

void tryPiles(Carrier c, Share& share, Tried& tried) {
  for (const Solid s : {Solid::Ball, Solid::Box}) tryAll(causesOnShelf(), c, Lying::Pile, s, 0, share, tried);
}

void tryFields(Share& share, Tried& tried) {
  for (const Lying l : {Lying::Alone, Lying::Chain})
    for (const Solid s : kSolids)
      if (l == Lying::Alone || s == Solid::Ball || s == Solid::Box)
        tryAll(causesOnFields(), Carrier::Box, l, s, 0, share, tried);
  tryAll(causesOnFields(), Carrier::Box, Lying::Pile, Solid::Box, 0, share, tried);
}

void tryTheLower(Share& share, Tried& tried) {
  for (const Solid s : {Solid::Ball, Solid::Box, Solid::Cylinder, Solid::Mesh})
    tryAll(causesOnTheLower(), Carrier::Box, Lying::Chain, s, 1, share, tried);
}

class WakingOn : public testing::TestWithParam<Carrier> {};

INSTANTIATE_TEST_SUITE_P(EachCarrier, WakingOn, testing::ValuesIn(kCarriers), [](const auto& each) {
  std::string name = nameOf(each.param);
  std::erase(name, ' ');
  return name;
});

TEST_P(WakingOn, SleepersNoticeWhateverHappensToTheirCarrier) {
  Tried tried;
  Share share{8, static_cast<std::size_t>(GetParam())};
  tryShelf(GetParam(), share, tried);
  EXPECT_EQ(tried.hanging, "");
  EXPECT_GE(tried.cells, 12);
  EXPECT_LE(tried.restless, 1);
}

TEST_P(WakingOn, PilesNoticeWhateverHappensToTheirCarrier) {
  Tried tried;
  Share share{8, static_cast<std::size_t>(GetParam())};
  tryPiles(GetParam(), share, tried);
  EXPECT_EQ(tried.hanging, "");
  EXPECT_GE(tried.cells, 2);
  EXPECT_EQ(tried.restless, 0);
}

TEST(Waking, FieldsThatChangeWakeTheirSleepers) {
  Tried tried;
  Share share{5};
  tryFields(share, tried);
  EXPECT_EQ(tried.hanging, "");
  EXPECT_GE(tried.cells, 14);
  EXPECT_EQ(tried.restless, 0);
}

TEST(Waking, ASleeperFallsWhateverHappensToTheOneBelow) {
  Tried tried;
  Share share{4};
  tryTheLower(share, tried);
  EXPECT_EQ(tried.hanging, "");
  EXPECT_GE(tried.cells, 8);
  EXPECT_EQ(tried.restless, 0);
}

TEST(ProgramFullWaking, EachCauseWakesEachArrangement) {
  Tried tried;
  Share share;
  for (const Carrier c : kCarriers) tryShelf(c, share, tried), tryPiles(c, share, tried);
  tryFields(share, tried);
  tryTheLower(share, tried);
  EXPECT_EQ(tried.hanging, "");
  EXPECT_GE(tried.cells, 600);
  EXPECT_LE(tried.restless, 4);
}

TEST(Waking, AFieldsDurationEndsSleep) {
  for (const Solid s : kSolids) {
    Bedroom room(Carrier::Box, Lying::Alone, s, 5);
    ASSERT_TRUE(room.settles()) << scenes::nameOf(s);
    ASSERT_LT(room.now, 4'900'000'000);
    room.play(5 - toSeconds(room.now) + kNotices);
    EXPECT_TRUE(room.noticed(0)) << scenes::nameOf(s);
  }
}

TEST(Waking, BodiesThatNoLongerCollideFallThroughEachOther) {
  for (const Lying l : {Lying::Chain, Lying::Pile})
    for (const Solid s : {Solid::Ball, Solid::Box, Solid::Mesh}) {
      SCOPED_TRACE(nameOf(l) + " of " + scenes::nameOf(s));
      Bedroom room(Carrier::Box, l, s);
      ASSERT_TRUE(room.settles());
      room.w.setBodiesCollide(false);
      room.play(kNotices);
      const std::size_t lowest = l == Lying::Chain ? 1 : 9;
      for (std::size_t i = lowest; i < room.sleepers.size(); ++i)
        EXPECT_NEAR(room.w.pose(room.sleepers[i]).p.z(), room.beds[0].z(), 1e-3) << i;
      for (std::size_t i = 0; i < lowest; ++i) EXPECT_LT(room.farthest[i], 1e-4) << i;
    }
}

TEST(Waking, OneTakenFromAPileWakesThoseOnIt) {
  for (const Solid s : {Solid::Ball, Solid::Box})
    for (const double waits : {0.0, 2.0}) {
      Bedroom room(Carrier::Box, Lying::Pile, s);
      ASSERT_TRUE(room.settles());
      room.w.holdBody(room.sleepers[4]);
      room.play(waits);
      Pose X = room.w.pose(room.sleepers[4]);
      room.play(0.5, [&] { X.p.z() -= 0.1, room.w.moveHeld(room.sleepers[4], X); });
      room.play(2);
      EXPECT_TRUE(room.noticed(13)) << scenes::nameOf(s) << " after " << waits << " s";
    }
}

/// A hand that carries a tray with sleepers: they go along, and sleep again when it stands.
TEST(Waking, SleepersOnATrayGoAlongAndSleepAgain) {
  for (const Solid s : kSolids) {
    Bedroom room(Carrier::HeldBody, Lying::Alone, s);
    ASSERT_TRUE(room.settles()) << scenes::nameOf(s);
    room.play(1, [&] { room.moveShelf({room.shelfPose.p + Vec3(0, 0, 0.01), room.shelfPose.q}); });
    EXPECT_NEAR(room.w.state(room.sleepers[0]).p.z(), room.beds[0].z() + 0.6, 0.02) << scenes::nameOf(s);
    room.play(3);
    EXPECT_TRUE(room.asleep()) << scenes::nameOf(s);
  }
}

}  // namespace
}  // namespace stadion
