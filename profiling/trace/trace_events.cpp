#include "profiling/trace/trace_events.h"

#include <fmt/format.h>
#include <iterator>
#include <nlohmann/json.hpp>

namespace stadion::trace {
namespace {

/// "12.125": exact.
void addMicroseconds(std::string& out, Ticks t) {
  fmt::format_to(std::back_inserter(out), "{}.{:03}", t / 8, t % 8 * 125);
}

}  // namespace

std::string jsonText(std::string_view text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

void addSlice(std::string& out, const Slice& s) {
  fmt::format_to(std::back_inserter(out), R"({{"ph":"X","pid":1,"tid":{},"name":{},"cat":"{}","ts":)",
                 s.thread, s.name, s.category);
  addMicroseconds(out, s.begin);
  out += R"(,"dur":)";
  addMicroseconds(out, s.end - s.begin);
  fmt::format_to(std::back_inserter(out),
                 R"(,"args":{{{}}}}},)"
                 "\n",
                 s.args);
}

void addFlow(std::string& out, FlowPoint point, std::uint64_t id, std::size_t thread, Ticks at) {
  fmt::format_to(std::back_inserter(out),
                 R"({{"ph":"{}","bp":"e","pid":1,"tid":{},"id":{},"name":"frame","cat":"frame","ts":)",
                 static_cast<char>(point), thread, id);
  addMicroseconds(out, at);
  out += "},\n";
}

void addCounter(std::string& out, std::string_view name, std::string_view series, Ticks at, double value) {
  fmt::format_to(std::back_inserter(out), R"({{"ph":"C","pid":1,"name":{},"args":{{{}:{:.4f}}},"ts":)",
                 jsonText(name), jsonText(series), value);
  addMicroseconds(out, at);
  out += "},\n";
}

void addThreadName(std::string& out, std::size_t thread, std::string_view name, std::size_t place) {
  fmt::format_to(std::back_inserter(out),
                 R"({{"ph":"M","pid":1,"tid":{},"name":"thread_name","args":{{"name":{}}}}},)"
                 "\n"
                 R"({{"ph":"M","pid":1,"tid":{},"name":"thread_sort_index","args":{{"sort_index":{}}}}},)"
                 "\n",
                 thread, jsonText(name), thread, place);
}

void addProcessName(std::string& out, std::string_view name) {
  fmt::format_to(std::back_inserter(out),
                 R"({{"ph":"M","pid":1,"name":"process_name","args":{{"name":{}}}}},)"
                 "\n",
                 jsonText(name));
}

}  // namespace stadion::trace
