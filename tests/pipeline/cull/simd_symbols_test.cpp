/// What is compiled for AVX2 shares no function with files that are not: a linker would keep either.

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <gtest/gtest.h>
#include <string>

namespace stadion {
namespace {

/// What an object file of pipeline/ defines for others, a name a line.
std::string definedBy(const std::string& source) {
  const std::string object = STADION_BINARY_DIR "/CMakeFiles/stadion_pipeline.dir/pipeline/" + source + ".o";
  EXPECT_TRUE(std::filesystem::exists(object)) << object;
  FILE* names = popen(("nm --defined-only --extern-only '" + object + "'").c_str(), "r");
  if (!names) return {};
  std::string all;
  for (int c = std::fgetc(names); c != EOF; c = std::fgetc(names)) all += static_cast<char>(c);
  EXPECT_EQ(pclose(names), 0);
  return all;
}

TEST(ProgramSimdSymbols, FilesForAvx2DefineTheirTablesAlone) {
  const std::pair<const char*, const char*> files[] = {{"cull/bounds_eight.cpp", "kEightBounds"},
                                                       {"raster/cull_eight.cpp", "kCullByEight"}};
  for (const auto& [source, table] : files) {
    const std::string all = definedBy(source);
    EXPECT_NE(all.find(table), std::string::npos) << all;
    EXPECT_EQ(std::count(all.begin(), all.end(), '\n'), 1) << all;
  }
}

}  // namespace
}  // namespace stadion
