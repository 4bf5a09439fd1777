/// What fuzzing found stays mended: every input of the corpus is read once more by its target, with any
/// compiler.

#include "tests/fuzz/targets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace stadion::fuzz {
namespace {

namespace fs = std::filesystem;

std::vector<std::uint8_t> contentOf(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

std::vector<fs::path> corpusOf(std::string_view target) {
  std::vector<fs::path> inputs;
  for (const auto& entry :
       fs::directory_iterator(fs::path(STADION_SOURCE_DIR) / "tests/fuzz/corpus" / target))
    inputs.push_back(entry.path());
  std::sort(inputs.begin(), inputs.end());
  return inputs;
}

class Fuzz : public testing::TestWithParam<Target> {};

TEST_P(Fuzz, TheCorpusBreaksNoPromise) {
  const std::vector<fs::path> inputs = corpusOf(GetParam().name);
  EXPECT_FALSE(inputs.empty());
  for (const fs::path& path : inputs) {
    SCOPED_TRACE(path.filename().string());
    GetParam().read(contentOf(path));
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, Fuzz, testing::ValuesIn(kTargets),
                         [](const testing::TestParamInfo<Target>& which) {
                           return std::string(which.param.name);
                         });

TEST(FuzzTargets, EachHasItsFileItsCorpusAndItsDictionary) {
  const fs::path folder = fs::path(STADION_SOURCE_DIR) / "tests/fuzz";
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(folder / "targets")) files += entry.is_regular_file();
  EXPECT_EQ(files, std::size(kTargets));
  for (const Target& t : kTargets) {
    EXPECT_TRUE(fs::exists(folder / "targets" / (std::string(t.name) + ".cpp"))) << t.name;
    EXPECT_TRUE(fs::exists(folder / "corpus" / t.name)) << t.name;
    EXPECT_TRUE(fs::exists(folder / "dictionaries" / (std::string(t.name) + ".dict"))) << t.name;
  }
}

}  // namespace
}  // namespace stadion::fuzz
