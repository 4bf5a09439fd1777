#pragma once
/// A run log for people: a file that gets one line for each event.
///
///     2026-11-23 22:31:05.123 +0100  t=12.350 f=741  wall left: the process that draws it was killed
///
/// add() hands each line to the system in one piece before it returns, so that a later crash does not lose
/// it. Several processes may add to the same file. A file that would grow past its limit is renamed to
/// FILE.1, FILE.1 to FILE.2, and FILE.2 to FILE.3. Older lines are deleted.
///
/// Threads  any.
/// Errors   open() says why a file cannot be written. Later (a full disk) lines are lost: add() says so once,
///          and the show goes on. The first line that can be written again says how many were lost.

#include "engine/base/diagnostic.h"
#include "engine/base/time_signature.h"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

namespace stadion {

class Journal {
public:
  /// Limit of the size of each file [byte].
  static constexpr std::size_t kStandardLimit = std::size_t{4} << 20U;
  static constexpr int kOlder = 3;  ///< files that are kept beside it

  static Result<std::unique_ptr<Journal>> open(std::string file, std::size_t limit = kStandardLimit);
  /// Opens a file that may not exist yet. Lines are lost until it can be written.
  static std::unique_ptr<Journal> openLater(std::string file);

  /// Place in the show at which an event happens.
  struct Place {
    Nanoseconds time = 0;  ///< show time [ns]
    std::uint64_t frame = 0;
  };
  /// Adds `what` as one line; characters that a line cannot hold become blanks. Returns the error of the
  /// first line that is lost, otherwise nothing.
  std::optional<std::string> add(std::string_view what, std::optional<Place> at = {});
  /// Returns true if lines have been lost.
  bool incomplete() const;
  const std::string& file() const { return file_; }

private:
  Journal(std::string file, std::size_t limit) : file_(std::move(file)), limit_(limit) {}
  bool lockSoon(int file);
  std::optional<std::string> write(std::string_view line);

  std::string file_;
  std::size_t limit_;
  mutable std::mutex mutex_;                           ///< guards the members below
  std::chrono::steady_clock::time_point heldUntil_{};  ///< another program holds the lock, and not for a line
  std::uint64_t lost_ = 0;                             ///< lines lost that the file does not mention yet
  bool incomplete_ = false;
};

}  // namespace stadion
