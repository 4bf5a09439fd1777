#pragma once
/// What a show has to say, on the terminal.

#include "pipeline/record/progress.h"
#include "show/base/reporter.h"

#include <cstdio>
#include <optional>

namespace stadion {

/// Writes every finding to stderr as the compiler would.
inline void printFindings(const Diagnostics& findings) {
  for (const Diagnostic& d : findings.all()) std::fprintf(stderr, "%s\n", format(d).c_str());
}

/// Writes every finding to stderr and returns `code`, for a command that ends with it.
inline int exitWith(const Diagnostics& findings, int code) {
  printFindings(findings);
  return code;
}

/// Writes everything to stderr.
class TerminalReporter final : public Reporter {
public:
  void say(const std::string& line) override { std::fprintf(stderr, "%s\n", line.c_str()); }
  void hint(const std::string& line) override { say(line); }
  void fault(const std::string& why) override { std::fprintf(stderr, "stadion: %s\n", why.c_str()); }
  void report(const Diagnostics& findings) override { printFindings(findings); }
  void progress(std::uint64_t done, std::uint64_t total) override {
    if (!bar_) bar_.emplace(total);
    bar_->update(done);
  }
  void progressOver() override { bar_.reset(); }

private:
  std::optional<ProgressBar> bar_;
};

}  // namespace stadion
