#pragma once
/// The results of a suite: one check for each comparison.
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
  std::string said;                    ///< the result, in a sentence
  std::string culprit{};               ///< the node and stage that changed, if a figure did
  std::vector<std::string> figures{};  ///< the failed figures ("app [ms]", "triangles front left")
  bool amongModes = false;             ///< compares modes of this run, not with earlier results
};

struct CaseResult {
  std::string name;  ///< CASE/MODE
  std::vector<Check> checks;
  std::string fault{};   ///< why it could not be played; then there are no checks
  bool refused = false;  ///< the error is the user's: a show with errors
  std::map<std::string, std::vector<double>> milliseconds{};  ///< processor time by stage, round by round
  std::map<std::string, double> instructions{};               ///< by stage, a frame
  std::map<std::string, std::string> facts{};                 ///< hashes and counts
  double seconds = 0;                                         ///< duration
  double processorSeconds = 0;                                ///< processor time of the played programs
  std::map<std::string, std::vector<double>> elapsedMs{};     ///< as `milliseconds`, by real time
  /// Figures of the typical round: "p99 of draw of wall front, wall-clock time [ms]", "late frames of frame,
  /// ...".
  std::map<std::string, double> frameFigures{};
  std::vector<std::string> warnings{};  ///< the show's warnings: "FILE:LINE:COLUMN: warning: ..."

  bool failed() const;
};

struct SuiteResult {
  std::string suite;    ///< file
  std::string program;  ///< the played program
  std::string against;  ///< compared with: another program, a baseline; may be empty
  std::string when;     ///< UTC, ISO 8601
  std::vector<CaseResult> cases;

  /// Adds a case, without warnings that earlier cases had in the same words.
  void add(CaseResult result);
  std::size_t count(Outcome outcome) const;
  /// Returns true if anything was compared with earlier results.
  bool compared() const;
  std::size_t warnings() const;
  std::size_t faults() const;  ///< cases that could not be played
  bool refused() const;        ///< all of these are the user's errors
};

}  // namespace stadion::regression
