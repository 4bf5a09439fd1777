#pragma once
/// The problems of one OpenGL context, each kind reported once.
///
/// Threads  one thread at a time.

#include "pipeline/gl/problem.h"

#include <optional>
#include <set>
#include <string>
#include <utility>

namespace stadion {

class ProblemLog {
public:
  /// Ignores what was reported before, and what follows another new problem.
  void report(std::string what) {
    if (reported_.insert(what).second && !problem_) problem_ = problem(std::move(what));
  }
  /// Returns the new problem since the last call, if there is one.
  std::optional<Diagnostic> take() { return std::exchange(problem_, std::nullopt); }

private:
  std::set<std::string> reported_;
  std::optional<Diagnostic> problem_;
};

}  // namespace stadion
