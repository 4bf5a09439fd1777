#pragma once
/// Passes everything on to another reporter, and what a journal keeps to the journal and to the operator's page too.

#include "show/base/reporter.h"
#include "show/supervision/run_journal.h"
#include "show/web/operator_web.h"

namespace stadion {

class JournalReporter final : public Reporter {
public:
  explicit JournalReporter(Reporter& to) : to_(to) {}

  /// From now on this journal hears everything.
  void keepIn(RunJournal& journal) { journal_ = &journal; }
  /// From now on this page hears everything; null: it is gone.
  void showIn(OperatorWeb* web) { web_ = web; }

  void say(const std::string& line) override {
    to_.say(line);
    if (journal_) journal_->note(line);
    if (OperatorWeb* web = web_) web->say(line);
  }
  void report(const Diagnostics& findings) override {
    to_.report(findings);
    if (journal_) journal_->note(findings);
    if (OperatorWeb* web = web_) web->say(findings);
  }
  void hint(const std::string& line) override { to_.hint(line); }
  void fault(const std::string& why) override { to_.fault(why); }
  void progress(std::uint64_t done, std::uint64_t total) override { to_.progress(done, total); }
  void progressOver() override { to_.progressOver(); }

private:
  Reporter& to_;
  RunJournal* journal_ = nullptr;
  std::atomic<OperatorWeb*> web_ = nullptr;
};

}  // namespace stadion
