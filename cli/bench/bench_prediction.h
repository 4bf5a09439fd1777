#pragma once
/// `stadion bench prediction`: how far a head is from where its picture shows it, with and without
/// prediction.

namespace CLI {
class App;
}

namespace stadion {

void addBenchPrediction(CLI::App& bench, int& code);

}  // namespace stadion
