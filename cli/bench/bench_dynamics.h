#pragma once
/// `stadion bench dynamics`: Stadion beside other engines, error beside cost.

namespace CLI {
class App;
}

namespace stadion {

void addBenchDynamics(CLI::App& bench, int& code);

}  // namespace stadion
