/// A file is there complete or not at all, also where links lead to it.

#include "engine/base/atomic_file.h"
#include "tests/fresh_folder.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>
#include <sys/wait.h>
#include <unistd.h>

namespace stadion {
namespace {

namespace fs = std::filesystem;

class AtomicFiles : public testing::Test {
protected:
  ~AtomicFiles() override { fs::remove_all(folder); }

  static std::string content(const fs::path& file) {
    std::stringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
  }
  std::size_t entries() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), {}));
  }

  fs::path folder = makeFreshFolder();
};

TEST_F(AtomicFiles, OfWritersThatAreGoneAreFoundAndOthersAreNot) {
  const fs::path file = folder / "a.input";
  EXPECT_EQ(partsOfKilledWriters(file).size(), 0U);
  const pid_t writer = fork();
  if (writer == 0) {
    const AtomicFile killed(file);
    _exit(0);
  }
  waitpid(writer, nullptr, 0);
  ASSERT_EQ(entries(), 1U);
  const std::vector<std::string> found{fs::directory_iterator(folder)->path()};
  EXPECT_NE(found[0].find("/.a.input." + std::to_string(writer) + "-"), std::string::npos) << found[0];
  const AtomicFile here(file);
  std::ofstream(folder / (".a.input.2." + std::to_string(writer) + "-0.part")) << "of another file";
  std::ofstream(folder / ".a.input.x-0.part") << "of no process";
  fs::create_symlink(file, folder / "link");
  EXPECT_EQ(partsOfKilledWriters(file), found);
  EXPECT_EQ(partsOfKilledWriters(folder / "link"), found);
  EXPECT_EQ(partsOfKilledWriters(folder / "b").size(), 0U);
}

TEST_F(AtomicFiles, AppearWhenTheyAreCompleteOrNotAtAll) {
  const fs::path file = folder / "a";
  ASSERT_FALSE(writeFile(file, "old"));
  {
    AtomicFile given(file);
    given.write("half");
    EXPECT_EQ(content(file), "old");
  }
  EXPECT_EQ(content(file), "old");
  EXPECT_FALSE(writeFile(file, "new"));
  EXPECT_EQ(content(file), "new");
  EXPECT_EQ(entries(), 1u) << "nothing else is left";
}

TEST_F(AtomicFiles, ThatLinksLeadToAreReplacedAndTheLinksStay) {
  fs::create_directory(folder / "kept");
  fs::create_symlink("kept/b", folder / "link");
  fs::create_symlink(folder / "link", folder / "link of a link");
  for (const char* text : {"into nothing", "over a file"}) {
    EXPECT_FALSE(writeFile(folder / "link of a link", text));
    EXPECT_TRUE(fs::is_symlink(folder / "link of a link"));
    EXPECT_TRUE(fs::is_symlink(folder / "link"));
    EXPECT_EQ(content(folder / "kept/b"), text);
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder / "kept"), {}), 1);
}

TEST_F(AtomicFiles, ThatCannotBeAreToldAtOnce) {
  fs::create_symlink("ring", folder / "ring");
  fs::create_symlink(folder, folder / "folder");
  fs::create_symlink("nowhere/file", folder / "astray");
  for (const char* name : {"ring", "folder", "astray", "nowhere/file"}) {
    const AtomicFile file(folder / name);
    ASSERT_TRUE(file.error()) << name;
    EXPECT_EQ(file.error()->where.file, folder / name);
  }
  EXPECT_TRUE(fs::is_symlink(folder / "ring"));
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  const auto wrong = writeFile(folder / "pipe", "writeFile() does not wait for a reader");
  ASSERT_TRUE(wrong);
  EXPECT_EQ(wrong->message, "cannot be written: it is a pipe without a reader");
}

/// As /dev/stdout is: what it leads to is open already, and stays the same file.
TEST_F(AtomicFiles, ThatAreOpenAreWrittenAsTheyAre) {
  const fs::path file = folder / "open";
  std::FILE* open = std::fopen(file.c_str(), "wb+");
  ASSERT_NE(open, nullptr);
  const fs::path link = folder / "stdout";
  fs::create_symlink("/proc/self/fd/" + std::to_string(fileno(open)), link);
  EXPECT_FALSE(writeFile(link, "said"));
  EXPECT_EQ(fs::hard_link_count(file), 1u);
  char text[8] = {};
  EXPECT_EQ(std::fread(text, 1, sizeof text, open), 4u) << "it is the same file";
  EXPECT_STREQ(text, "said");
  EXPECT_TRUE(fs::is_symlink(link));
  std::fclose(open);
}

}  // namespace
}  // namespace stadion
