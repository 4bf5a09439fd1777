#include "engine/published/paint_table.h"

#include "engine/core/state_fields.h"
#include "engine/published/records.h"

namespace stadion {

PaintTable::Key PaintTable::keyOf(const Paint& p) {
  return {p.tint.x(), p.tint.y(), p.tint.z(), p.emit.x(), p.emit.y(), p.emit.z(), p.opacity};
}

PaintTable::Number PaintTable::add(const Paint& paint) {
  if (const auto known = numbers_.find(keyOf(paint)); known != numbers_.end()) {
    ++all_[known->second - 1u].users;
    return known->second;
  }
  if (free_.empty()) {
    if (all_.size() >= kMostPaints) return 0;
    all_.emplace_back();
    records_.emplace_back();
    free_.insert(static_cast<Number>(all_.size()));
  }
  const Number number = *free_.begin();
  free_.erase(free_.begin());
  all_[number - 1u] = {paint, 1};
  records_[number - 1u] = recordOf(paint);
  numbers_.emplace(keyOf(paint), number);
  changed_ = true;
  return number;
}

void PaintTable::remove(Number number) {
  if (number == 0 || number > all_.size()) return;
  Entry& entry = all_[number - 1u];
  if (entry.users == 0 || --entry.users > 0) return;
  numbers_.erase(keyOf(entry.paint));
  free_.insert(number);
}

bool PaintTable::holds(Number number, const Paint& paint) const {
  return number > 0 && number <= all_.size() && all_[number - 1u].users > 0 &&
         all_[number - 1u].paint == paint;
}

void PaintTable::publish(ChangeSet& changes) {
  changes.paintsChanged = changed_;
  changes.paints.clear();
  if (changed_) changes.paints = records_;
  changed_ = false;
}

void PaintTable::state(StateFields& f) {
  f("paints", all_);
}

bool PaintTable::resume() {
  numbers_.clear();
  free_.clear();
  records_.assign(all_.size(), {});
  changed_ = true;
  if (all_.size() > kMostPaints) return false;
  for (std::size_t i = 0; i < all_.size(); ++i) {
    const auto number = static_cast<Number>(i + 1);
    if (!all_[i].paint.isValid()) return false;
    records_[i] = recordOf(all_[i].paint);
    if (all_[i].users == 0)
      free_.insert(number);
    else if (!numbers_.emplace(keyOf(all_[i].paint), number).second)
      return false;
  }
  return true;
}

}  // namespace stadion
