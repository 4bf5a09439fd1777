#pragma once
/// What the figures of a scene play, by number.
///
/// A figure's instance carries its number, and the later stages find here what it plays. All figures are
/// published together, in each frame in which one of them has changed.
///
/// Threads  App only.
/// Errors   numbers are the caller's to keep. Beyond kMostFigures at a time add() returns 0: such a figure
///          stands at rest.

#include "engine/figure/figure_record.h"
#include "engine/published/records.h"

#include <cstdint>
#include <vector>

namespace stadion {

class StateFields;

class FigureRecords {
public:
  using Number = std::uint16_t;

  // For nodes.

  Number add();
  void remove(Number number);
  void set(Number number, const FigureRecord& playing);
  /// Returns true if the number is in use; nodes ask this when they are restored.
  bool has(Number number) const { return number > 0 && number <= used_.size() && used_[number - 1u] != 0; }

  // For the scene.

  void publish(ChangeSet& changes);
  void state(StateFields& f);
  /// After state() has restored: publishes all.
  void resume() { changed_ = true; }

private:
  std::vector<char> used_;             ///< by number - 1
  std::vector<FigureRecord> playing_;  ///< likewise
  bool changed_ = false;
};

}  // namespace stadion
