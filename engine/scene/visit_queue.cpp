#include "engine/scene/visit_queue.h"

#include <algorithm>
#include <functional>

namespace stadion {
namespace {

VisitQueue::Entry entryOf(Node& node) {
  return {Visit::of(node), &node};
}

void sortOut(std::vector<VisitQueue::Entry>& entries) {
  std::ranges::sort(entries);
  entries.erase(std::unique(entries.begin(), entries.end()), entries.end());
}

}  // namespace

void VisitQueue::setBusy(Node& node, bool busy) {
  if (node.scheduleState().busy == busy) return;
  node.scheduleState().busy = busy;
  if (busy)
    joining_.push_back(entryOf(node));
  else
    left_ = true;
}

void VisitQueue::updateBusy() {
  if (!joining_.empty()) {
    busy_.insert(busy_.end(), joining_.begin(), joining_.end());
    joining_.clear();
    sortOut(busy_);
  }
  if (left_) std::erase_if(busy_, [](const Entry& e) { return !e.node->scheduleState().busy; });
  left_ = false;
}

void VisitQueue::reorder() {
  updateBusy();
  for (Entry& e : busy_) e.visit = Visit::of(*e.node);
  sortOut(busy_);
}

void VisitQueue::begin() {
  updateBusy();
  round_ = busy_;
  at_ = 0;
  later_.clear();
}

void VisitQueue::call(Node& node) {
  round_.push_back(entryOf(node));
}

void VisitQueue::sort() {
  if (std::ranges::adjacent_find(round_, std::greater_equal<>()) != round_.end()) sortOut(round_);
}

void VisitQueue::callNow(Node& node) {
  later_.push_back(entryOf(node));
  std::ranges::push_heap(later_, std::greater<>());
}

const VisitQueue::Entry* VisitQueue::next() const {
  const Entry* first = at_ < round_.size() ? &round_[at_] : nullptr;
  if (!later_.empty() && (!first || later_.front() < *first)) first = &later_.front();
  return first;
}

void VisitQueue::take() {
  const Entry taken = *next();
  if (at_ < round_.size() && round_[at_] == taken) ++at_;
  while (!later_.empty() && later_.front() == taken) {
    std::ranges::pop_heap(later_, std::greater<>());
    later_.pop_back();
  }
}

}  // namespace stadion
