#include "show/view/view_hud.h"

#include "show/view/view_settings.h"

#include <algorithm>

namespace stadion {
namespace {

constexpr std::chrono::seconds kStays{6};
constexpr std::size_t kMostMessages = 4;
constexpr std::array<std::uint8_t, 3> kPlain{235, 235, 235}, kBad{250, 105, 90};

}  // namespace

void ViewHud::say(const std::string& line) {
  const std::lock_guard lock(mutex_);
  messages_.push_back({line, Clock::now() + kStays});
  if (messages_.size() > kMostMessages) messages_.erase(messages_.begin());
}

void ViewHud::setTrouble(const std::vector<std::string>& lines) {
  const std::lock_guard lock(mutex_);
  trouble_ = lines;
}

std::vector<PanelLine> ViewHud::helpLines() const {
  std::vector<PanelLine> lines;
  for (const std::string& text : viewKeys()) lines.push_back({text, kPlain});
  return lines;
}

std::vector<PanelLine> ViewHud::messageLines() const {
  const std::lock_guard lock(mutex_);
  std::vector<PanelLine> lines;
  for (const std::string& text : trouble_) lines.push_back({text, kBad});
  const auto now = Clock::now();
  for (const Message& m : messages_)
    if (now < m.until) lines.push_back({m.text, kPlain});
  return lines;
}

}  // namespace stadion
