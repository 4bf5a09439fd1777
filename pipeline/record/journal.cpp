#include "pipeline/record/journal.h"

#include "engine/base/append.h"
#include "pipeline/platform/child_process.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>
#include <utility>

namespace stadion {
namespace {

std::string dateAndTime() {
  using namespace std::chrono;
  const auto now = system_clock::now();
  const std::time_t seconds = system_clock::to_time_t(now);
  const auto milliseconds = duration_cast<std::chrono::milliseconds>(now.time_since_epoch()).count() % 1000;
  std::tm local{};
  localtime_r(&seconds, &local);
  std::array<char, 32> date{}, zone{};
  std::strftime(date.data(), date.size(), "%Y-%m-%d %H:%M:%S", &local);
  std::strftime(zone.data(), zone.size(), "%z", &local);
  return fmt::format("{}.{:03} {}", date.data(), milliseconds, zone.data());
}

std::string oneLine(std::string_view text) {
  std::string line(text);
  while (line.ends_with('\n')) line.pop_back();
  std::ranges::replace_if(
      line, [](unsigned char c) { return c < ' ' || c == 127; }, ' ');
  return line;
}

FileDescriptor openToAppend(const std::string& file) {
  return FileDescriptor(
      ::open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | O_NONBLOCK | O_NOCTTY, 0666));
}

constexpr std::chrono::seconds kHeldOn{10};

/// Renames FILE to FILE.1, and so on; deletes the oldest file.
void moveOn(const std::string& file) {
  const auto older = [&](int n) { return n == 0 ? file : fmt::format("{}.{}", file, n); };
  for (int n = Journal::kOlder; n > 0; --n) std::rename(older(n - 1).c_str(), older(n).c_str());
}

}  // namespace

Result<std::unique_ptr<Journal>> Journal::open(std::string file, std::size_t limit) {
  using Opened = Result<std::unique_ptr<Journal>>;
  const FileDescriptor opened = openToAppend(file);
  struct stat info {};
  if (!opened || fstat(opened.get(), &info) != 0)
    return Opened::failure(file + " cannot be written: " + std::strerror(errno));
  if (!S_ISREG(info.st_mode))
    return Opened::failure(file + " is no plain file, to which lines could be added");
  return std::unique_ptr<Journal>(new Journal(std::move(file), limit));
}

std::unique_ptr<Journal> Journal::openLater(std::string file) {
  return std::unique_ptr<Journal>(new Journal(std::move(file), kStandardLimit));
}

std::optional<std::string> Journal::add(std::string_view what, std::optional<Place> at) {
  const std::string place =
      at ? fmt::format("t={:.3f} f={}", toSeconds(at->time), at->frame) : std::string("-");
  const std::lock_guard lock(mutex_);
  const std::string lost =
      lost_ > 0 ? fmt::format("{}  -  {} lines before this one could not be written\n", dateAndTime(), lost_)
                : "";
  const auto why = write(fmt::format("{}{}  {}  {}\n", lost, dateAndTime(), place, oneLine(what)));
  lost_ = why ? lost_ + 1 : 0;
  if (!why || std::exchange(incomplete_, true)) return {};
  return file_ + ": cannot be written: " + *why;
}

bool Journal::incomplete() const {
  const std::lock_guard lock(mutex_);
  return incomplete_;
}

// A process that writes a line holds the file for less time than the tries take. A longer lock comes from
// another program, or from a stopped process. Then no call waits for it for a while.
bool Journal::lockSoon(int file) {
  const auto now = std::chrono::steady_clock::now();
  for (int tries = now < heldUntil_ ? 1 : 5; tries > 0; --tries) {
    if (flock(file, LOCK_EX | LOCK_NB) == 0) return true;
    if (tries > 1) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  heldUntil_ = now + kHeldOn;
  return false;
}

// A process that rotates the file holds the lock of the old one. Another that has opened the old file in the
// meantime checks again. A line needs no lock: without one it is added, and the file is rotated another time.
std::optional<std::string> Journal::write(std::string_view line) {
  constexpr int kTries = 8;
  for (int i = 0; i < kTries; ++i) {
    const FileDescriptor file = openToAppend(file_);
    struct stat ours {
    }, named{};
    if (!file || fstat(file.get(), &ours) != 0) return std::strerror(errno);
    if (!S_ISREG(ours.st_mode)) return "it is no plain file";
    const bool locked = lockSoon(file.get()) && fstat(file.get(), &ours) == 0;
    if (stat(file_.c_str(), &named) != 0 || named.st_ino != ours.st_ino || named.st_dev != ours.st_dev)
      continue;
    if (locked && ours.st_size > 0 && static_cast<std::size_t>(ours.st_size) + line.size() > limit_) {
      moveOn(file_);
      continue;
    }
    const int why = appendWhole(file.get(), line);
    return why == 0 ? std::nullopt : std::optional<std::string>(std::strerror(why));
  }
  return "others replace it again and again";
}

}  // namespace stadion
