/// The `stadion` program: one small file per subcommand.

#include "cli/commands.h"
#include "cli/other_program.h"
#include "cli/program.h"

int main(int argc, char** argv) {
  using namespace stadion;
  if (const CommandElsewhere* command = commandElsewhere(argc, argv)) return startProgramOf(*command, argv);
  return runProgram(argc, argv, [](CLI::App& app, int& code, std::optional<unsigned> rasteriserThreads) {
    addRunCommand(app, code, rasteriserThreads);
    addCheckCommand(app, code);
    addNodesCommand(app, code);
    addHashCommand(app, code);
    addWallsCommand(app, code);
    describeElsewhere(app, "bench");
    describeElsewhere(app, "fit");
    describeElsewhere(app, "profile");
    describeElsewhere(app, "plan");
    describeElsewhere(app, "regress");
    describeElsewhere(app, "soak");
    addTestCommand(app, code);
    addViewCommand(app, code, rasteriserThreads);
    addTrackerCommand(app, code);
    describeElsewhere(app, "calibrate");
    addClusterCommand(app, code);
    addMergeTracesCommand(app, code);
    addDoctorCommand(app, code);
    addProjectorsCommand(app, code);
  });
}
