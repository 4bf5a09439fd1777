#pragma once
/// The folder of `regress --out DIR`: the page, results for machines, the history, and how far a suite is.
///
/// Threads  one at a time.
/// Errors   reports at once, on stderr, what it cannot write.

#include "cli/regress/regress_options.h"
#include "engine/base/atomic_file.h"
#include "pipeline/platform/child_process.h"
#include "profiling/regression/suite_progress.h"

#include <map>
#include <string>

namespace stadion {

class RegressFolder {
public:
  /// Makes the folder if need be, and opens what finish() writes. With `resume`, cases that an interrupted
  /// run of the same suite has completed are known.
  bool open(const RegressOptions& options, const std::string& suiteText);

  const regression::DoneCases& done() const { return done_; }
  /// A case is complete.
  bool note(const std::string& caseName, const std::vector<regression::CaseResult>& results);
  /// The suite is complete: report.html, results.json, junit.xml; if these are written, a line more in
  /// history.jsonl.
  bool finish(const regression::SuiteResult& result);
  /// Everything is written: there is nothing to resume.
  void forgetProgress();

private:
  bool lock();
  bool openOutputs();
  bool append(const std::string& name, const std::string& text);
  bool write(const std::string& name, const std::string& text);
  std::string pathOf(const std::string& name) const { return folder_ + "/" + name; }

  std::string folder_;
  FileDescriptor lock_;  ///< the folder, ours alone while it is open
  regression::DoneCases done_;
  std::map<std::string, AtomicFile> outputs_;  ///< by name
};

}  // namespace stadion
