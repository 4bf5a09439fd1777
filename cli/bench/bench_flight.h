#pragma once
/// `stadion bench flight`: the flight models against exact ones, integrators, costs, published throws.

namespace CLI {
class App;
}

namespace stadion {

/// Adds itself to the command `bench`.
void addBenchFlight(CLI::App& bench, int& code);

}  // namespace stadion
