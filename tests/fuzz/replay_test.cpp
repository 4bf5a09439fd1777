/// What fuzzing found stays mended: every input of the corpus is read once more by its target, with any
/// compiler.

#include "tests/fuzz/packets.h"
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

template <class T>
void expectRead(const dds_topic_descriptor_t& type, Bytes bytes) {
  EXPECT_TRUE(Packet<T>(type, bytes));
}

/// Fails after a change of wire.idl, when no host can read them: write new ones (fuzz_seeds).
TEST(FuzzTargets, WhatTheCorpusOfTheClusterSaysIsRead) {
  using namespace cluster;
  for (const fs::path& path : corpusOf("cluster_wire")) {
    SCOPED_TRACE(path.filename().string());
    const std::vector<std::uint8_t> all = contentOf(path);
    for (Bytes left = all; left.size() >= 3;) {
      const Bytes bytes = left.subspan(3, std::min<std::size_t>(left.size() - 3, left[1] | left[2] << 8U));
      switch (static_cast<Step>(left[0])) {
      case Step::Session: expectRead<Session>(stadion_wire_Session_desc, bytes); break;
      case Step::Presence: expectRead<Presence>(stadion_wire_Presence_desc, bytes); break;
      case Step::Order: expectRead<Order>(stadion_wire_Order_desc, bytes); break;
      case Step::Drawn: expectRead<Drawn>(stadion_wire_Drawn_desc, bytes); break;
      case Step::Go: expectRead<Go>(stadion_wire_Go_desc, bytes); break;
      case Step::SceneHash: expectRead<SceneHash>(stadion_wire_SceneHash_desc, bytes); break;
      case Step::Difference: expectRead<Difference>(stadion_wire_Difference_desc, bytes); break;
      case Step::StatePart: expectRead<StatePart>(stadion_wire_StatePart_desc, bytes); break;
      default: break;
      }
      left = left.subspan(3 + bytes.size());
    }
  }
}

}  // namespace
}  // namespace stadion::fuzz
