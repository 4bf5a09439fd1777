#pragma once
/// The subcommands. Each adds itself to the program and, when it has run, leaves its exit status in `code`.

#include <optional>

namespace CLI {
class App;
}

namespace stadion {

/// `rasteriserThreads`: if the environment gave them.
void addRunCommand(CLI::App& app, int& code, std::optional<unsigned> rasteriserThreads);
void addCalibrateCommand(CLI::App& app, int& code);
void addCheckCommand(CLI::App& app, int& code);
void addClusterCommand(CLI::App& app, int& code);
void addDoctorCommand(CLI::App& app, int& code);
void addMergeTracesCommand(CLI::App& app, int& code);
void addNodesCommand(CLI::App& app, int& code);
void addHashCommand(CLI::App& app, int& code);
void addProjectorsCommand(CLI::App& app, int& code);
void addWallsCommand(CLI::App& app, int& code);
void addBenchCommand(CLI::App& app, int& code);
void addFitCommand(CLI::App& app, int& code);
void addPlanCommand(CLI::App& app, int& code);
void addProfileCommand(CLI::App& app, int& code);
void addRegressCommand(CLI::App& app, int& code);
void addSoakCommand(CLI::App& app, int& code);
void addTestCommand(CLI::App& app, int& code);
void addViewCommand(CLI::App& app, int& code, std::optional<unsigned> rasteriserThreads);
void addTrackerCommand(CLI::App& app, int& code);

}  // namespace stadion
