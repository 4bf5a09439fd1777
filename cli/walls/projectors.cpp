/// `stadion projectors WALLS ORDER`: switches the projectors of a hall, and shows how they are.

#include "cli/commands.h"
#include "cli/exit_code.h"
#include "cli/findings_json.h"
#include "cli/options/command_options.h"
#include "cli/terminal.h"
#include "engine/base/installed_files.h"
#include "engine/hall_formats/hall_import.h"
#include "show/hall/projector_orders.h"

#include <CLI/CLI.hpp>
#include <array>
#include <cmath>
#include <cstdio>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <memory>
#include <string_view>

namespace stadion {
namespace {

constexpr std::array<std::string_view, 5> kOrders{"status", "on", "off", "open", "shut"};

struct ProjectorsOptions {
  std::string file, order = "status";
  std::vector<std::string> names;
  double patience = 5;  ///< [s]
  bool json = false;
};

ProjectorOrder orderOf(const std::string& word) {
  for (std::size_t i = 0; i < kOrders.size(); ++i)
    if (word == kOrders[i]) return static_cast<ProjectorOrder>(i);
  return ProjectorOrder::Status;
}

std::string textOf(const OrderedProjector& p) {
  if (!p.status) return fmt::format("{:<16} {:<24} error: {}\n", p.name, p.host, p.error);
  const PjlinkStatus& s = *p.status;
  std::string text =
      fmt::format("{:<16} {:<24} {}{}", p.name, p.host, nameOf(s.power), s.shut ? ", shut" : "");
  if (!s.lampHours.empty()) text += fmt::format(", lamp {} h", fmt::join(s.lampHours, " h, "));
  if (!s.faults.empty()) text += fmt::format(", {}", fmt::join(s.faults, ", "));
  if (!s.model.empty()) text += fmt::format(" ({} {})", s.maker, s.model);
  return text + '\n';
}

nlohmann::ordered_json jsonOf(const OrderedProjector& p) {
  nlohmann::ordered_json j{{"name", p.name}, {"host", p.host}, {"ok", p.status.has_value()}};
  if (!p.status) {
    j["error"] = p.error;
    return j;
  }
  j["power"] = nameOf(p.status->power);
  j["shut"] = p.status->shut;
  j["faults"] = p.status->faults;
  j["lamp_hours"] = p.status->lampHours;
  j["maker"] = p.status->maker;
  j["model"] = p.status->model;
  return j;
}

int switchProjectors(const ProjectorsOptions& o) {
  Diagnostics findings;
  const auto hall = loadHall(o.file, shareFolder() + "/walls", findings);
  const std::chrono::milliseconds patience(std::llround(o.patience * 1000));
  const auto ordered =
      hall ? orderProjectors(*hall, orderOf(o.order), o.names, patience, findings) : std::nullopt;
  printFindings(findings);
  if (!ordered) return kBadInput;
  bool good = true;
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const OrderedProjector& p : *ordered) {
    good &= p.status.has_value();
    all.push_back(jsonOf(p));
    if (!o.json) std::fputs(textOf(p).c_str(), stdout);
  }
  if (o.json)
    printJson({{"ok", good}, {"file", hall->file}, {"projectors", all}, {"findings", jsonOf(findings)}});
  return good ? kOk : kCheckFailed;
}

constexpr const char* kProjectorsFooter =
    R"(The wall file gives each projector its host and, if it wants one, the file of its password:

  control NAME pjlink HOST [port N] [password FILE]

All projectors get the order at the same time, by PJLink class 1. "on" and "off" return at once: projectors warm up and
cool down for minutes, which status shows. "shut" makes the picture dark without switching off. Exit code 0: all
projectors did as they were told; 1: at least one did not; 2: a file or a name is wrong.

  ./stadion projectors hall.walls on
  ./stadion projectors hall.walls shut front-left front-right
  ./stadion projectors hall.walls status --json)";

}  // namespace

void addProjectorsCommand(CLI::App& app, int& code) {
  auto o = std::make_shared<ProjectorsOptions>();
  CLI::App* command = app.add_subcommand(
      "projectors", "Switch the projectors of a hall on, off, open or shut, or ask how they are");
  CommandOptions options(*command);
  options.add("WALLS", o->file).required();
  options.add("ORDER", o->order).required();
  options.add("PROJECTOR", o->names);
  options.add("--patience", o->patience);
  options.add("--json", o->json);
  command->footer(kProjectorsFooter);
  command->callback([o, &code] { code = switchProjectors(*o); });
}

}  // namespace stadion
