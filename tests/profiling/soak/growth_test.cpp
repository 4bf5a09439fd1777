/// What a soak says of memory that grows, that stays, and that comes in steps.

#include "profiling/soak/growth.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

/// A sample each thousand frames; `grows` bytes a frame, and something that comes and goes.
std::vector<SoakSample> samplesOf(std::uint32_t process, std::uint64_t from, double grows) {
  std::vector<SoakSample> all;
  for (std::uint64_t n = 0; n < 300; ++n) {
    const std::uint64_t frame = from + 1000 * n;
    const std::uint64_t noise = (n * 7919) % 13 * 4096 + (n % 50 == 0 ? 10'000'000 : 0);
    const auto grown = static_cast<std::uint64_t>(grows * static_cast<double>(frame - from));
    all.push_back({process, process, frame, 200'000'000 + 1'000'000ULL * process + grown + noise, 0, 30, 12});
  }
  return all;
}

TEST(Growth, ASlopeIsFoundAmongOutliers) {
  const auto grows = samplesOf(0, 0, 0.5), stays = samplesOf(0, 0, 0);
  EXPECT_NEAR(*slopeOf(grows, &SoakSample::residentBytes), 0.5, 0.02);
  EXPECT_NEAR(*slopeOf(stays, &SoakSample::residentBytes), 0, 0.02);
}

TEST(Growth, AnotherProcessHasMemoryOfItsOwn) {
  auto both = samplesOf(0, 0, 0);
  const auto second = samplesOf(40, 300'000, 0);
  both.insert(both.end(), second.begin(), second.end());
  EXPECT_NEAR(*slopeOf(both, &SoakSample::residentBytes), 0, 0.02);
}

TEST(Growth, AnotherVisitMayLieElsewhere) {
  auto both = samplesOf(0, 0, 0);
  for (SoakSample s : samplesOf(0, 300'000, 0)) s.visit = 1, s.residentBytes += 50'000'000, both.push_back(s);
  EXPECT_NEAR(*slopeOf(both, &SoakSample::residentBytes), 0, 0.02);
}

TEST(Growth, WhatEachVisitLeavesBehindIsFound) {
  std::vector<SoakSample> all;
  for (std::uint64_t visit = 0; visit < 30; ++visit)
    for (std::uint64_t n = 0; n < 5; ++n)
      all.push_back(
          {0, visit, 5000 * visit + 1000 * n, 0, 1'000'000 + 2000 * visit + visit % 7 * 500 + 100 * n, 0, 0});
  EXPECT_NEAR(*slopeOfVisits(all, &SoakSample::heapBytes), 2000, 100);
  all.resize(45);
  EXPECT_FALSE(slopeOfVisits(all, &SoakSample::heapBytes));
}

TEST(Growth, NothingIsSaidOfOneSample) {
  const std::vector<SoakSample> one{{0, 0, 1000, 5, 5, 5, 5}};
  EXPECT_FALSE(slopeOf(one, &SoakSample::residentBytes));
  EXPECT_EQ(growthOf(one, &SoakSample::handles), 0);
}

TEST(Growth, WarmUpIsEachVisitsOwn) {
  auto both = samplesOf(0, 0, 0);
  const auto second = samplesOf(1, 300'000, 0);
  both.insert(both.end(), second.begin(), second.end());
  const auto warm = afterWarmUp(both, 100'000);
  EXPECT_EQ(warm.size(), 400U);
}

TEST(Growth, AHandleThatStaysOpenIsCountedAndOneThatIsClosedIsNot) {
  auto samples = samplesOf(0, 0, 0);
  samples[20].handles = 33, samples[200].handles = 32;
  EXPECT_LE(growthOf(samples, &SoakSample::handles), 0);
  for (std::size_t i = 250; i < 300; ++i) samples[i].handles = 34;
  EXPECT_EQ(growthOf(samples, &SoakSample::handles), 1);
}

}  // namespace
}  // namespace stadion
