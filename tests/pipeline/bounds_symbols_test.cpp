/// What is compiled for AVX2 shares no function with files that are not: a linker would keep either.

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <gtest/gtest.h>
#include <string>

namespace stadion {
namespace {

TEST(ProgramBoundsSymbols, TheFileForAvx2DefinesItsTableAlone) {
  const std::string object =
      STADION_BINARY_DIR "/CMakeFiles/stadion_pipeline.dir/pipeline/cull/bounds_eight.cpp.o";
  ASSERT_TRUE(std::filesystem::exists(object)) << object;
  FILE* names = popen(("nm --defined-only --extern-only '" + object + "'").c_str(), "r");
  ASSERT_TRUE(names);
  std::string all;
  for (int c = std::fgetc(names); c != EOF; c = std::fgetc(names)) all += static_cast<char>(c);
  ASSERT_EQ(pclose(names), 0);
  EXPECT_NE(all.find("kEightBounds"), std::string::npos) << all;
  EXPECT_EQ(std::count(all.begin(), all.end(), '\n'), 1) << all;
}

}  // namespace
}  // namespace stadion
