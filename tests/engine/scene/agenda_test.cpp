#include "engine/scene/agenda.h"

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

std::vector<std::uint32_t> takeAll(Agenda& agenda) {
  std::vector<std::uint32_t> order;
  for (; agenda.next(); agenda.take()) order.push_back(agenda.next()->visit.node.position);
  return order;
}

using Order = std::vector<std::uint32_t>;

TEST(Agenda, VisitsByRankThenByPositionHoweverTheyWereCalled) {
  RankedNode late(1, Rank::Dynamics), early(7, Rank::Input), middle(3, Rank::Motion), other(2, Rank::Motion);
  Agenda agenda;
  for (Node* node : {static_cast<Node*>(&late), static_cast<Node*>(&middle)}) agenda.setBusy(*node, true);
  agenda.begin();
  for (Node* node : {static_cast<Node*>(&other), static_cast<Node*>(&early), static_cast<Node*>(&late)})
    agenda.call(*node);
  agenda.sort();
  EXPECT_EQ(takeAll(agenda), (Order{7, 2, 3, 1}));
  agenda.begin();
  EXPECT_EQ(takeAll(agenda), (Order{3, 1})) << "who was only called once is not visited again";
}

TEST(Agenda, WhoIsCalledWhileARoundIsUnderWayHasItsTurnOnce) {
  RankedNode a(1, Rank::Motion), b(2, Rank::Motion), c(3, Rank::Motion);
  Agenda agenda;
  agenda.setBusy(a, true), agenda.setBusy(c, true);
  agenda.begin();
  agenda.take();
  for (int i = 0; i < 3; ++i) agenda.callNow(c), agenda.callNow(b);
  EXPECT_EQ(takeAll(agenda), (Order{2, 3}));
  agenda.callNow(a);
  EXPECT_EQ(takeAll(agenda), (Order{1})) << "its turn had come, but it was called once more";
}

TEST(Agenda, IsWhatASortedSetWouldBe) {
  std::mt19937 random(11);
  std::vector<std::unique_ptr<RankedNode>> nodes;
  for (std::uint32_t i = 0; i < 40; ++i)
    nodes.push_back(std::make_unique<RankedNode>(i, static_cast<Rank>(random() % 6)));
  const auto visitOf = [&](std::size_t i) { return Visit::of(*nodes[i]); };
  Agenda agenda;
  std::set<Visit> busy;
  for (int round = 0; round < 500; ++round) {
    for (std::uint32_t n = random() % 8; n > 0; --n) {
      const std::size_t i = random() % nodes.size();
      const bool on = random() % 2 == 0;
      agenda.setBusy(*nodes[i], on);
      if (on)
        busy.insert(visitOf(i));
      else
        busy.erase(visitOf(i));
    }
    agenda.begin();
    std::set<Visit> expected = busy;
    for (std::uint32_t n = random() % 4; n > 0; --n) {
      const std::size_t i = random() % nodes.size();
      agenda.call(*nodes[i]), expected.insert(visitOf(i));
    }
    agenda.sort();
    while (!expected.empty()) {
      ASSERT_TRUE(agenda.next());
      const Visit now = agenda.next()->visit;
      ASSERT_EQ(now, *expected.begin());
      agenda.take(), expected.erase(expected.begin());
      const std::size_t i = random() % nodes.size();
      if (random() % 3 == 0 && now < visitOf(i)) agenda.callNow(*nodes[i]), expected.insert(visitOf(i));
    }
    ASSERT_FALSE(agenda.next());
  }
}

}  // namespace
}  // namespace stadion
