#include "pipeline/process/answer_deadline.h"

#include <algorithm>

namespace stadion::wall_process {

void AnswerDeadline::took(Milliseconds time) {
  last_[count_++ % kLast] = time;
}

std::optional<AnswerDeadline::Milliseconds> AnswerDeadline::limit() const {
  if (count_ < kKnown) return {};
  const std::size_t known = std::min(count_, kLast);
  std::array<Milliseconds, kLast> sorted = last_;
  std::sort(sorted.begin(), sorted.begin() + known);
  return 1.5 * std::max(frame_, sorted[(known - 1) / 2]);
}

}  // namespace stadion::wall_process
