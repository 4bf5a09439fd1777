#pragma once
/// `stadion bench budgets`.

namespace CLI {
class App;
}

namespace stadion {

void addBenchBudgets(CLI::App& bench, int& code);

}  // namespace stadion
