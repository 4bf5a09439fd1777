#include "cli/options/trace_options.h"

#include "cli/options/value_grammar.h"

#include <tuple>

namespace stadion {

std::optional<TraceOptions> TraceRequest::options(Diagnostics& findings) const {
  if (file.empty()) {
    if (!frames.empty()) findings.error({}, "--trace-frames: no trace is asked for that could be cut");
    return {};
  }
  TraceOptions options;
  options.file = file;
  options.mostBytes = static_cast<std::uint64_t>(1e6 * megabytes);
  if (!frames.empty()) std::tie(options.first, options.last) = *readFrames(frames);
  return options;
}

}  // namespace stadion
