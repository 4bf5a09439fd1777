#include "tests/engine/nodes/declared_node.h"
#include "tests/engine/scene/show_fixture.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

TEST(Timer, KeepsExactTimeAtAnyFrameRateAndIsNotVisitedBetween) {
  for (const double rate : {30.0, 60.0, 240.0}) {
    ShowFixture show;
    show.rate = rate;
    ListeningNode* listener = nullptr;
    show.loader.files["show"] = [&](LoadedScene& load) {
      addDeclared(load, "clock", "timer( period=0.123, repeat=on )")
          .addNotification(notify(Event("timesup"), "listener", CommandId::Toggle, 0.5));
      listener = &addNode<ListeningNode>(load, "listener");
    };
    show.scene.open("show");
    std::uint64_t visits = 0;
    for (int n = 0; n < static_cast<int>(rate) * 2; ++n)
      show.frame(), visits += show.scene.counters().nodesVisited;
    ASSERT_GE(listener->heard.size(), 11u);
    for (std::size_t i = 0; i < listener->heard.size(); ++i)
      EXPECT_EQ(listener->heard[i].effective, fromSeconds(0.5) + static_cast<Nanoseconds>(i + 1) * 123000000);
    EXPECT_LE(visits, 30u);
  }
}

TEST(Timer, WithoutAPeriodIsAnError) {
  Diagnostics findings;
  checkScript(SourceText::make("a.evs", "timer( repeat=on )").value(), testTypes(), findings);
  ASSERT_EQ(findings.errorCount(), 1U);
  EXPECT_EQ(findings.all()[0].message,
            "timer has no \"period\", which it must have: time from being enabled to the event");
}

}  // namespace
}  // namespace stadion
