#pragma once
/// What a suite has found: one check for each thing that was compared.
///
/// Threads  plain values, any thread.

#include <map>
#include <string>
#include <vector>

namespace stadion::regression {

enum class Outcome {
  Passed,
  Failed,
  Skipped,  ///< there was nothing to compare with
};

struct Check {
  std::string metric;  ///< "state", "counts", "times of draw front" ...
  Outcome outcome = Outcome::Passed;
  std::string said;                    ///< what was found, in a sentence
  std::string culprit{};               ///< the node and stage that moved, if a figure did
  std::vector<std::string> figures{};  ///< if it failed: which ("app [ms]", "triangles front left")
  bool amongModes = false;             ///< modes of this run with each other, not with what was before
};

struct CaseResult {
  std::string name;  ///< CASE/MODE
  std::vector<Check> checks;
  std::string fault{};   ///< why it could not be played; then there are no checks
  bool refused = false;  ///< the fault is the user's: a show with mistakes
  std::map<std::string, std::vector<double>> milliseconds{};  ///< processor time by stage, round by round
  std::map<std::string, double> instructions{};               ///< by stage, a frame
  std::map<std::string, std::string> facts{};                 ///< hashes and counts
  double seconds = 0;                                         ///< that it took
  double processorSeconds = 0;                                ///< of the programs that were played
  std::map<std::string, std::vector<double>> elapsedMs{};     ///< as `milliseconds`, by the clock on the wall
  /// Of the typical round: "p99 of draw of wall front, wall-clock time [ms]", "late frames of frame, ...".
  std::map<std::string, double> frameFigures{};
  std::vector<std::string> warnings{};  ///< of the show, as it said them: "FILE:LINE:COLUMN: warning: ..."

  bool failed() const;
};

struct SuiteResult {
  std::string suite;    ///< file
  std::string program;  ///< that was played
  std::string against;  ///< what it was compared with: another program, a baseline; may be empty
  std::string when;     ///< UTC, ISO 8601
  std::vector<CaseResult> cases;

  /// One more case; what earlier ones have warned of in the same words is not said again.
  void add(CaseResult result);
  std::size_t count(Outcome outcome) const;
  /// Whether anything was compared with what was before.
  bool compared() const;
  std::size_t warnings() const;
  std::size_t faults() const;  ///< cases that could not be played
  bool refused() const;        ///< all of these for mistakes of the user's
};

}  // namespace stadion::regression
