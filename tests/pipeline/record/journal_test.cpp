/// A run log stays in bounds, and each line of it in one piece.

#include "pipeline/record/journal.h"
#include "tests/fresh_folder.h"

#include <gtest/gtest.h>

#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sys/file.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace stadion {
namespace {

namespace fs = std::filesystem;

class JournalTest : public testing::Test {
protected:
  ~JournalTest() override { fs::remove_all(folder_); }

  static std::vector<std::string> linesOf(const std::string& file) {
    std::vector<std::string> lines;
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
  }
  std::unique_ptr<Journal> open(std::size_t limit = Journal::kStandardLimit) {
    auto made = Journal::open(file_, limit);
    EXPECT_TRUE(made) << made.error().message;
    return std::move(made.value());
  }

  fs::path folder_ = makeFreshFolder();
  std::string file_ = folder_ / "run.log";
};

TEST_F(JournalTest, ALineHasDateTimeAndPlaceAndIsAdded) {
  open()->add("first");
  const auto journal = open();
  journal->add("tracker head has\nfallen \x1b silent\n", Journal::Place{12'350'000'000, 741});
  const auto lines = linesOf(file_);
  ASSERT_EQ(lines.size(), 2U);
  const std::string date = "\\d{4}-\\d\\d-\\d\\d \\d\\d:\\d\\d:\\d\\d\\.\\d{3} [+-]\\d{4}  ";
  EXPECT_TRUE(std::regex_match(lines[0], std::regex(date + "-  first"))) << lines[0];
  EXPECT_TRUE(
      std::regex_match(lines[1], std::regex(date + "t=12\\.350 f=741  tracker head has fallen   silent")))
      << lines[1];
}

TEST_F(JournalTest, GrowsToItsLimitAndKeepsThreeOlderFiles) {
  constexpr std::size_t kLimit = 2000;
  const auto journal = open(kLimit);
  for (int i = 0; i < 1000; ++i) journal->add("line " + std::to_string(i));
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(folder_)) {
    EXPECT_LE(fs::file_size(entry.path()), kLimit) << entry.path();
    ++files;
  }
  EXPECT_EQ(files, 4U);
  EXPECT_TRUE(linesOf(file_).back().ends_with("line 999"));
  const auto older = linesOf(file_ + ".1");
  const std::string next = linesOf(file_).front();
  const auto number = [](const std::string& line) { return std::stoi(line.substr(line.rfind(' '))); };
  EXPECT_EQ(number(next), number(older.back()) + 1) << "nothing is lost between two files";
}

TEST_F(JournalTest, TwoProcessesMayWriteTheSameFile) {
  constexpr std::size_t kLimit = 20'000;
  constexpr int kEach = 150;
  const pid_t other = fork();
  const auto journal = open(kLimit);
  for (int i = 0; i < kEach; ++i) journal->add((other == 0 ? "child " : "parent ") + std::to_string(i));
  if (other == 0) _exit(0);
  int status = -1;
  waitpid(other, &status, 0);
  std::set<std::string> seen;
  for (const auto& entry : fs::directory_iterator(folder_))
    for (const std::string& line : linesOf(entry.path())) seen.insert(line.substr(line.find("-  ") + 3));
  EXPECT_EQ(seen.size(), 2U * kEach) << "every line is there, whole";
}

TEST_F(JournalTest, TheFirstLineThatIsLostIsToldAndTheNextOneThatIsNotSaysHowManyWere) {
  const auto journal = open();
  EXPECT_FALSE(journal->add("first"));
  EXPECT_FALSE(journal->incomplete());
  fs::remove_all(folder_);
  const auto why = journal->add("second");
  ASSERT_TRUE(why);
  EXPECT_EQ(*why, file_ + ": cannot be written: No such file or directory");
  EXPECT_FALSE(journal->add("third")) << "it is known";
  fs::create_directories(folder_);
  EXPECT_FALSE(journal->add("fourth"));
  EXPECT_TRUE(journal->incomplete());
  const auto lines = linesOf(file_);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_TRUE(lines[0].ends_with("  -  2 lines before this one could not be written")) << lines[0];
  EXPECT_TRUE(lines[1].ends_with("  -  fourth")) << lines[1];
}

TEST_F(JournalTest, ALockOnTheFileDelaysNoWriter) {
  const auto journal = open();
  journal->add("before");
  const int other = ::open(file_.c_str(), O_RDONLY | O_CLOEXEC);
  ASSERT_EQ(flock(other, LOCK_EX), 0);
  std::optional<std::string> why = "not yet";
  std::thread writer([&] { why = journal->add("meanwhile"); });
  for (int i = 0; i < 2400 && linesOf(file_).size() < 2; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_EQ(linesOf(file_).size(), 2U) << "while it is held";
  ::close(other);
  writer.join();
  EXPECT_FALSE(why) << *why;
}

TEST_F(JournalTest, WhatCannotBeWrittenIsRefusedWhenItIsOpened) {
  EXPECT_FALSE(Journal::open(folder_ / "none" / "run.log"));
  EXPECT_FALSE(Journal::open(folder_));
  EXPECT_FALSE(Journal::open("/dev/null"));
}

}  // namespace
}  // namespace stadion
