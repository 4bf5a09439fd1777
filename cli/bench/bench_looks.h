#pragma once
/// `stadion bench looks`: what does each rung of the ladder of pictures cost, and how near is it to the best?

namespace CLI {
class App;
}

namespace stadion {

void addBenchLooks(CLI::App& bench, int& code);

}  // namespace stadion
