/// The `stadion` program: one small file per subcommand.

#include "cli/bench_program.h"
#include "cli/commands.h"
#include "cli/program.h"

int main(int argc, char** argv) {
  using namespace stadion;
  if (isBench(argc, argv)) return startBench(argv);
  return runProgram(argc, argv, [](CLI::App& app, int& code, std::optional<unsigned> rasteriserThreads) {
    addRunCommand(app, code, rasteriserThreads);
    addCheckCommand(app, code);
    addNodesCommand(app, code);
    addHashCommand(app, code);
    addWallsCommand(app, code);
    describeBench(app);
    addFitCommand(app, code);
    addProfileCommand(app, code);
    addPlanCommand(app, code);
    addRegressCommand(app, code);
    addSoakCommand(app, code);
    addTestCommand(app, code);
    addViewCommand(app, code, rasteriserThreads);
    addTrackerCommand(app, code);
    addCalibrateCommand(app, code);
    addClusterCommand(app, code);
    addMergeTracesCommand(app, code);
    addDoctorCommand(app, code);
  });
}
