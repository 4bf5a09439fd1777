#pragma once
/// `stadion bench scale`: what a million nodes that stand still cost, beside a hundred that move.

namespace CLI {
class App;
}

namespace stadion {

void addBenchScale(CLI::App& bench, int& code);

}  // namespace stadion
