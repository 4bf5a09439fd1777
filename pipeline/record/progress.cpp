#include "pipeline/record/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <string_view>
#include <unistd.h>

namespace stadion {
namespace {

constexpr std::chrono::milliseconds kInterval{100};
constexpr std::uint64_t kBarWidth = 30;

/// If the terminal has closed, only the bar is lost.
void put(int fd, std::string_view text) {
  [[maybe_unused]] const ssize_t wrote = write(fd, text.data(), text.size());
}

}  // namespace

ProgressBar::ProgressBar(std::uint64_t total, int fd) : total_(total), fd_(fd) {
  const char* terminal = std::getenv("TERM");
  shown_ = isatty(fd) == 1 && !(terminal && std::string_view(terminal) == "dumb");
}

void ProgressBar::update(std::uint64_t done) {
  const auto now = Clock::now();
  if (!shown_ || now < next_) return;
  next_ = now + kInterval;
  drawn_ = true;
  put(fd_, fmt::format("\r{}\x1b[K",
                       progressLine(done, total_, std::chrono::duration<double>(now - begin_).count())));
}

void ProgressBar::finish() {
  if (drawn_) put(fd_, "\r\x1b[K");
  shown_ = drawn_ = false;
}

std::string progressLine(std::uint64_t done, std::uint64_t total, double elapsedSeconds,
                         std::uint32_t columns) {
  const double rate = elapsedSeconds > 0 ? static_cast<double>(done) / elapsedSeconds : 0;
  std::string line;
  if (total == 0) {
    line = fmt::format("frame {}  {:.1f} frames/s", done, rate);
  } else {
    done = std::min(done, total);
    const double part = static_cast<double>(done) / static_cast<double>(total);
    const auto filled = static_cast<std::size_t>(part * static_cast<double>(kBarWidth));
    line = fmt::format("[{}{}] {}/{}  {:.1f} frames/s", std::string(filled, '#'),
                       std::string(kBarWidth - filled, ' '), done, total, rate);
    if (rate > 0) line += fmt::format("  {:.0f} s left", static_cast<double>(total - done) / rate);
  }
  return line.substr(0, columns);
}

}  // namespace stadion
