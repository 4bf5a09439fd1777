#include "profiling/regression/spans/work_counts.h"

namespace stadion::regression {
namespace {

/// Every summary has these anyway.
bool isInEverySummary(Count what) {
  return what == Count::Visits || what == Count::Messages || what == Count::Calls ||
         what == Count::Instances || what == Count::Triangles;
}

}  // namespace

void WorkCounts::began(Span what, std::uint64_t, std::uint32_t wall) {
  if (!isStage(what)) return;  // a wait
  const std::lock_guard lock(mutex_);
  places_[std::this_thread::get_id()] = {wall, -1};
}

void WorkCounts::began(Span what, NodeRef) {
  if (what != Span::LeftEye && what != Span::RightEye) return;
  const std::lock_guard lock(mutex_);
  places_[std::this_thread::get_id()].eye = what == Span::RightEye ? 1 : 0;
}

void WorkCounts::counted(Count what, std::uint64_t amount, NodeRef) {
  if (isInEverySummary(what) || what == Count::Largest) return;  // the last is an estimate
  const std::lock_guard lock(mutex_);
  const Place& at = places_[std::this_thread::get_id()];
  totals_[{what, at.wall, at.eye}] += amount;
}

std::map<std::string, double> WorkCounts::totals(const std::vector<std::string>& walls) const {
  std::map<std::string, double> all;
  for (const auto& [where, total] : totals_) {
    const auto& [what, wall, eye] = where;
    std::string name(nameOf(what));
    if (wall < walls.size()) name += " " + walls[wall];
    if (eye >= 0) name += eye == 0 ? " left" : " right";
    all[name] += static_cast<double>(total);
  }
  return all;
}

}  // namespace stadion::regression
