#pragma once
/// The text of single events of a trace: the JSON object format that chrome://tracing and Perfetto read.
///
/// Times are on a grid of an eighth of a microsecond. Viewers add times as floating-point numbers and compare
/// the sums to find the nesting. On this grid the sums are exact, so nested slices stay nested. Recording one
/// span takes about as long.
///
/// Units    [us] since the trace began.
/// Threads  plain functions.

#include <cstdint>
#include <string>
#include <string_view>

namespace stadion::trace {

/// In eighths of a microsecond.
using Ticks = std::int64_t;
constexpr Ticks ticksOf(std::int64_t nanoseconds) {
  return nanoseconds / 125;
}

/// Quotes and escapes the text, and replaces bytes that are not UTF-8.
std::string jsonText(std::string_view text);

struct Slice {
  std::string_view name;      ///< as JSON text
  std::string_view category;  ///< letters, digits, commas
  std::size_t thread = 0;
  Ticks begin = 0, end = 0;
  std::string_view args;  ///< members of a JSON object
};

/// Appends each event to `out`, on a line that ends with a comma.
void addSlice(std::string& out, const Slice& slice);

/// A point of an arrow from slice to slice, bound to the slice around it.
enum class FlowPoint : char { Start = 's', Step = 't', End = 'f' };
void addFlow(std::string& out, FlowPoint point, std::uint64_t id, std::size_t thread, Ticks at);

void addCounter(std::string& out, std::string_view name, std::string_view series, Ticks at, double value);

/// A thread's name, and its place from the top.
void addThreadName(std::string& out, std::size_t thread, std::string_view name, std::size_t place);
void addProcessName(std::string& out, std::string_view name);

}  // namespace stadion::trace
