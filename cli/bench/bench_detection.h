#pragma once
/// `stadion bench detection`: are planted slowdowns found, and is nothing found where nothing is?

namespace CLI {
class App;
}

namespace stadion {

void addBenchDetection(CLI::App& bench, int& code);

}  // namespace stadion
