/// Graphics cards are found by their device files, before a driver is loaded.

#include "pipeline/target/graphics_card.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <unistd.h>

namespace stadion {
namespace {

class GraphicsCardFiles : public testing::Test {
protected:
  GraphicsCardFiles()
      : folder_(std::filesystem::temp_directory_path() / ("stadion-cards-" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_ / "dri");
  }
  ~GraphicsCardFiles() override { std::filesystem::remove_all(folder_); }
  std::string add(const std::string& name) const {
    std::ofstream(folder_ / name);
    return (folder_ / name).string();
  }

  std::filesystem::path folder_;
};

TEST_F(GraphicsCardFiles, ThereIsNoneWithoutARenderNode) {
  EXPECT_FALSE(graphicsCardFile(folder_));
  EXPECT_FALSE(graphicsCardFile(folder_ / "nowhere"));
  add("dri/card0"), add("nvidiactl"), add("nvidia-uvm"), add("dri/renderD");
  EXPECT_FALSE(graphicsCardFile(folder_)) << "these draw nothing by themselves";
}

TEST_F(GraphicsCardFiles, TheFirstRenderNodeCountsBeforeNvidiasDevice) {
  const std::string nvidia = add("nvidia0");
  EXPECT_EQ(graphicsCardFile(folder_), nvidia);
  add("dri/renderD129");
  const std::string first = add("dri/renderD128");
  EXPECT_EQ(graphicsCardFile(folder_), first);
}

}  // namespace
}  // namespace stadion
