/// `stadion test`: the test suite, through ctest. (The launcher has built it.)

#include "cli/commands.h"
#include "cli/exit_code.h"
#include "cli/options/command_options.h"
#include "cli/test_results.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace stadion {
namespace {

/// Returns true for a line of ctest that reports only the start or success of a test. In a file or a CI log,
/// thousands of them bury the one test that failed; at a terminal they show progress.
bool tellsOfSuccessOnly(const std::string& line) {
  return line.find("  Start ") != std::string::npos || line.find("   Passed  ") != std::string::npos;
}

/// Runs `line` in a shell and shows what it prints. Returns its status, as of waitpid.
int runShowingFailures(const std::string& line) {
  if (isatty(STDOUT_FILENO)) return std::system(line.c_str());
  std::FILE* output = popen(line.c_str(), "r");
  if (!output) return -1;
  char* text = nullptr;
  std::size_t size = 0;
  while (getline(&text, &size, output) > 0)
    if (!tellsOfSuccessOnly(text)) {
      std::fputs(text, stdout);
      std::fflush(stdout);
    }
  std::free(text);
  return pclose(output);
}

TestResults readResults(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return testResultsOf(std::string(std::istreambuf_iterator<char>(in), {}));
}

/// Many tests wait for a show's clock most of the time. More at once would take the processors from shows
/// that play in real time.
unsigned testsAtATime() {
  return std::max(2U, std::thread::hardware_concurrency() * 2);
}

/// Names each skipped test with its reason, then prints the closing line.
void printResults(const TestResults& results) {
  std::printf("\n");
  for (const auto& [name, reason] : results.skipped)
    std::printf("skipped: %s: %s\n", name.c_str(), reason.c_str());
  std::printf("%s\n", closingLine(results).c_str());
}

}  // namespace

void addTestCommand(CLI::App& app, int& code) {
  struct Options {
    bool full = false;
    std::string only, summarize;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("test", "Run the test suite");
  CommandOptions bound(*command);
  bound.add("--full", options->full);
  bound.add("--only", options->only);
  bound.add("--summarize", options->summarize);
  command->callback([options, &code] {
    const auto conclude = [&code](const TestResults& results, bool ended) {
      printResults(results);
      code = ended && results.failed == 0 ? kOk : kCheckFailed;
    };
    if (!options->summarize.empty()) {
      const TestResults results = readResults(options->summarize);
      return conclude(results, results.passed + results.failed + results.skipped.size() > 0);
    }
    const std::string folder = std::filesystem::canonical("/proc/self/exe").parent_path().parent_path();
    if (options->full) setenv("STADION_FULL", "1", 1);
    if (!options->only.empty()) setenv("STADION_ONLY", options->only.c_str(), 1);
    const std::string report = folder + "/tests/results.xml";
    std::filesystem::create_directories(folder + "/tests");
    std::filesystem::remove(report);
    const std::string line = "ctest --test-dir '" + folder + "' --output-on-failure --no-tests=error -j" +
                             std::to_string(testsAtATime()) + " --output-junit '" + report + "'" +
                             (options->full ? "" : " -E '^ProgramFull'") +
                             (options->only.empty() ? "" : " -R \"$STADION_ONLY\"");
    const int status = runShowingFailures(line);
    if (!options->full)
      std::printf(
          "\nThe acceptance counts and the tests that measure time (ProgramFull...) belong to --full.\n");
    conclude(readResults(report), WIFEXITED(status) && WEXITSTATUS(status) == 0);
  });
}

}  // namespace stadion
