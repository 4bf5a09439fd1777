#include "pipeline/platform/machine.h"
#include "pipeline/platform/topology.h"

#include <gtest/gtest.h>

#include <thread>

namespace stadion {
namespace {

/// Whether no processor is in two of them.
bool apart(const std::vector<ProcessorSet>& parts) {
  for (std::size_t i = 0; i < ProcessorSet::kMost; ++i) {
    std::size_t in = 0;
    for (const ProcessorSet& part : parts) in += part.contains(i);
    if (in > 1) return false;
  }
  return true;
}

std::size_t together(const std::vector<ProcessorSet>& parts) {
  ProcessorSet all;
  for (const ProcessorSet& part : parts)
    for (std::size_t i = 0; i < ProcessorSet::kMost; ++i)
      if (part.contains(i)) all.add(i);
  return all.size();
}

TEST(Topology, CountsCoresAndHardwareThreads) {
  const Topology t = Topology::synthetic("package:2 core:4 pu:2");
  EXPECT_EQ(t.cores(), 8u);
  EXPECT_EQ(t.hardwareThreads(), 16u);
}

TEST(Topology, PartsShareNoProcessorAndLeaveNoneOutWhileThereAreEnough) {
  for (const char* machine : {"package:2 core:4 pu:2", "package:1 core:8 pu:1", "package:4 core:1 pu:1"})
    for (const std::size_t walls : {1, 2, 4}) {
      const Topology t = Topology::synthetic(machine);
      const auto parts = t.parts(walls);
      ASSERT_EQ(parts.size(), walls);
      EXPECT_TRUE(apart(parts)) << machine << ", " << walls;
      EXPECT_EQ(together(parts), t.hardwareThreads()) << machine << ", " << walls;
      for (const ProcessorSet& part : parts) EXPECT_EQ(part.size(), t.hardwareThreads() / walls) << machine;
    }
}

TEST(Topology, APartDoesNotGoFromOnePackageToTheOther) {
  for (const ProcessorSet& part : Topology::synthetic("package:2 core:4 pu:2").parts(4)) {
    bool first = false, second = false;
    for (std::size_t i = 0; i < 16; ++i) (i < 8 ? first : second) |= part.contains(i);
    EXPECT_NE(first, second);
  }
}

TEST(Topology, AWallMoreThanProcessorsStillHasOne) {
  const auto parts = Topology::synthetic("core:2 pu:1").parts(5);
  ASSERT_EQ(parts.size(), 5u);
  for (const ProcessorSet& part : parts) EXPECT_EQ(part.size(), 1u);
  EXPECT_EQ(together(parts), 2u);
}

TEST(Topology, OfThisMachineHasAProcessorToRunOn) {
  const Topology t = Topology::ofThisMachine();
  ASSERT_GE(t.hardwareThreads(), 1u);
  const ProcessorSet mine = processorsOfThisThread();
  for (const ProcessorSet& part : t.parts(3)) {
    EXPECT_FALSE(part.empty());
    for (std::size_t i = 0; i < ProcessorSet::kMost; ++i)
      EXPECT_TRUE(!part.contains(i) || mine.contains(i)) << i;
  }
}

TEST(Topology, OfADescriptionThatIsNoneKnowsNothing) {
  const Topology t = Topology::synthetic("a horse");
  EXPECT_EQ(t.cores(), 0u);
  EXPECT_EQ(t.model(), "");
  for (const ProcessorSet& part : t.parts(2)) EXPECT_TRUE(part.empty());
}

TEST(ThreadsProcessorSet, BindsTheThreadThatAsksAndThoseThatItStarts) {
  const ProcessorSet all = processorsOfThisThread();
  ProcessorSet one;
  for (std::size_t i = 0; one.empty(); ++i)
    if (all.contains(i)) one.add(i);
  ProcessorSet bound, inherited;
  std::thread([&] {
    EXPECT_TRUE(one.bindThisThread());
    bound = processorsOfThisThread();
    std::thread([&] { inherited = processorsOfThisThread(); }).join();
  }).join();
  EXPECT_EQ(bound, one);
  EXPECT_EQ(inherited, one);
  EXPECT_EQ(processorsOfThisThread(), all);
}

TEST(ProcessorSet, OfNoProcessorsIsRefused) {
  const ProcessorSet before = processorsOfThisThread();
  EXPECT_FALSE(ProcessorSet().bindThisThread());
  EXPECT_EQ(processorsOfThisThread(), before);
}

TEST(ProcessorSet, LeavesOutWhatIsBeyondItsEnd) {
  ProcessorSet set;
  set.add(ProcessorSet::kMost - 1), set.add(ProcessorSet::kMost), set.add(0);
  EXPECT_EQ(set.size(), 2u);
  EXPECT_FALSE(set.contains(ProcessorSet::kMost));
}

TEST(Machine, IsTheSameWheneverItIsLookedAt) {
  const Machine m = thisMachine();
  EXPECT_TRUE(m.isLike(thisMachine()));
  EXPECT_GE(m.processors, 1u);
  EXPECT_GE(m.rasteriserBuild.size(), 16u) << m.rasteriserBuild;
}

TEST(Machine, IsAnotherWithOtherProcessorsOrAnotherBuildOfMesa) {
  const Machine m{"Processor", 4, 8, "abcdef", "llvmpipe"};
  Machine other = m;
  other.rasteriser = "the same, told otherwise";
  EXPECT_TRUE(m.isLike(other));
  other.cores = 2;
  EXPECT_FALSE(m.isLike(other));
  other = m, other.processors = 4;
  EXPECT_FALSE(m.isLike(other));
  other = m, other.processor = "Another";
  EXPECT_FALSE(m.isLike(other));
  other = m, other.rasteriserBuild = "abcdee";
  EXPECT_FALSE(m.isLike(other));
}

}  // namespace
}  // namespace stadion
