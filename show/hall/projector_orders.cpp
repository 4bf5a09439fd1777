#include "show/hall/projector_orders.h"

#include "engine/base/plain_file.h"
#include "engine/plain_text/suggestion.h"
#include "engine/plain_text/text_line.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <thread>

namespace stadion {
namespace {

constexpr std::size_t kLongestPassword = 32;  ///< PJLink's limit
constexpr std::size_t kMostPasswordBytes = 4096;

/// Reads the first line of a password file, which is named relative to the wall file.
Result<std::string> passwordIn(const std::string& file, const std::string& wallFile) {
  const auto path = std::filesystem::path(wallFile).parent_path() / file;
  const auto text = readPlainFile(path.string(), kMostPasswordBytes);
  if (!text) return text.error();
  const std::string line = text.value().substr(0, text.value().find_first_of("\r\n"));
  if (!line.empty() && line.size() <= kLongestPassword) return line;
  return Result<std::string>::failure(fmt::format(
      "{}: its first line must be the password, of 1 to {} characters", path.string(), kLongestPassword));
}

std::optional<Diagnostic> give(PjlinkProjector& projector, ProjectorOrder order) {
  switch (order) {
  case ProjectorOrder::Status: return std::nullopt;
  case ProjectorOrder::On: return projector.setPower(true);
  case ProjectorOrder::Off: return projector.setPower(false);
  case ProjectorOrder::Open: return projector.setShutter(false);
  case ProjectorOrder::Shut: return projector.setShutter(true);
  }
  return std::nullopt;
}

Result<PjlinkStatus> ordered(const ProjectorControl& control, const std::string& wallFile,
                             ProjectorOrder order, std::chrono::milliseconds patience) {
  PjlinkAddress address{control.host, control.port, {}, patience};
  if (!control.passwordFile.empty()) {
    auto password = passwordIn(control.passwordFile, wallFile);
    if (!password) return password.error();
    address.password = std::move(password.value());
  }
  auto projector = PjlinkProjector::open(address);
  if (!projector) return projector.error();
  if (const auto why = give(*projector.value(), order)) return *why;
  return projector.value()->status();
}

/// The entries with these names and a control; all with one if there are no names.
std::vector<const WallEntry*> chosen(const WallFile& hall, const std::vector<std::string>& names,
                                     Diagnostics& findings) {
  std::vector<const WallEntry*> entries;
  std::vector<std::string> known;
  for (const WallEntry& e : hall.walls) {
    if (!e.control) continue;
    known.push_back(e.wall.name);
    if (names.empty() || std::ranges::find(names, e.wall.name) != names.end()) entries.push_back(&e);
  }
  for (const std::string& name : names)
    if (std::ranges::find(known, name) == known.end())
      findings.error({hall.file, 0, 0},
                     fmt::format("{} has no control{}; add a line such as: control {} pjlink HOST",
                                 quotedWord(name), known.empty() ? "" : didYouMeanOrKnown(name, known),
                                 name));
  if (known.empty() && names.empty())
    findings.error({hall.file, 0, 0},
                   "no projector has a control; add lines such as: control NAME pjlink HOST");
  return entries;
}

}  // namespace

std::optional<std::vector<OrderedProjector>> orderProjectors(const WallFile& hall, ProjectorOrder order,
                                                             const std::vector<std::string>& names,
                                                             std::chrono::milliseconds patience,
                                                             Diagnostics& findings) {
  const std::vector<const WallEntry*> entries = chosen(hall, names, findings);
  if (findings.hasErrors()) return std::nullopt;
  std::vector<OrderedProjector> all(entries.size());
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < entries.size(); ++i)
    threads.emplace_back([&, i] {
      const ProjectorControl& control = *entries[i]->control;
      OrderedProjector& one = all[i];
      one.name = entries[i]->wall.name;
      one.host = fmt::format("{}:{}", control.host, control.port);
      auto status = ordered(control, hall.file, order, patience);
      if (status)
        one.status = std::move(status.value());
      else
        one.error = status.error().message;
    });
  for (std::thread& thread : threads) thread.join();
  return all;
}

}  // namespace stadion
