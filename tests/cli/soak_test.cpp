/// A short soak, and one that is taken up again.

#include "tests/cli/program.h"

#include <gtest/gtest.h>

#include <fstream>

namespace stadion {
namespace {

bool holds(const std::string& text, const std::string& what) {
  return text.find(what) != std::string::npos;
}

TEST(ProgramSoak, SomeThousandFramesAreTheSameInEveryWayAndInEveryProcess) {
  const TemporaryFolder folder;
  const std::string record = folder.path() / "soak.record";
  const ProgramResult first =
      stadionProgram({"soak", "--frames", "3000", "--visit", "1000", "--no-memory", "--record", record});
  EXPECT_EQ(first.status, 0) << first.out << first.err;
  EXPECT_TRUE(holds(first.out, "3000 frames in 3 visits by 1 processes")) << first.out;
  EXPECT_TRUE(holds(first.out, "states: 0 of 4 histories compared differ")) << first.out;
  EXPECT_TRUE(holds(first.out, "time steps: 0 of 3000")) << first.out;
  EXPECT_TRUE(holds(first.out, " 1 walls' processes killed")) << first.out;
  EXPECT_FALSE(holds(first.out, " 0 throws")) << first.out;
  EXPECT_FALSE(holds(first.out, " 0 measurements refused")) << first.out;
  std::ofstream(record, std::ios::app) << "{\"sample\": [0, 12";  // as a killed run leaves it
  const ProgramResult more =
      stadionProgram({"soak", "--frames", "5000", "--visit", "1000", "--no-memory", "--record", record});
  EXPECT_EQ(more.status, 0) << more.out << more.err;
  EXPECT_TRUE(holds(more.out, "by 2 processes")) << more.out;
  EXPECT_TRUE(holds(more.out, "states: 0 of ")) << more.out;
}

TEST(ProgramSoak, MemoryThatCouldNotBeJudgedIsNoPass) {
  const ProgramResult r = stadionProgram({"soak", "--frames", "1000", "--visit", "1000"});
  EXPECT_EQ(r.status, 1) << r.out << r.err;
  EXPECT_TRUE(holds(r.out, "FAILED memory was not judged")) << r.out;
  EXPECT_TRUE(holds(r.out, "time steps: 0 of 1000")) << r.out;
}

TEST(ProgramSoak, ARecordOfAnotherSoakIsRefusedAndLeftAlone) {
  const TemporaryFolder folder;
  const std::string record = folder.write("notes.txt", "not a record\n");
  const ProgramResult r = stadionProgram({"soak", "--frames", "1000", "--no-memory", "--record", record});
  EXPECT_EQ(r.status, 2);
  EXPECT_TRUE(holds(r.err, "is no record of this soak")) << r.err;
  EXPECT_EQ(fileContent(record), "not a record\n");
}

TEST(ProgramSoak, AStateThatIsNotThatOfBeforeFails) {
  const TemporaryFolder folder;
  const std::string record = folder.path() / "soak.record";
  ASSERT_EQ(stadionProgram({"soak", "--frames", "1000", "--visit", "1000", "--no-memory", "--record", record})
                .status,
            0);
  std::string text = fileContent(record);
  const std::size_t at = text.find("\"history\":");
  ASSERT_NE(at, std::string::npos);
  text.insert(text.find_first_of("0123456789", at), "1");
  folder.write("soak.record", text.substr(0, text.find('\n', at) + 1));
  const ProgramResult r =
      stadionProgram({"soak", "--frames", "1000", "--visit", "1000", "--no-memory", "--record", record});
  EXPECT_EQ(r.status, 1) << r.out << r.err;
  EXPECT_TRUE(holds(r.err, "has another history of states than before")) << r.err;
}

}  // namespace
}  // namespace stadion
