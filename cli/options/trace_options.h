#pragma once
/// What can be asked of a trace on the command line, alike in `profile` and `run`.

#include "profiling/trace/trace_file.h"

#include <optional>
#include <string>

namespace stadion {

struct TraceRequest {
  std::string file;    ///< empty: none
  std::string frames;  ///< "A..B"
  double megabytes = 100;

  /// Says what is wrong. Nothing if no trace is asked for.
  std::optional<TraceOptions> settle(Diagnostics& findings) const;
};

}  // namespace stadion
