/// What hosts of a cluster make of messages that no host sends, or sends late.

#include "engine/input/scripted_input.h"
#include "pipeline/cluster/cluster_leader.h"
#include "pipeline/cluster/follower.h"
#include "tests/pipeline/cluster/unconnected_follower.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>

namespace stadion::cluster {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

InputSample visitor() {
  InputSample input;
  for (const char* name : {"head", "wand"}) {
    TrackerSample& t = input.trackers.emplace_back();
    t.name = name, t.X_RT.p = Vec3(0, 0, 1.7), t.stamp = 900'000'000;
    t.knots = {{950'000'000, t.X_RT, false}, {960'000'000, t.X_RT, true}};
    t.controls = {{950'000'000, 1, {}}};
  }
  return input;
}

/// Whether an order is obeyed after `damage` has been done to it.
template <class Damage>
bool isObeyed(const Damage& damage) {
  FrameOrder order;
  order.signature = signatureAt(60, 60);
  InputSample input = visitor();
  damage(order, input);
  WrittenOrder written;
  return readOrder(written.write({1, 1, 3, 0}, order, &input)).has_value();
}

TEST(ClusterHearing, AnOrderThatSaysWhatCannotBeIsNone) {
  using Input = InputSample;
  EXPECT_TRUE(isObeyed([](FrameOrder&, Input&) {}));
  EXPECT_FALSE(isObeyed([](FrameOrder&, Input& i) { i.trackers[0].X_RT.p.x() = kNan; }));
  EXPECT_FALSE(isObeyed([](FrameOrder&, Input& i) { i.trackers[1].X_RT.p.y() = 1e300; }));
  EXPECT_FALSE(isObeyed([](FrameOrder&, Input& i) { i.trackers[0].X_RT.q.coeffs().setZero(); }));
  EXPECT_FALSE(isObeyed([](FrameOrder&, Input& i) { i.trackers[0].knots[1].X.p.z() = kNan; }));
  EXPECT_FALSE(isObeyed([](FrameOrder&, Input& i) { i.trackers[0].knots[0].time = 970'000'000; }));
  EXPECT_FALSE(isObeyed([](FrameOrder&, Input& i) { i.trackers[0].controls[0].time = -1; }));
  EXPECT_FALSE(isObeyed([](FrameOrder&, Input& i) { i.trackers[0].axes[7] = static_cast<float>(kNan); }));
  EXPECT_FALSE(isObeyed([](FrameOrder&, Input& i) { i.trackers[1].name = "head"; }));
  EXPECT_FALSE(isObeyed([](FrameOrder& o, Input&) { o.signature.time = -1; }));
  EXPECT_FALSE(isObeyed([](FrameOrder& o, Input&) { o.signature.step = o.signature.time + 1; }));
  EXPECT_FALSE(isObeyed([](FrameOrder& o, Input&) { o.presentation.eyeSeparation = kNan; }));
}

TEST(ClusterHearing, ASessionWithoutARateIsNotJoined) {
  for (const double rate : {kNan, 0.0, -60.0, 1e9}) {
    const auto f = follower();
    f->receive(session(rate, false));
    EXPECT_FALSE(f->join()) << rate;
  }
  const auto f = follower();
  f->receive(session(60, false));
  EXPECT_TRUE(f->join());
}

TEST(ClusterHearing, AfterAnOrderThatIsNoneOneIsMissing) {
  const auto f = follower();
  f->receive(session(60, false));
  ASSERT_TRUE(f->join());
  WrittenOrder written;
  InputSample input = visitor();
  FrameOrder order;
  order.signature = signatureAt(60, 60);
  f->receive(written.write({1, 1, 3, 0}, order, &input));
  EXPECT_TRUE(f->next());
  input.trackers[0].X_RT.p.x() = kNan;
  f->receive(written.write({1, 2, 3, 0}, order, &input));
  input = visitor();
  f->receive(written.write({1, 3, 3, 0}, order, &input));
  EXPECT_FALSE(f->next());
  EXPECT_TRUE(f->mustRejoin());
}

TEST(ClusterHearing, AStateArrivesInParts) {
  const auto f = follower();
  f->receive(session(60, true));
  std::vector<std::uint8_t> bytes(10, 3);
  StatePart part{};
  part.to = 7, part.session = 1, part.serial = 4, part.size = 2 * bytes.size();
  part.bytes._buffer = bytes.data(), part.bytes._length = part.bytes._maximum = 10;
  f->receive(part);
  part.size = 25, part.offset = 10;
  f->receive(part);  // of another size: not a part of it
  part.size = 20, part.offset = 5;
  f->receive(part);  // not the next one
  part.offset = 10;
  f->receive(part);
  const auto joining = f->join();
  ASSERT_TRUE(joining);
  EXPECT_EQ(*joining->state, std::vector<std::uint8_t>(20, 3));
}

TEST(ClusterHearing, ASceneThatNoHostHasTakenGivesWayToANewerOne) {
  std::vector<std::uint8_t> bytes(10, 3);
  StatePart part{};
  part.to = 7, part.session = 1, part.serial = 4, part.size = 10;
  part.bytes._buffer = bytes.data(), part.bytes._length = part.bytes._maximum = 10;
  IncomingScene scene;
  scene.add(part);
  ASSERT_TRUE(scene.complete());
  part.serial = 9;
  scene.add(part);
  EXPECT_TRUE(scene.complete());
  EXPECT_EQ(scene.serial(), 9U);
}

/// A host that plays has a scene of that session, after that order.
Presence said(std::uint8_t node, std::uint64_t incarnation, std::uint64_t count, std::uint64_t session,
              std::uint8_t phase, std::uint64_t serial, bool plays, std::uint64_t show) {
  return {node, incarnation, count, 0, session, phase, plays ? session : 0, serial, show};
}

/// Of the show that these lead.
const std::uint64_t kShow = CompatibilityKey{1}.show();

constexpr std::uint64_t kSession = 100;

/// One that gives up after two minutes: a test in which it waits at all takes as long.
std::unique_ptr<ClusterLeader> lead() {
  using Clock = std::chrono::steady_clock;
  return ClusterLeader::unconnected(
      {room(),
       {1},
       std::chrono::seconds(0),
       [](const std::string&) {},
       [begin = Clock::now()] { return Clock::now() - begin > std::chrono::minutes(2); }},
      kSession);
}

/// A leader that waits for no other host.
std::unique_ptr<ClusterLeader> leadThatTells(std::vector<std::string>& told) {
  return ClusterLeader::unconnected({room(),
                                     {1},
                                     std::chrono::seconds(0),
                                     [&told](const std::string& what) { told.push_back(what); },
                                     [] { return true; }},
                                    kSession);
}

TEST(ClusterHearing, TheLeaderDoesNotWaitForAHostLostInTheLastFrame) {
  const auto l = lead();
  l->receive(said(1, 9, 1, kSession, static_cast<std::uint8_t>(Phase::Ready), 0, false, kShow));
  l->begin(60);
  FrameOrder order;
  order.signature = signatureAt(1, 60), order.last = true;
  l->issue(order);
  ScriptedInput visitor;
  visitor.key("head", 0, Vec3(0, 0, 1.7));
  InputSample input;
  l->input(visitor).sampleFrame(0, order.signature.time, input);
  l->left(1, 9);
  EXPECT_TRUE(l->mayShow(order.signature));
}

TEST(ClusterHearing, AShowGoesOnOnlyFromAHostThatHasPlayedIt) {
  const auto l = lead();
  l->receive(said(1, 9, 1, 5, static_cast<std::uint8_t>(Phase::Ready), 0, false, kShow));
  std::vector<std::uint8_t> bytes(10, 3);
  StatePart part{};
  part.to = kSession, part.session = kSession, part.size = 10;
  part.bytes._buffer = bytes.data(), part.bytes._length = part.bytes._maximum = 10;
  l->receive(part);
  EXPECT_FALSE(l->takeOver());
  const auto other = lead();
  other->receive(said(1, 9, 1, 5, static_cast<std::uint8_t>(Phase::Ready), 3, true, kShow));
  other->receive(part);
  EXPECT_TRUE(other->takeOver());
}

TEST(ClusterHearing, AShowOfAnotherScriptIsNotTakenOver) {
  const auto l = lead();
  std::vector<std::uint8_t> bytes(10, 3);
  StatePart part{};
  part.to = kSession, part.session = kSession, part.size = 10;
  part.bytes._buffer = bytes.data(), part.bytes._length = part.bytes._maximum = 10;
  l->receive(said(1, 9, 1, 5, static_cast<std::uint8_t>(Phase::Ready), 3, true, kShow + 1));
  l->receive(part);
  EXPECT_FALSE(l->takeOver());
}

TEST(ClusterHearing, OfTwoProgramsOfOneNodeOneEnds) {
  const auto ready = static_cast<std::uint8_t>(Phase::Ready);
  const auto f = follower();  // its number is 7
  f->receive(said(1, 9, 1, 0, 0, 0, false, 1));
  EXPECT_FALSE(f->hasDouble()) << "it came later: it is told the same of us, and ends";
  f->receive(said(0, 6, 1, 0, 0, 0, false, 1));
  EXPECT_FALSE(f->hasDouble()) << "another node";
  f->receive(said(1, 9, 2, 1, ready, 3, true, 1));
  EXPECT_TRUE(f->hasDouble()) << "it plays, we do not yet";
  EXPECT_FALSE(f->mustRejoin());
  const auto earlier = follower();
  earlier->receive(said(1, 6, 1, 0, 0, 0, false, 1));
  EXPECT_TRUE(earlier->hasDouble()) << "it came before us";
  const auto l = lead();  // its number is kSession
  Session waiting = session(60, false);
  waiting.number = kSession - 1, waiting.over = true;
  l->receive(waiting);
  EXPECT_FALSE(l->hasDouble());
  waiting.over = false;
  l->receive(waiting);
  EXPECT_TRUE(l->hasDouble());
  const auto begun = lead();
  begun->begin(60);
  begun->receive(waiting);
  EXPECT_FALSE(begun->hasDouble()) << "it has not begun, we have";
}

TEST(ClusterHearing, ALeaderTakenForDeadThatComesBackLeadsNoMore) {
  Session later = session(60, true);
  later.number = kSession + 1, later.resumes = kSession;
  const auto l = lead();
  l->begin(60);
  l->receive(later);
  EXPECT_TRUE(l->hasDouble());
  FrameOrder order;
  order.signature = signatureAt(1, 60);
  l->issue(order);
  EXPECT_TRUE(order.last) << "it ends";
  ScriptedInput visitor;
  visitor.key("head", 0, Vec3(0, 0, 1.7));
  InputSample input;
  l->input(visitor).sampleFrame(0, order.signature.time, input);
  EXPECT_FALSE(l->mayShow(order.signature)) << "another one shows on the same walls";
  Session earlier = session(60, true);
  earlier.number = 3;
  const auto another = lead();
  another->begin(60);
  another->receive(earlier);
  EXPECT_FALSE(another->hasDouble()) << "that one had not been heard of";
  const auto f = follower();
  later.begun = false;
  f->receive(later);
  f->receive(earlier);
  later.begun = true, later.over = true;
  f->receive(later);
  EXPECT_FALSE(f->join()) << "it is in the later session, and that is over";
}

TEST(ClusterHearing, AHostGoneBeforeTheNextGroupIsNotWaitedFor) {
  using Clock = std::chrono::steady_clock;
  // Where it should wait, it is given a second; where it should not, so long that a busy machine is no
  // excuse.
  const auto waits = [](std::chrono::seconds patience, std::uint32_t expected, bool isThere, bool hurry) {
    LeaderOptions options{room(), {1}, patience, [](const std::string&) {}, [] { return false; }};
    options.expected = expected;
    const auto l = ClusterLeader::unconnected(options, kSession);
    if (isThere) l->receive(said(1, 9, 1, 0, 0, 0, false, kShow));
    const auto begin = Clock::now();
    l->begin(60, [&](bool) { return hurry ? WaitDecision::Ends : WaitDecision::Lasts; });
    return Clock::now() - begin >= patience;
  };
  constexpr std::chrono::seconds kShort(1), kLong(120);
  EXPECT_TRUE(waits(kShort, ~0U, false, false)) << "the first show waits for all";
  EXPECT_FALSE(waits(kLong, ~0U, false, true)) << "unless the operator has no patience";
  EXPECT_FALSE(waits(kLong, 1, false, false));
  EXPECT_TRUE(waits(kShort, 1, true, false)) << "it is back, and opens the show";
  EXPECT_TRUE(waits(kShort, 3, false, false));
}

TEST(ClusterHearing, OnlyAHostTakenIntoTheShowHasPlayed) {
  const auto l = lead();
  EXPECT_EQ(l->played(), ~0U) << "there was no show before";
  const auto ready = static_cast<std::uint8_t>(Phase::Ready),
             waiting = static_cast<std::uint8_t>(Phase::Waiting);
  l->receive(said(1, 9, 1, kSession, waiting, 0, false, kShow));
  l->finish(false);
  EXPECT_EQ(l->played(), 0U) << "it waited, and was refused";
  l->receive(said(1, 9, 2, kSession, ready, 0, false, kShow));
  l->finish(false);
  EXPECT_EQ(l->played(), 2U);
  l->left(1, 9);
  l->finish(false);
  EXPECT_EQ(l->played(), 2U) << "it crashed just now and restarts";
}

TEST(ClusterHearing, AWaitIsAnsweredOnlyAfterItsReport) {
  std::vector<bool> told;
  bool said = false;
  const auto l = ClusterLeader::unconnected(
      {room(), {1}, std::chrono::seconds(60), [&](const std::string&) { said = true; }, [] { return false; }},
      kSession);
  l->begin(60, [&](bool t) {
    EXPECT_EQ(t, said);
    told.push_back(t);
    return t ? WaitDecision::Ends : WaitDecision::Lasts;
  });
  EXPECT_TRUE(told.size() > 1 && !told.front() && told.back());
  EXPECT_TRUE(l->hasBegun());
}

TEST(ClusterHearing, ALeaderThatGivesUpWaitingHasBegunNothing) {
  const auto l = ClusterLeader::unconnected(
      {room(), {1}, std::chrono::seconds(60), [](const std::string&) {}, [] { return false; }}, kSession);
  EXPECT_FALSE(l->begin(60, [](bool) { return WaitDecision::GivesUp; }));
  EXPECT_FALSE(l->hasBegun());
}

TEST(ClusterHearing, WhatComesAfterASessionHasAHigherNumberWhateverTheClocksSay) {
  const auto l = lead();
  const auto ready = static_cast<std::uint8_t>(Phase::Ready);
  l->receive(said(1, 9, 1, kSession + 77, ready, 3, false, kShow));
  EXPECT_FALSE(l->takeOver());
  EXPECT_GT(l->session(), kSession + 77);
}

TEST(ClusterHearing, OfAnotherClusterInTheSameNetworkItIsSaidThatThereIsOne) {
  std::string told;
  const auto tell = [&](const std::string& what) { told = what; };
  const auto stop = [] { return true; };
  CompatibilityKey ours;
  ours.cluster = 5;
  const auto l = ClusterLeader::unconnected({room(), ours, std::chrono::seconds(0), tell, stop}, kSession);
  Session theirs = session(60, true);
  theirs.compatibility.cluster = 6;
  l->receive(theirs);
  EXPECT_TRUE(l->hasDouble());
  EXPECT_NE(told.find("another cluster plays in the same network"), std::string::npos) << told;
  told.clear();
  const auto f = Follower::unconnected({room(), 1, ours, tell, stop}, 7);
  Presence beside = said(1, 6, 1, 0, 0, 0, false, 1);
  beside.cluster = 6;
  f->receive(beside);
  EXPECT_TRUE(f->hasDouble());
  EXPECT_NE(told.find("another cluster plays in the same network"), std::string::npos) << told;
}

TEST(ClusterHearing, AHostThatLeavesIsNotMissed) {
  std::vector<std::string> told;
  const auto l = leadThatTells(told);
  l->receive(said(1, 9, 1, kSession, static_cast<std::uint8_t>(Phase::Ready), 0, true, kShow));
  l->begin(60);
  told.clear();
  l->receive(said(1, 9, 2, kSession, static_cast<std::uint8_t>(Phase::Leaving), 0, true, kShow));
  l->left(1, 9);
  EXPECT_EQ(told, std::vector<std::string>{"left plays no longer; the others go on"});
}

TEST(ClusterHearing, AFollowerAskedToEndAppliesNoFurtherOrder) {
  bool leaves = false;
  const auto f = Follower::unconnected(
      {room(), 1, {1}, [](const std::string&) {}, [] { return true; }, [&] { return leaves; }}, 7);
  f->receive(session(60, false));
  ASSERT_TRUE(f->join());
  FrameOrder order;
  order.signature = signatureAt(0, 60);
  WrittenOrder written;
  f->receive(written.write({1, 1, 3, 0}, order, nullptr));
  f->receive(written.write({1, 2, 3, 0}, order, nullptr));
  EXPECT_TRUE(f->next());
  leaves = true;
  EXPECT_FALSE(f->next());
  EXPECT_FALSE(f->mustRejoin());
}

TEST(ClusterHearing, AHostBesideAMemberOfItsNameIsNoneUntilItAsks) {
  std::vector<std::string> told;
  const auto l = leadThatTells(told);
  const auto phase = [](Phase p) { return static_cast<std::uint8_t>(p); };
  l->receive(said(1, 9, 1, kSession, phase(Phase::Ready), 0, true, kShow));
  l->begin(60);
  told.clear();
  l->receive(said(1, 12, 1, 0, phase(Phase::Waiting), 0, false, 0));
  l->receive(said(1, 9, 2, kSession, phase(Phase::Ready), 0, true, kShow));
  EXPECT_EQ(told, std::vector<std::string>()) << "it may end at once";
  l->receive(said(1, 12, 2, kSession, phase(Phase::Asking), 0, false, kShow));
  EXPECT_EQ(told, std::vector<std::string>{"left restarted; the others go on"});
}

TEST(ClusterHearing, WhatMustBeAlikeIsNamedWhereItIsNot) {
  const CompatibilityKey lead{1, 2, 3, 4, "--look full"};
  CompatibilityKey ours = lead;
  EXPECT_EQ(refusal(lead, ours, "front"), "");
  EXPECT_EQ(remark(lead, ours, "front"), "");
  ours.pictures = "--look plain";
  EXPECT_EQ(remark(lead, ours, "front"),
            "front plays with --look full, we with --look plain: the walls will not look alike");
  EXPECT_EQ(refusal(lead, ours, "front"), "");
  const auto with = [&](std::uint64_t CompatibilityKey::*what, std::uint64_t value) {
    CompatibilityKey other = lead;
    other.*what = value;
    return refusal(lead, other, "front");
  };
  EXPECT_EQ(with(&CompatibilityKey::script, 9),
            "front plays another script; put the same file on all machines");
  EXPECT_EQ(with(&CompatibilityKey::cluster, 9),
            "front has another cluster file; put the same file on all machines");
  EXPECT_EQ(with(&CompatibilityKey::walls, 9),
            "front has another wall file; put the same file on all machines");
  EXPECT_EQ(with(&CompatibilityKey::input, 0),
            "front plays another input log; put the same file on all machines");
  CompatibilityKey extended = lead;
  extended.plugins = "spring 1.0 (12ab)";
  EXPECT_EQ(refusal(lead, extended, "front"), "front plays with no plugins, we with the plugins spring 1.0 "
                                              "(12ab); load the same plugins on all machines");
  EXPECT_EQ(refusal(extended, extended, "front"), "");
  CompatibilityKey live = lead;
  live.input = 0;
  EXPECT_EQ(refusal(live, lead, "front"), "") << "a follower plays no log of its own then";
}

TEST(ClusterHearing, AMachinesInterfaceIsItsOwnAndTheRestOfTheFileIsNot) {
  Diagnostics findings;
  const auto hash = [&](const std::string& more) {
    const auto file = parseCluster("node a front\nnode b left\n" + more, "x.cluster", findings);
    return file ? hashOf(*file) : 0;
  };
  const std::uint64_t plain = hash("");
  EXPECT_EQ(hash("interface lo\n"), plain);
  for (const char* more :
       {"deadline 1\n", "lead b\n", "hash-every 7\n", "on-difference stop\n", "node c right\n"})
    EXPECT_NE(hash(more), plain) << more;
  EXPECT_TRUE(findings.all().empty());
}

TEST(ClusterHearing, WhatAnotherMachineSaysIsNoCommandToATerminal) {
  std::string told;
  const auto lead = ClusterLeader::unconnected({room(),
                                                {1},
                                                std::chrono::seconds(0),
                                                [&](const std::string& what) { told = what; },
                                                [] { return true; }},
                                               1);
  std::string where = "ball\x1b[2J", longText(5000, 'x'), there = "1";
  Difference d{};
  d.node = 1, d.session = 1, d.frame = 3, d.found = true;
  d.where = where.data(), d.here = longText.data(), d.there = there.data();
  lead->receive(d);
  EXPECT_EQ(told.find('\x1b'), std::string::npos);
  EXPECT_LT(told.size(), 1000U);
}

}  // namespace
}  // namespace stadion::cluster
