#pragma once
/// Names of a run's threads, from the stages that they ran.
///
/// Threads  plain values.

#include "profiling/record/span_track.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace stadion {

class ThreadNames {
public:
  explicit ThreadNames(std::vector<std::string> walls) : walls_(std::move(walls)) {}

  /// `record` is an outermost span.
  void see(std::size_t track, const SpanRecord& record);

  struct Thread {
    std::size_t track = 0;
    std::string name;  ///< "App", "Cull front", "App helper 2"; "App, Cull, Draw" of a sequential run
  };
  /// Returns the threads from the top: App, its helpers, Cull, Draw.
  std::vector<Thread> threads() const;

private:
  struct Seen {
    bool app = false;
    std::optional<std::uint32_t> cull, draw;  ///< the wall of each
  };
  std::string wallName(std::uint32_t wall) const;

  std::vector<std::string> walls_;
  std::map<std::size_t, Seen> seen_;
};

}  // namespace stadion
