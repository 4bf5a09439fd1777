#include "engine/scene/visit_queue.h"

#include "engine/nodes/group_node.h"
#include "tests/engine/scene/show_fixture.h"

#include <gtest/gtest.h>
#include <random>
#include <set>

namespace stadion {
namespace {

class RankedNode : public Node {
public:
  RankedNode(std::uint32_t position, Rank rank) : Node(kGroupType, {1, position}, ""), rank_(rank) {}
  Rank rank() const override { return rank_; }

private:
  Rank rank_;
};

std::vector<std::uint32_t> takeAll(VisitQueue& queue) {
  std::vector<std::uint32_t> order;
  for (; queue.next(); queue.take()) order.push_back(queue.next()->visit.node.position);
  return order;
}

using Order = std::vector<std::uint32_t>;

TEST(VisitQueue, VisitsByRankThenByPositionHoweverTheyWereCalled) {
  RankedNode late(1, Rank::Dynamics), early(7, Rank::Input), middle(3, Rank::Motion), other(2, Rank::Motion);
  VisitQueue queue;
  for (Node* node : {static_cast<Node*>(&late), static_cast<Node*>(&middle)}) queue.setBusy(*node, true);
  queue.begin();
  for (Node* node : {static_cast<Node*>(&other), static_cast<Node*>(&early), static_cast<Node*>(&late)})
    queue.call(*node);
  queue.sort();
  EXPECT_EQ(takeAll(queue), (Order{7, 2, 3, 1}));
  queue.begin();
  EXPECT_EQ(takeAll(queue), (Order{3, 1})) << "a node that was called once only is not visited again";
}

TEST(VisitQueue, ANodeCalledWhileARoundIsUnderWayHasItsTurnOnce) {
  RankedNode a(1, Rank::Motion), b(2, Rank::Motion), c(3, Rank::Motion);
  VisitQueue queue;
  queue.setBusy(a, true), queue.setBusy(c, true);
  queue.begin();
  queue.take();
  for (int i = 0; i < 3; ++i) queue.callNow(c), queue.callNow(b);
  EXPECT_EQ(takeAll(queue), (Order{2, 3}));
  queue.callNow(a);
  EXPECT_EQ(takeAll(queue), (Order{1})) << "its turn had come, but it was called once more";
}

TEST(VisitQueue, IsWhatASortedSetWouldBe) {
  std::mt19937 random(11);
  std::vector<std::unique_ptr<RankedNode>> nodes;
  for (std::uint32_t i = 0; i < 40; ++i)
    nodes.push_back(std::make_unique<RankedNode>(i, static_cast<Rank>(random() % 6)));
  const auto visitOf = [&](std::size_t i) { return Visit::of(*nodes[i]); };
  VisitQueue queue;
  std::set<Visit> busy;
  for (int round = 0; round < 500; ++round) {
    for (std::uint32_t n = random() % 8; n > 0; --n) {
      const std::size_t i = random() % nodes.size();
      const bool on = random() % 2 == 0;
      queue.setBusy(*nodes[i], on);
      if (on)
        busy.insert(visitOf(i));
      else
        busy.erase(visitOf(i));
    }
    queue.begin();
    std::set<Visit> expected = busy;
    for (std::uint32_t n = random() % 4; n > 0; --n) {
      const std::size_t i = random() % nodes.size();
      queue.call(*nodes[i]), expected.insert(visitOf(i));
    }
    queue.sort();
    while (!expected.empty()) {
      ASSERT_TRUE(queue.next());
      const Visit now = queue.next()->visit;
      ASSERT_EQ(now, *expected.begin());
      queue.take(), expected.erase(expected.begin());
      const std::size_t i = random() % nodes.size();
      if (random() % 3 == 0 && now < visitOf(i)) queue.callNow(*nodes[i]), expected.insert(visitOf(i));
    }
    ASSERT_FALSE(queue.next());
  }
}

}  // namespace
}  // namespace stadion
