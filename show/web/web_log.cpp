#include "show/web/web_log.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace stadion {

WebLog::~WebLog() {
  for (Entry* entry = newest_; entry;) delete std::exchange(entry, entry->before);
}

void WebLog::add(double uptime, const std::string& text) {
  if (waiting_.fetch_add(1) >= kMost) {
    --waiting_;
    ++dropped_;
    return;
  }
  auto entry = std::make_unique<Entry>();
  entry->line = {0, uptime, text.substr(0, kLongest)};
  entry->before = newest_.load();
  while (!newest_.compare_exchange_weak(entry->before, entry.get())) {
  }
  entry.release();
}

void WebLog::takeNew() const {
  std::vector<std::unique_ptr<Entry>> taken;
  for (Entry* entry = newest_.exchange(nullptr); entry; entry = entry->before) taken.emplace_back(entry);
  waiting_ -= taken.size();
  for (auto entry = taken.rbegin(); entry != taken.rend(); ++entry) {
    (*entry)->line.number = ++count_;
    lines_.push_back(std::move((*entry)->line));
  }
  while (lines_.size() > kMost) lines_.pop_front();
}

std::uint64_t WebLog::newest() const {
  const std::lock_guard lock(mutex_);
  takeNew();
  return count_;
}

std::vector<WebLogLine> WebLog::linesAfter(std::uint64_t after) const {
  const std::lock_guard lock(mutex_);
  takeNew();
  const auto first = std::ranges::find_if(lines_, [&](const WebLogLine& l) { return l.number > after; });
  return {first, lines_.end()};
}

}  // namespace stadion
