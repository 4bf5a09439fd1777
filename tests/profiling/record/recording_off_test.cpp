/// Without recording nothing is called: a probe has virtual functions only, so that without an object
/// there is nothing to call, and what tests for it is compiled into the stages.

#include <array>
#include <cstdio>
#include <gtest/gtest.h>
#include <memory>
#include <string>

namespace stadion {
namespace {

/// What a command writes.
std::string outputOf(const std::string& command) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::string text;
  std::array<char, 4096> part{};
  while (pipe && std::fgets(part.data(), static_cast<int>(part.size()), pipe.get())) text += part.data();
  return text;
}

TEST(ProgramRecordingOff, TheFloorsThatAreRecordedCallNothingOfARecordingByName) {
  for (const char* floor : {"engine", "pipeline", "dynamics"}) {
    const std::string symbols =
        outputOf("nm -C -u " STADION_BINARY_DIR "/libstadion_" + std::string(floor) + ".a 2>/dev/null");
    ASSERT_GT(symbols.size(), 1000U) << floor;
    for (const char* name : {"FrameProbe::", "SpanScope", "FrameLog", "SpanTrack", "allocationsSoFar"})
      EXPECT_EQ(symbols.find(name), std::string::npos)
          << floor << " calls " << symbols.substr(symbols.rfind('\n', symbols.find(name)) + 1, 200);
  }
}

}  // namespace
}  // namespace stadion
