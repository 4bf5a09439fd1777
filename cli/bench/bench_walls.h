#pragma once
/// `stadion bench walls`.

namespace CLI {
class App;
}

namespace stadion {

void addBenchWalls(CLI::App& bench, int& code);

}  // namespace stadion
