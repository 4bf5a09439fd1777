#pragma once
/// `stadion bench attribution`: how much of the frame is found with nodes. `stadion bench recording`: what
/// finding it costs.

namespace CLI {
class App;
}

namespace stadion {

void addBenchAttribution(CLI::App& bench, int& code);
void addBenchRecording(CLI::App& bench, int& code);

}  // namespace stadion
