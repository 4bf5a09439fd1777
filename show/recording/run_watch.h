#pragma once
/// What happens in a show while it is played: hashes of its states, events, and the records that the settings
/// ask for (the input, the poses of nodes).
///
/// Threads  made before the run; see() on the App thread; read when the run is over.

#include "engine/input/input_recorder.h"
#include "pipeline/record/run_summary.h"
#include "show/player/play_settings.h"
#include "show/recording/node_trace.h"
#include "show/recording/record_settings.h"

#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace stadion {

class RunWatch {
public:
  /// Null, with the reason in the findings, if the show has no such node or the input cannot be recorded.
  static std::unique_ptr<RunWatch> create(const RecordSettings& record, const PlaySettings& play,
                                          Player& player, Diagnostics& findings);

  /// After each App stage.
  void see(const TimeSignature& now, const InputSample& input, const Scene& scene);
  /// From frame `frame` on the operator has it so.
  void order(std::uint64_t frame, const OperatorCommand& order) {
    if (recorder_) recorder_->order(frame, order);
  }
  /// Completes the records, once; says what could not be written. Not while see() may be called.
  std::optional<Diagnostic> finish();

  /// The frames before the first one were another process's; `history` was what it had of them.
  void goOnFrom(std::uint64_t history) { historyHash_ = history; }
  /// The last of them was this one, and the scene is as it was then.
  void goOnAfter(const TimeSignature& frame, const Scene& scene);
  /// Hash of the states of all frames up to now.
  std::uint64_t history() const { return historyHash_; }
  /// Show time of the last frame seen.
  Nanoseconds time() const { return last_.time; }
  /// The distances that were measured.
  const std::vector<MeasuredDistance>& measured() const { return measured_; }
  const std::vector<NodeTrace>& traces() const { return traces_; }
  /// Writes down what was seen in `frames` frames.
  void addTo(RunSummary& summary, std::uint64_t frames) const;

private:
  explicit RunWatch(Player& player) : player_(player) {}
  void recordInput(const std::string& file, bool everyFrame, Diagnostics& findings);
  void note(const EventRecord& event, const Scene& scene);
  void note(const DegradationDecision& decision, const Scene& scene);
  void addObeyed(RunSummary& summary) const;

  Player& player_;
  std::unique_ptr<InputRecorder> recorder_;
  bool finished_ = false;
  std::vector<NodeTrace> traces_;
  TimeSignature last_;
  std::uint64_t stateHash_ = 0, historyHash_ = 0, visited_ = 0, published_ = 0, delivered_ = 0, lost_ = 0;
  std::vector<ShowEvent> events_;
  std::vector<MeasuredDistance> measured_;
  std::uint64_t eventCount_ = 0;
  std::map<NodeRef, ReplayedDegradation> givenUp_;  ///< {}: by the whole show, its stress
};

}  // namespace stadion
