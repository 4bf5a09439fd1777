/// The closing line of `stadion test`, made from what ctest reports.

#include "cli/test_results.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

std::string junitCase(const std::string& name, const std::string& status, const std::string& inside) {
  return "\t<testcase name=\"" + name + "\" classname=\"" + name + "\" time=\"0.1\" status=\"" + status +
         "\">\n" + inside + "\t</testcase>\n";
}

TestResults resultsOf(const std::string& cases) {
  return testResultsOf(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuite name=\"(empty)\"\n\ttests=\"9\"\n\t>\n" +
      cases + "</testsuite>\n");
}

TEST(TestResults, CountsWhatPassedFailedAndWasSkipped) {
  const TestResults results = resultsOf(
      junitCase("Suite.Passes", "run", "\t\t<system-out></system-out>\n") +
      junitCase("Suite.Fails", "fail",
                "\t\t<failure message=\"\"/>\n\t\t<system-out>a line\n</system-out>\n") +
      junitCase(
          "Suite.Skips", "notrun",
          "\t\t<skipped message=\"SKIP_REGULAR_EXPRESSION_MATCHED\"/>\n\t\t<system-out>[ RUN      ] "
          "Suite.Skips\n/x/y_test.cpp:12: Skipped\nneeds &lt;AVX2&gt; &amp; more\n\n[  SKIPPED ] Suite.Skips "
          "(0 ms)\n</system-out>\n") +
      junitCase("Suite.PassesToo", "run", ""));
  EXPECT_EQ(closingLine(results), "2 passed, 1 failed, 1 skipped");
  ASSERT_EQ(results.skipped.size(), 1U);
  EXPECT_EQ(results.skipped[0].first, "Suite.Skips");
  EXPECT_EQ(results.skipped[0].second, "needs <AVX2> & more");
}

TEST(TestResults, ATestThatCannotBeStartedHasFailed) {
  const TestResults results = resultsOf(
      junitCase("Suite.Missing", "notrun", "\t\t<skipped message=\"Unable to find executable\"/>\n"));
  EXPECT_EQ(closingLine(results), "0 passed, 1 failed, 0 skipped");
}

TEST(TestResults, ATestThatPrintsTheWordsOfASkippedOneHasPassed) {
  EXPECT_EQ(closingLine(resultsOf(junitCase("Suite.Prints", "run",
                                            "\t\t<system-out>[  SKIPPED ]\n&lt;skipped message=\"SKIP_\n"
                                            "</system-out>\n"))),
            "1 passed, 0 failed, 0 skipped");
}

TEST(TestResults, ADisabledTestAndOneWithoutAReasonAreSkipped) {
  const TestResults results =
      resultsOf(junitCase("Suite.Off", "disabled", "\t\t<system-out>Disabled</system-out>\n") +
                junitCase("Suite.Mute", "notrun", "\t\t<skipped message=\"SKIP_RETURN_CODE=4\"/>\n"));
  EXPECT_EQ(closingLine(results), "0 passed, 0 failed, 2 skipped");
  EXPECT_EQ(results.skipped[1].second, "no reason given");
}

TEST(TestResults, AFileThatWasNotWrittenGivesNoResults) {
  for (const char* text : {"", "<testcase", "nonsense \"status=\""})
    EXPECT_EQ(closingLine(testResultsOf(text)), "0 passed, 0 failed, 0 skipped") << text;
}

}  // namespace
}  // namespace stadion
