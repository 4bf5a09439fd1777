#pragma once
/// `stadion bench plan`: is what is predicted what comes?

namespace CLI {
class App;
}

namespace stadion {

void addBenchPlan(CLI::App& bench, int& code);

}  // namespace stadion
