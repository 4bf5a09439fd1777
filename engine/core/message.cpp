#include "engine/core/message.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace stadion {
namespace {

bool later(const Message& a, const Message& b) {
  return std::tie(a.due, a.sender, a.sequence) > std::tie(b.due, b.sender, b.sequence);
}

}  // namespace

void MessageQueue::post(Message m) {
  m.sequence = sequence_++;
  heap_.push_back(std::move(m));
  std::push_heap(heap_.begin(), heap_.end(), later);
}

std::vector<Message> MessageQueue::takeDue(Nanoseconds now) {
  std::vector<Message> due;
  while (!heap_.empty() && heap_.front().due <= now) {
    std::pop_heap(heap_.begin(), heap_.end(), later);
    due.push_back(std::move(heap_.back()));
    heap_.pop_back();
  }
  return due;
}

}  // namespace stadion
