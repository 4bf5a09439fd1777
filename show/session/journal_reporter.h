#pragma once
/// Passes everything on to another reporter, and what a journal keeps to the journal too.

#include "show/base/reporter.h"
#include "show/supervision/run_journal.h"

namespace stadion {

class JournalReporter final : public Reporter {
public:
  explicit JournalReporter(Reporter& to) : to_(to) {}

  /// From now on this journal hears everything.
  void keepIn(RunJournal& journal) { journal_ = &journal; }

  void say(const std::string& line) override {
    to_.say(line);
    if (journal_) journal_->note(line);
  }
  void report(const Diagnostics& findings) override {
    to_.report(findings);
    if (journal_) journal_->note(findings);
  }
  void hint(const std::string& line) override { to_.hint(line); }
  void fault(const std::string& why) override { to_.fault(why); }
  void progress(std::uint64_t done, std::uint64_t total) override { to_.progress(done, total); }
  void progressOver() override { to_.progressOver(); }

private:
  Reporter& to_;
  RunJournal* journal_ = nullptr;
};

}  // namespace stadion
