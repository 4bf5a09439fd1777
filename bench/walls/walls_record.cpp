#include "bench/walls/walls_record.h"

#include <cstdlib>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fstream>
#include <optional>

namespace stadion::bench {
namespace {

constexpr const char* kKind = "stadion bench walls";
constexpr std::int64_t kSameRun = 12 * 3600;  // [s]
constexpr const char* kOther = "give another --record FILE, or delete this one";

Diagnostic wrongIn(const std::string& file, std::size_t line, std::string what) {
  Diagnostic d;
  d.where.file = file;
  d.where.line = static_cast<std::uint32_t>(line);
  d.message = std::move(what);
  return d;
}

std::optional<RecordHead> headIn(const nlohmann::json& line) {
  if (!line.is_object() || line.value("record", "") != kKind) return {};
  RecordHead head;
  head.build = line.value("build", "");
  head.machine = line.value("machine", "");
  head.drawnBy = line.value("wall_workers", "");
  head.begun = line.value("begun", std::int64_t{0});
  return head;
}

/// Returns why rows of `then` must not be mixed with those of `now`; empty: they may.
std::string apart(const RecordHead& then, const RecordHead& now) {
  if (then.build != now.build) return "was measured with another build";
  if (then.machine != now.machine)
    return fmt::format("was measured on another machine ({}; this one is {})", then.machine, now.machine);
  if (then.drawnBy != now.drawnBy)
    return fmt::format("was measured with --wall-workers {}, not {}", then.drawnBy, now.drawnBy);
  if (std::abs(now.begun - then.begun) > kSameRun)
    return fmt::format("was begun {:%Y-%m-%d %H:%M} UTC, more than half a day from now",
                       fmt::gmtime(static_cast<std::time_t>(then.begun)));
  return {};
}

}  // namespace

std::string lineOf(const RecordHead& head) {
  return nlohmann::json{{"record", kKind},
                        {"build", head.build},
                        {"machine", head.machine},
                        {"wall_workers", head.drawnBy},
                        {"begun", head.begun}}
      .dump();
}

Result<WallsRecord> readRecord(const std::string& file, const RecordHead& now) {
  WallsRecord record{now, {}};
  std::ifstream in(file);
  std::size_t number = 0;
  for (std::string line; std::getline(in, line);) {
    nlohmann::json json = nlohmann::json::parse(line, nullptr, false);
    if (++number == 1) {
      const auto head = headIn(json);
      if (!head)
        return wrongIn(file, number,
                       std::string("is no record of stadion bench walls that says what it is of; ") + kOther);
      if (const std::string why = apart(*head, now); !why.empty())
        return wrongIn(file, number, why + ", and ratios hold within one run only; " + kOther);
      record.head = *head;
      continue;
    }
    if (json.is_object() && json.contains("case") && json["case"].is_string()) {
      record.rows.push_back(std::move(json));
      continue;
    }
    // A run that was killed while it wrote leaves half a line at the end.
    if (json.is_discarded() && in.eof() && line.starts_with('{')) break;
    return wrongIn(file, number, std::string("is no row of stadion bench walls; ") + kOther);
  }
  return record;
}

}  // namespace stadion::bench
