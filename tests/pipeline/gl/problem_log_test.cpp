#include "pipeline/gl/problem_log.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

TEST(ProblemLog, ReturnsEachProblemOnce) {
  ProblemLog log;
  EXPECT_FALSE(log.take());
  log.report("a mesh is gone");
  ASSERT_TRUE(log.take());
  EXPECT_FALSE(log.take());
  log.report("a mesh is gone");
  EXPECT_FALSE(log.take()) << "it is not new any more";
  log.report("too many lights");
  ASSERT_TRUE(log.take());
}

TEST(ProblemLog, KeepsTheFirstOfSeveralNewProblems) {
  ProblemLog log;
  log.report("a mesh is gone");
  log.report("too many lights");
  const auto problem = log.take();
  ASSERT_TRUE(problem);
  EXPECT_EQ(problem->message, "a mesh is gone");
  EXPECT_FALSE(log.take());
}

}  // namespace
}  // namespace stadion
