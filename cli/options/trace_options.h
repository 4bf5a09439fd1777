#pragma once
/// The options of a trace, the same in `profile` and `run`.

#include "profiling/trace/trace_file.h"

#include <optional>
#include <string>

namespace stadion {

struct TraceRequest {
  std::string file;    ///< empty: none
  std::string frames;  ///< "A..B"
  double megabytes = 100;

  /// Returns the options of the trace; nothing if no trace is requested. Adds errors to the findings.
  std::optional<TraceOptions> options(Diagnostics& findings) const;
};

}  // namespace stadion
