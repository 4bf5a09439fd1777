#pragma once
/// Findings as JSON, the same in all commands.

#include "engine/base/diagnostic.h"

#include <nlohmann/json.hpp>

#include <cstdio>

namespace stadion {

inline nlohmann::ordered_json jsonOf(const Diagnostics& findings) {
  auto all = nlohmann::ordered_json::array();
  for (const Diagnostic& d : findings.all()) {
    const char* severity = d.severity == Severity::Error     ? "error"
                           : d.severity == Severity::Warning ? "warning"
                                                             : "note";
    all.push_back({{"severity", severity},
                   {"file", d.where.file},
                   {"line", d.where.line},
                   {"column", d.where.column},
                   {"message", d.message}});
  }
  return all;
}

/// Prints one line. Names of files may be no UTF-8; their wrong bytes are replaced.
inline void printJson(const nlohmann::ordered_json& json) {
  using Errors = nlohmann::ordered_json::error_handler_t;
  std::printf("%s\n", json.dump(-1, ' ', false, Errors::replace).c_str());
}

}  // namespace stadion
