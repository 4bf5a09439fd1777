#include "cli/other_program.h"

#include "cli/exit_code.h"
#include "cli/options/command_programs.h"
#include "engine/base/installed_files.h"

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>
#include <unistd.h>

namespace stadion {

const CommandElsewhere* commandElsewhere(int argc, char** argv) {
  if (argc < 2) return nullptr;
  const bool completes = argc > 3 && std::string_view(argv[1]) == "complete";
  return findElsewhere(argv[completes ? 2 : 1]);
}

int startProgramOf(const CommandElsewhere& command, char** argv) {
  const std::string program = helperProgram(std::string(command.program));
  ::execvp(program.c_str(), argv);
  const std::string name(command.command);
  const std::string mend =
      errno == ENOENT ? "; in a checkout, `./stadion " + name + "` builds it" : std::string();
  std::fprintf(stderr, "stadion: the program of `%s` (%s) cannot be started: %s%s\n", name.c_str(),
               program.c_str(), std::strerror(errno), mend.c_str());
  return kBadInput;
}

void describeElsewhere(CLI::App& app, std::string_view command) {
  addListedCommand(app, command)->prefix_command();
}

}  // namespace stadion
