#include "cli/options/trace_options.h"

#include <charconv>

namespace stadion {
namespace {

bool readNumber(std::string_view text, std::uint64_t& number) {
  const auto [end, wrong] = std::from_chars(text.data(), text.data() + text.size(), number);
  return wrong == std::errc{} && end == text.data() + text.size();
}

/// "A..B", both included.
bool readFrames(std::string_view text, TraceOptions& options) {
  const std::size_t dots = text.find("..");
  return dots != std::string_view::npos && readNumber(text.substr(0, dots), options.first) &&
         readNumber(text.substr(dots + 2), options.last) && options.first <= options.last;
}

}  // namespace

std::optional<TraceOptions> TraceRequest::settle(Diagnostics& findings) const {
  if (file.empty()) {
    if (!frames.empty()) findings.error({}, "--trace-frames: no trace is asked for that could be cut");
    return {};
  }
  TraceOptions options;
  options.file = file;
  options.mostBytes = static_cast<std::uint64_t>(1e6 * megabytes);
  if (!frames.empty() && !readFrames(frames, options))
    findings.error({}, "--trace-frames: \"" + frames + "\" is no range of frames A..B, such as 100..160");
  return options;
}

}  // namespace stadion
