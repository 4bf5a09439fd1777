#pragma once
/// `run --spans FILE`: what stages and nodes cost, frame by frame, for `stadion regress`.
///
/// Ownership  borrows the player, which must outlive it.

#include "profiling/regression/spans/instruction_counter.h"
#include "profiling/regression/spans/span_times.h"
#include "show/player/player.h"
#include "show/recording/span_options.h"

#include <memory>
#include <optional>

namespace stadion {

class SpanRecording {
public:
  /// Null if nothing is to be recorded, or something is wrong; the findings say what.
  static std::unique_ptr<SpanRecording> create(const SpanOptions& options, Player& player,
                                               Diagnostics& findings);

  FrameProbe* probe() { return &*times_; }
  /// Writes the record.
  std::optional<Diagnostic> finish();

private:
  SpanRecording(const SpanOptions& options, Player& player) : options_(options), player_(player) {}
  bool count(regression::SpanTimesOptions& times, Diagnostics& findings);
  bool plant(regression::SpanTimesOptions& times, Diagnostics& findings);

  const SpanOptions& options_;
  Player& player_;
  regression::Turns turns_{0};
  std::optional<regression::InstructionCounter> counter_;
  std::optional<regression::SpanTimes> times_;
};

/// Fills in which node a row is about.
void nameNode(const Scene& scene, NodeRef node, regression::SpanRow& row);

}  // namespace stadion
