#pragma once
/// The result of a test run, as ctest reports it.

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace stadion {

/// Counts of a test run. A test that ctest could not start counts as failed.
struct TestResults {
  std::size_t passed = 0, failed = 0;
  std::vector<std::pair<std::string, std::string>> skipped{};  ///< name and reason
};

/// Reads the JUnit file that ctest writes with `--output-junit`. Text that is no such file gives no results.
TestResults testResultsOf(const std::string& junit);

/// The last line of `stadion test`: "N passed, N failed, N skipped".
std::string closingLine(const TestResults& results);

}  // namespace stadion
