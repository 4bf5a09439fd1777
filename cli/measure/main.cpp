/// The program `stadion-measure`: the commands that measure, plan and compare shows.

#include "cli/commands.h"
#include "cli/program.h"

int main(int argc, char** argv) {
  using namespace stadion;
  return runProgram(argc, argv, [](CLI::App& app, int& code, std::optional<unsigned>) {
    addFitCommand(app, code);
    addProfileCommand(app, code);
    addPlanCommand(app, code);
    addRegressCommand(app, code);
    addSoakCommand(app, code);
    addCalibrateCommand(app, code);
  });
}
