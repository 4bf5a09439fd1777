#include "show/output/picture_hashes.h"
#include "tests/programs/program.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

TEST(PictureHashes, GoOnWithAWholeLineAfterARunThatWasKilledInTheMiddleOfOne) {
  for (const char* left :
       {"", "0 front left 0123456789abcdef\n", "0 front left 0123456789abcdef\n1 fro", "0 fro"}) {
    const TestFolder folder;
    const std::string hashes = folder.write(PictureHashes::kHashes, left),
                      times = folder.write(PictureHashes::kTimes, "0 1000\n1 10");
    const auto out = OutputFolder::open(folder.path());
    ASSERT_TRUE(out);
    EyePictures wall;
    wall.frame = 2, wall.eyes.emplace_back(1, 1);
    PictureHashes further(*out.value(), {"front"}, true);
    EXPECT_FALSE(
        further.add(2, {wall}, std::chrono::steady_clock::time_point(std::chrono::nanoseconds(2000))));
    std::string whole = left;
    whole.resize(whole.rfind('\n') + 1);
    const std::string text = fileContent(hashes);
    EXPECT_TRUE(text.starts_with(whole + "2 front left ")) << text;
    EXPECT_EQ(text.size(), whole.size() + std::string("2 front left 0123456789abcdef\n").size()) << text;
    EXPECT_EQ(fileContent(times), "0 1000\n2 2000\n");
  }
}

}  // namespace
}  // namespace stadion
