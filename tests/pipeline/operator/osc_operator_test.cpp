/// The operator's commands as messages, and what is said of those that are none.

#include "pipeline/operator/osc_operator.h"

#include <gtest/gtest.h>
#include <limits>

namespace stadion {
namespace {

OscMessage message(std::string_view path, std::span<const double> numbers, bool numeric = true) {
  return {path, numbers, numeric, {}};
}

TEST(OscOperator, ANumberOutOfItsRangeIsNotTakenAndItsRangeIsSaid) {
  struct Case {
    std::string_view path;
    double number;
    const char* said;
  };
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (const Case& c :
       {Case{"/stadion/volume", kNan,
             "\"/stadion/volume\" with nan is not taken: it takes a number from 0 to 1"},
        Case{"/stadion/volume", -5,
             "\"/stadion/volume\" with -5 is not taken: it takes a number from 0 to 1"},
        Case{"/stadion/eye-separation", 1e30, "with 1e+30 is not taken: it takes a number from 0 to 1 m"},
        Case{"/stadion/volume/by", kNan, "it takes a number that is added"},
        Case{"/stadion/pause", kNan, "it takes 0 (off), 1 (on), or nothing"},
        Case{"/stadion/pause", 7, "with 7 is not taken: it takes 0 (off), 1 (on), or nothing"},
        Case{"/stadion/black", 0.5, "with 0.5 is not taken: it takes 0 (off), 1 (on), or nothing"},
        Case{"/stadion/step", 2, "it takes nothing, or 1 and 0 as a button sends them"}}) {
    const double numbers[] = {c.number};
    EXPECT_FALSE(operatorCommandOf(message(c.path, numbers))) << c.path;
    EXPECT_NE(complaintAbout(message(c.path, numbers)).find(c.said), std::string::npos)
        << complaintAbout(message(c.path, numbers));
  }
  const double half[] = {0.5}, far[] = {7};
  EXPECT_EQ(operatorCommandOf(message("/stadion/volume", half))->value, 0.5);
  EXPECT_TRUE(operatorCommandOf(message("/stadion/volume/by", far))->relative) << "it stops at the end";
}

TEST(OscOperator, WordsAndMissingNumbersAreToldOfTheirCommand) {
  EXPECT_EQ(
      complaintAbout(message("/stadion/pause", {}, false)),
      "OSC message \"/stadion/pause\" with what is no number is not taken: it takes 0 (off), 1 (on), or "
      "nothing");
  EXPECT_EQ(complaintAbout(message("/stadion/volume", {})),
            "OSC message \"/stadion/volume\" with nothing is not taken: it takes a number from 0 to 1");
  const double two[] = {1, 2};
  EXPECT_NE(complaintAbout(message("/stadion/step", two)).find("with 1 2 is not taken"), std::string::npos);
  EXPECT_NE(complaintAbout(message("/stadion/jump", {})).find("is no command"), std::string::npos);
  const double letGo[] = {0};
  EXPECT_EQ(complaintAbout(message("/stadion/step", letGo)), "") << "a button was let go";
}

}  // namespace
}  // namespace stadion
