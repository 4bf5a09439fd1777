/// `stadion doctor` in an environment that lacks something.

#include "tests/programs/program.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace stadion {
namespace {

ProgramResult doctor(const std::vector<std::string>& more) {
  std::vector<std::string> words{stadionPath(), "doctor"};
  words.insert(words.end(), more.begin(), more.end());
  return runProgram({words, {"PATH=/nonexistent", "DISPLAY=", "WAYLAND_DISPLAY="}});
}

TEST(ProgramDoctor, SaysWhatIsMissingAndHowItIsMended) {
  const ProgramResult r = doctor({});
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_NE(r.out.find("missing  video"), std::string::npos) << r.out;
  const std::string install =
      geteuid() == 0 ? "do: apt-get install ffmpeg" : "do: sudo apt-get install ffmpeg";
  EXPECT_NE(r.out.find(install), std::string::npos) << r.out;
  EXPECT_NE(r.out.find("missing  displays"), std::string::npos) << r.out;
}

TEST(ProgramDoctor, EndsWithOneIfWhatWasAskedForCannotWork) {
  EXPECT_EQ(doctor({"--for", "video"}).status, 1);
  EXPECT_EQ(doctor({"--for", STADION_SOURCE_DIR "/walls/cave4.walls"}).status, 1) << "there is no display";
  EXPECT_EQ(doctor({"--for", "programs", "--for", STADION_SOURCE_DIR "/scripts/kick.evs"}).status, 0);
  const ProgramResult wrong = doctor({"--for", "vidio"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_NE(wrong.err.find("did you mean \"video\"?"), std::string::npos) << wrong.err;
}

TEST(ProgramDoctor, SaysThatTheAddressSpaceIsLimited) {
  for (const char* limit : {"300000", "400000", "1000000", "8000000"}) {
    const ProgramResult r = runProgram(
        {{"/bin/bash", "-c", std::string("ulimit -v ") + limit + "; exec \"$0\" doctor", stadionPath()}});
    EXPECT_EQ(r.status, 2) << limit << r.err;
    EXPECT_NE(r.err.find("error: the address space is limited to "), std::string::npos) << limit << r.err;
  }
}

TEST(ProgramDoctor, PrintsOneJsonObject) {
  const ProgramResult r = doctor({"--json", "--for", "video"});
  EXPECT_EQ(r.status, 1);
  const auto j = nlohmann::json::parse(r.out);
  EXPECT_EQ(j["can_work"], false);
  EXPECT_TRUE(std::ranges::any_of(j["findings"], [](const auto& f) {
    return f["topic"] == "video" && f["health"] == "missing" && f["asked"] == true;
  }));
}

}  // namespace
}  // namespace stadion
