/// Files of a show's state that were damaged since they were written.

#include "show/recording/state_file.h"

#include "show/player/player.h"
#include "tests/programs/program.h"

#include <fstream>
#include <gtest/gtest.h>

namespace stadion {
namespace {

class StateFiles : public ::testing::Test {
protected:
  void SetUp() override {
    ShowOptions options;
    options.script = folder_.write("small.evs", "group( name=whole )\n");
    options.walls = "desktop";
    options.input = "none";
    options.assetRoots = {assetFolder()};
    Diagnostics findings;
    ASSERT_TRUE(options.complete(findings));
    player_ = Player::create(options, findings);
    ASSERT_TRUE(player_);
    ASSERT_FALSE(saveState(player_->scene(), file_));
    bytes_ = fileContent(file_);
  }

  Result<StateFile> readBytes(const std::string& bytes) const {
    std::ofstream(file_, std::ios::binary) << bytes;
    return StateFile::read(file_);
  }

  TestFolder folder_;
  std::string file_ = folder_.path() / "state";
  std::unique_ptr<Player> player_;
  std::string bytes_;
};

TEST_F(StateFiles, AWholeFileIsEqualToItsScene) {
  const auto state = StateFile::read(file_);
  ASSERT_TRUE(state) << state.error().message;
  EXPECT_FALSE(state.value().differenceFrom(player_->scene()));
}

TEST_F(StateFiles, EveryTruncationIsDamaged) {
  for (std::size_t size = 1; size < bytes_.size(); ++size) {
    const auto state = readBytes(bytes_.substr(0, size));
    ASSERT_FALSE(state) << size << " of " << bytes_.size() << " bytes";
    ASSERT_TRUE(state.error().message.starts_with("is damaged")) << size << state.error().message;
  }
}

TEST_F(StateFiles, EveryChangedByteIsDamage) {
  for (std::size_t at = 0; at < bytes_.size(); ++at) {
    std::string changed = bytes_;
    changed[at] = static_cast<char>(~changed[at]);
    ASSERT_FALSE(readBytes(changed)) << at << " of " << bytes_.size();
  }
}

// An earlier build wrote no checksum.
TEST_F(StateFiles, AnEarlierFileIsReadAndItsTruncationsAreDamaged) {
  const std::string end = "stadion fields 2";
  const std::string earlier =
      bytes_.substr(0, bytes_.size() - end.size() - sizeof(std::uint64_t)) + "stadion fields 1";
  const auto state = readBytes(earlier);
  ASSERT_TRUE(state) << state.error().message;
  EXPECT_FALSE(state.value().differenceFrom(player_->scene()));
  EXPECT_FALSE(readBytes(earlier.substr(0, earlier.size() - 1)));
}

}  // namespace
}  // namespace stadion
