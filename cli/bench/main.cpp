/// The program `stadion-bench`: the measurements of `stadion bench`.

#include "cli/commands.h"
#include "cli/program.h"

int main(int argc, char** argv) {
  return stadion::runProgram(argc, argv, [](CLI::App& app, int& code, std::optional<unsigned>) {
    stadion::addBenchCommand(app, code);
  });
}
