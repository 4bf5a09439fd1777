/// The end of a show in a cluster: a host may have missed the last frame.

#include "pipeline/cluster/follower.h"
#include "tests/pipeline/cluster/unconnected_follower.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

namespace stadion::cluster {
namespace {

TEST(ClusterHearing, TheLeaderEndsTheShowForAll) {
  const auto f = follower();
  Session s = session(60, false);
  f->receive(s);
  ASSERT_TRUE(f->join());
  FrameOrder order;
  order.signature = signatureAt(0, 60);
  WrittenOrder written;
  f->receive(written.write({1, 1, 3, 0}, order, nullptr));
  s.begun = s.over = true;
  f->receive(s);
  EXPECT_TRUE(f->next()) << "what was ordered before is played";
  EXPECT_FALSE(f->next());
  EXPECT_FALSE(f->mustRejoin());
}

/// A follower that has played some frames and shown those of which it is a member, as far as all have drawn.
std::unique_ptr<Follower> followerThatPlayed(const std::vector<bool>& member, std::uint64_t go,
                                             bool toTheLast = false) {
  auto f = follower();
  f->receive(session(60, false));
  EXPECT_TRUE(f->join());
  WrittenOrder written;
  FrameOrder order;
  for (std::size_t i = 0; i < member.size(); ++i) {
    order.signature = signatureAt(i, 60), order.last = toTheLast && i + 1 == member.size();
    f->receive(written.write({1, i + 1, member[i] ? 3U : 1U, 0}, order, nullptr));
  }
  f->receive(Go{1, go, 0});
  for (std::size_t i = 0; i < member.size(); ++i)
    if (const auto next = f->next()) f->mayShow(next->signature);
  return f;
}

/// The leader has shown so many frames.
Session over(std::uint64_t shown) {
  Session s = session(60, true);
  s.over = true, s.shown = shown;
  return s;
}

bool missesTheEnd(const std::unique_ptr<Follower>& f, std::uint64_t shown) {
  EXPECT_FALSE(f->missedTheEnd()) << "it is not over";
  f->receive(over(shown));
  return f->missedTheEnd();
}

TEST(ClusterHearing, AHostThatDoesNotShowTheLastFrameHasMissedTheEnd) {
  EXPECT_FALSE(missesTheEnd(followerThatPlayed({}, 0), 0)) << "a show without frames has been seen";
  EXPECT_FALSE(missesTheEnd(followerThatPlayed({true, true}, 2), 2));
  EXPECT_FALSE(missesTheEnd(followerThatPlayed({true, false, true}, 3), 3)) << "it was left out, and is back";
  EXPECT_TRUE(missesTheEnd(followerThatPlayed({true, false, false}, 3), 3))
      << "it was left out, and is not back";
  EXPECT_TRUE(missesTheEnd(followerThatPlayed({true, true}, 1), 2)) << "the others have shown it";
  EXPECT_FALSE(missesTheEnd(followerThatPlayed({true, true}, 1), 1)) << "no host has";
  EXPECT_TRUE(missesTheEnd(followerThatPlayed({true, true}, 2), 9)) << "it heard of no further order";
}

/// It ends by itself, maybe before it hears that the show is over.
TEST(ClusterHearing, AHostLeftOutOfTheLastFrameHasMissedTheEnd) {
  EXPECT_FALSE(followerThatPlayed({true, true}, 2, true)->missedTheEnd());
  EXPECT_TRUE(followerThatPlayed({true, false}, 2, true)->missedTheEnd());
}

/// A pause is that frame again and again.
TEST(ClusterHearing, AHostLeftOutOfAPauseAtTheEndHasNotMissedIt) {
  const auto f = followerThatPlayed({true, true}, 2);
  FrameOrder order;
  order.signature = signatureAt(1, 60), order.still = Standstill::Paused;
  WrittenOrder written;
  f->receive(written.write({1, 3, 1, 0}, order, nullptr));
  ASSERT_TRUE(f->next());
  f->mayShow(order.signature);
  EXPECT_FALSE(missesTheEnd(f, 2));
}

/// With what the follower before it has kept: that one has shown so many frames of session 1.
std::unique_ptr<Follower> followerThatHasShown(std::uint64_t frames, std::uint64_t played = 0) {
  auto kept = std::make_shared<ResumableScene>();
  kept->transfer.session = 1, kept->transfer.serial = frames, kept->transfer.frame = frames - 1;
  kept->framesShown = frames;
  return Follower::unconnected(
      {room(), 1, {1}, [](const std::string&) {}, [] { return true; }, {}, kept, played}, 7);
}

TEST(ClusterHearing, AHostStillJoiningAsTheShowEndsHasMissedTheEnd) {
  for (const bool cameBefore : {false, true}) {
    const auto f = cameBefore ? followerThatHasShown(3) : follower();
    std::vector<std::uint8_t> bytes(10, 3);
    StatePart part{};
    part.to = 7, part.session = 1, part.serial = 4, part.frame = 3, part.size = 10;
    part.bytes._buffer = bytes.data(), part.bytes._length = part.bytes._maximum = 10;
    f->receive(session(60, true));
    f->receive(part);
    ASSERT_TRUE(f->join());
    f->receive(over(4));
    EXPECT_TRUE(f->missedTheEnd()) << cameBefore;
  }
}

/// The leader died when the last frame had been shown, and had its scene from us.
TEST(ClusterHearing, AHostThatHasShownTheLastFrameHasNotMissedTheEnd) {
  const auto f = followerThatHasShown(5);
  Session s = session(60, true);
  s.number = 2, s.resumes = 1;
  f->receive(s);
  std::vector<std::uint8_t> bytes(10, 3);
  StatePart part{};
  part.to = 7, part.session = 2, part.serial = 0, part.frame = 4, part.size = 10;
  part.bytes._buffer = bytes.data(), part.bytes._length = part.bytes._maximum = 10;
  f->receive(part);
  ASSERT_TRUE(f->join());
  s.over = true;
  f->receive(s);
  EXPECT_TRUE(f->isOver());
  EXPECT_FALSE(f->missedTheEnd());
}

TEST(ClusterHearing, AHostThatRejoinsAndHearsThatTheShowIsOverIsDone) {
  for (const std::uint64_t resumes : {0, 1}) {
    const auto f = followerThatHasShown(5, 1);
    Session s = over(7);
    s.number = 1 + resumes, s.resumes = resumes;
    f->receive(s);
    EXPECT_FALSE(f->join());
    EXPECT_TRUE(f->isOver() && f->missedTheEnd());
  }
  const auto f = followerThatHasShown(5, 1);
  Session another = over(7);
  another.number = 8;
  f->receive(another);
  EXPECT_FALSE(f->isOver()) << "it was another show";
}

/// Of an earlier run that is still busy with its video.
TEST(ClusterHearing, AnEarlierShowThatIsOverIsNoReasonToLeaveTheNextOne) {
  const auto f = follower();
  Session next = session(60, false), earlier = over(7);
  next.number = 9, earlier.number = 5;
  f->receive(next);
  ASSERT_TRUE(f->join());
  f->receive(earlier);
  EXPECT_FALSE(f->mustRejoin() || f->isOver());
}

}  // namespace
}  // namespace stadion::cluster
