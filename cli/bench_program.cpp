#include "cli/bench_program.h"

#include "cli/exit_code.h"
#include "engine/base/installed_files.h"

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string_view>
#include <unistd.h>

namespace stadion {

bool isBench(int argc, char** argv) {
  const auto isWord = [&](int at, std::string_view word) { return argc > at && argv[at] == word; };
  return isWord(1, "bench") || (isWord(1, "complete") && isWord(2, "bench") && argc > 3);
}

int startBench(char** argv) {
  const std::string program = helperProgram("stadion-bench");
  ::execvp(program.c_str(), argv);
  std::fprintf(stderr, "stadion: the benchmarks (%s) cannot be started: %s%s\n", program.c_str(),
               std::strerror(errno), errno == ENOENT ? "; in a checkout, `./stadion bench` builds them" : "");
  return kBadInput;
}

void describeBench(CLI::App& app) {
  app.add_subcommand("bench", "Measure, and fail when a limit is missed")->prefix_command();
}

}  // namespace stadion
