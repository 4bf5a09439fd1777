#pragma once
/// Receives what a show has to say to people. This library writes to no terminal: its caller passes a
/// Reporter.
///
/// Threads  say() and report() from any thread at any time; the rest from the thread that plays the show or
///          waits for it.

#include "engine/base/diagnostic.h"

#include <cstdint>
#include <functional>
#include <string>

namespace stadion {

class Reporter {
public:
  using Say = std::function<void(const std::string&)>;
  using Report = std::function<void(const Diagnostics&)>;

  virtual ~Reporter() = default;

  /// A line about what happens while a show plays. A journal keeps it too.
  virtual void say(const std::string& line) = 0;
  /// A line for the person at the terminal alone. No journal keeps it.
  virtual void hint(const std::string& line) = 0;
  /// Why a run cannot go on, or which of its results is missing.
  virtual void fault(const std::string& why) = 0;
  /// Errors and warnings, also of files that are loaded while the show plays.
  virtual void report(const Diagnostics& findings) = 0;
  /// `done` of `total` frames have been played. 0: the total is unknown.
  virtual void progress(std::uint64_t /*done*/, std::uint64_t /*total*/) {}
  /// No more frames follow.
  virtual void progressOver() {}

  /// The functions above as values, for parts that need no more. The reporter must outlive them.
  Say sayFunction() {
    return [this](const std::string& line) { say(line); };
  }
  Say hintFunction() {
    return [this](const std::string& line) { hint(line); };
  }
  Say faultFunction() {
    return [this](const std::string& why) { fault(why); };
  }
  Report reportFunction() {
    return [this](const Diagnostics& findings) { report(findings); };
  }
};

}  // namespace stadion
