#pragma once
/// A run log for people: a file to which one line is added for each thing that happens.
///
///     2026-11-23 22:31:05.123 +0100  t=12.350 f=741  wall left: the process that draws it was killed
///
/// Each line is on its way to the disk before add() returns, in one piece, so that it is there whoever is
/// killed afterwards; several processes may add to the same file. A file that would grow past its limit is
/// renamed to FILE.1, what was FILE.1 to FILE.2, and so on to FILE.3; older lines go.
///
/// Threads  any.
/// Errors   open() says why a file cannot be written. Later on (a full disk) lines are lost, which add() says
///          once, and the show goes on; the first line that can be written again says how many were.

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
  static constexpr std::size_t kStandardLimit = std::size_t{4} << 20U;  ///< of each file [byte]
  static constexpr int kOlder = 3;                                      ///< files that are kept beside it

  static Result<std::unique_ptr<Journal>> open(std::string file, std::size_t limit = kStandardLimit);
  /// Of a file that may not be there yet: lines are lost until it can be written.
  static std::unique_ptr<Journal> openLater(std::string file);

  /// Where the show is when something happens.
  struct Place {
    Nanoseconds time = 0;  ///< show time [ns]
    std::uint64_t frame = 0;
  };
  /// `what` is one line; whatever cannot stand in one is written as a blank. Why the first line was lost that
  /// could not be written, else nothing.
  std::optional<std::string> add(std::string_view what, std::optional<Place> at = {});
  /// Lines have been lost.
  bool incomplete() const;
  const std::string& file() const { return file_; }

private:
  Journal(std::string file, std::size_t limit) : file_(std::move(file)), limit_(limit) {}
  bool lockSoon(int file);
  std::optional<std::string> write(std::string_view line);

  std::string file_;
  std::size_t limit_;
  mutable std::mutex mutex_;                           ///< of the next ones
  std::chrono::steady_clock::time_point heldUntil_{};  ///< somebody holds the lock, and not for a line
  std::uint64_t lost_ = 0;                             ///< lines, of which the file does not tell yet
  bool incomplete_ = false;
};

}  // namespace stadion
