/// `stadion bench recording` counts the instructions of runs of `stadion`.

#include "tests/programs/program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace stadion {
namespace {

/// Runs the program and writes a summary in proportion to its last argument, the count of frames.
constexpr const char* kValgrind = R"(#!/bin/sh
file=${2#--callgrind-out-file=}
shift 2
"$@" >/dev/null || exit
for last; do :; done
printf 'events: Ir\nsummary: %d\n' $((last * 1000)) >"$file"
)";

TEST(ProgramBenchRecording, CountsTheInstructionsOfRuns) {
  const TestFolder folder;
  const std::string valgrind = folder.write("valgrind", kValgrind);
  std::filesystem::permissions(valgrind, std::filesystem::perms::owner_all);
  const ProgramResult r = runProgram({{stadionPath(), "bench", "recording", "--rounds", "1", "--frames", "32",
                                       "--size", "16x12", "--within", "1000", "--json"},
                                      {"PATH=" + folder.path().string() + ":/usr/bin:/bin"}});
  ASSERT_EQ(r.status, 0) << r.err;
  const auto object = nlohmann::json::parse(r.out);
  EXPECT_EQ(object.at("bench"), "recording");
  EXPECT_NEAR(object.at("more_instructions"), 0, 1e-12);
}

TEST(ProgramBenchRecording, ReportsWhyARunFailed) {
  const TestFolder folder;
  const std::string valgrind = folder.write(
      "valgrind", "#!/bin/sh\necho 'stadion: no memory' >&2\necho '==1== I refs: 2' >&2\nexit 3\n");
  std::filesystem::permissions(valgrind, std::filesystem::perms::owner_all);
  const ProgramResult r =
      runProgram({{stadionPath(), "bench", "recording", "--rounds", "1", "--frames", "32", "--size", "16x12"},
                  {"PATH=" + folder.path().string() + ":/usr/bin:/bin"}});
  EXPECT_EQ(r.status, 2);
  EXPECT_TRUE(has(r.err, "exit status 3: stadion: no memory")) << r.err;
}

}  // namespace
}  // namespace stadion
