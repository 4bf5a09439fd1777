#include "show/base/async_log_writer.h"

#include <gtest/gtest.h>

#include <mutex>
#include <string>
#include <vector>

namespace stadion {
namespace {

TEST(AsyncLogWriter, ACallerDoesNotWaitForTheWriterAndEverythingIsWritten) {
  std::mutex held;  // as a terminal may be
  std::vector<std::string> said;
  {
    AsyncLogWriter teller([&](const std::string& line) {
      const std::lock_guard lock(held);
      said.push_back(line);
    });
    const std::lock_guard lock(held);
    for (const char* line : {"one", "two", "three"}) teller.write(line);
  }
  EXPECT_EQ(said, (std::vector<std::string>{"one", "two", "three"}));
}

TEST(AsyncLogWriter, LinesWithoutAReaderAreKeptUpToALimit) {
  std::mutex held;
  std::size_t said = 0;
  {
    AsyncLogWriter teller([&](const std::string&) {
      const std::lock_guard lock(held);
      ++said;
    });
    const std::lock_guard lock(held);
    for (int i = 0; i < 5000; ++i) teller.write("again");
  }
  EXPECT_GE(said, 1000U);
  EXPECT_LE(said, 1001U);
}

}  // namespace
}  // namespace stadion
