#include "show/web/web_command.h"

#include "pipeline/operator/osc_operator.h"

#include <nlohmann/json.hpp>

#include <span>

namespace stadion {
namespace {

/// A command as the page sends it: {"command": "volume", "value": 0.1, "by": true}.
struct SentCommand {
  std::string path;
  std::optional<double> value;
};

std::optional<SentCommand> sentCommandOf(const std::string& body) {
  const auto json = nlohmann::json::parse(body, nullptr, false);
  if (!json.is_object()) return {};
  SentCommand sent;
  bool named = false, by = false;
  for (const auto& [key, value] : json.items()) {
    if (key == "command" && value.is_string()) {
      sent.path = "/stadion/" + value.get<std::string>();
      named = true;
    } else if (key == "value" && value.is_number()) {
      sent.value = value.get<double>();
    } else if (key == "value" && value.is_boolean()) {
      sent.value = value.get<bool>() ? 1 : 0;
    } else if (key == "by" && value.is_boolean()) {
      by = value.get<bool>();
    } else {
      return {};
    }
  }
  if (by) sent.path += "/by";
  return named ? std::optional(sent) : std::nullopt;
}

/// Why a command is none, without the head that OSC addresses have.
std::string commandComplaint(const OscMessage& message) {
  std::string why = complaintAbout(message, "command");
  if (why.empty()) return "command with 0 is the release of a button: nothing to do";
  const std::string head = "/stadion/";
  for (std::size_t at = why.find(head); at != std::string::npos; at = why.find(head))
    why.erase(at, head.size());
  return why;
}

}  // namespace

WebCommand readWebCommand(const std::string& body) {
  const auto sent = sentCommandOf(body);
  if (!sent) return {{}, R"(a command is {"command": NAME, "value": NUMBER, "by": true or false})"};
  const double value = sent->value.value_or(0);
  const OscMessage message{sent->path, std::span(&value, sent->value ? 1 : 0), true, {}, {}};
  const auto command = operatorCommandOf(message);
  return command ? WebCommand{command, ""} : WebCommand{{}, commandComplaint(message)};
}

}  // namespace stadion
