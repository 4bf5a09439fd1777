#include "engine/scene/figure_records.h"

#include "engine/core/state_fields.h"

#include <algorithm>

namespace stadion {

FigureRecords::Number FigureRecords::add() {
  auto at = std::ranges::find(used_, 0);
  if (at == used_.end()) {
    if (used_.size() >= kMostFigures) return 0;
    at = used_.insert(used_.end(), 0);
    playing_.emplace_back();
  }
  *at = 1;
  const auto index = static_cast<std::size_t>(at - used_.begin());
  playing_[index] = {};
  changed_ = true;
  return static_cast<Number>(index + 1);
}

void FigureRecords::remove(Number number) {
  if (has(number)) used_[number - 1u] = 0;
}

void FigureRecords::set(Number number, const FigureRecord& playing) {
  if (!has(number) || playing_[number - 1u] == playing) return;
  playing_[number - 1u] = playing;
  changed_ = true;
}

void FigureRecords::publish(ChangeSet& changes) {
  changes.figuresChanged = changed_;
  changes.figures.clear();
  if (changed_) changes.figures = playing_;
  changed_ = false;
}

/// What they play follows from the nodes, which set it again.
void FigureRecords::state(StateFields& f) {
  f("figures", used_);
  if (f.restores()) playing_.assign(used_.size(), {});
}

}  // namespace stadion
