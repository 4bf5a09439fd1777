#include "pipeline/operator/osc_operator.h"

#include "engine/plain_text/text_line.h"
#include "pipeline/operator/operator_state.h"

#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace stadion {
namespace {

constexpr std::string_view kHead = "/stadion/", kBy = "/by";
constexpr std::size_t kMostToldOf = 20;

bool isNumeric(OperatorAction a) {
  return a == OperatorAction::EyeSeparation || a == OperatorAction::Volume || a == OperatorAction::Latency ||
         a == OperatorAction::Cue;
}
/// Values that a command can add to.
bool takesSteps(OperatorAction a) {
  return isNumeric(a) && a != OperatorAction::Cue;
}
bool isSwitch(OperatorAction a) {
  return a == OperatorAction::Pause || a == OperatorAction::Black || a == OperatorAction::TestPattern ||
         a == OperatorAction::SwapEyes || a == OperatorAction::FreezeHead;
}

/// An address, taken apart.
struct Address {
  std::optional<OperatorAction> action;
  bool relative = false;
};

Address addressOf(std::string_view path) {
  if (!path.starts_with(kHead)) return {};
  path.remove_prefix(kHead.size());
  const bool relative = path.ends_with(kBy);
  if (relative) path.remove_suffix(kBy.size());
  const auto action = operatorActionNamed(path);
  if (!action || (relative && !takesSteps(*action))) return {};
  return {action, relative};
}

/// The maximum that OperatorState accepts.
double mostOf(OperatorAction action) {
  if (action == OperatorAction::Latency) return OperatorState::kMostInFlight;
  if (action == OperatorAction::Cue) return OperatorState::kMostCues;
  return action == OperatorAction::Volume ? 1 : OperatorState::kWidestEyes;
}

bool countsWhole(OperatorAction action) {
  return action == OperatorAction::Latency || action == OperatorAction::Cue;
}

double leastOf(OperatorAction action) {
  return countsWhole(action) ? 1 : 0;
}

bool fits(double value, const Address& to) {
  if (!std::isfinite(value)) return false;
  if (!isNumeric(*to.action)) return value == 0 || value == 1;
  if (countsWhole(*to.action) && value != std::floor(value)) return false;
  return to.relative || (value >= leastOf(*to.action) && value <= mostOf(*to.action));
}

std::string rangeOf(const Address& to) {
  if (isSwitch(*to.action)) return "0 (off), 1 (on), or nothing";
  if (!isNumeric(*to.action)) return "nothing, or 1 and 0 as a button sends them";
  const std::string unit = *to.action == OperatorAction::EyeSeparation ? " m" : "";
  const std::string number = countsWhole(*to.action) ? "a whole number" : "a number";
  if (to.relative) return number + unit + " that is added";
  return fmt::format("{} from {:g} to {:g}{}", number, leastOf(*to.action), mostOf(*to.action), unit);
}

}  // namespace

std::optional<OperatorCommand> operatorCommandOf(const OscMessage& m) {
  const Address to = addressOf(m.path);
  if (!to.action || !m.numeric) return {};
  OperatorCommand command{*to.action, {}, to.relative};
  if (m.numbers.size() > 1 || (m.numbers.empty() && isNumeric(*to.action))) return {};
  if (m.numbers.empty()) return command;
  if (!fits(m.numbers[0], to)) return {};
  if (isNumeric(*to.action) || isSwitch(*to.action))
    command.value = m.numbers[0];
  else if (m.numbers[0] == 0)
    return {};  // a tablet's button sends 1 when it is pressed and 0 when it is released
  return command;
}

std::string complaintAbout(const OscMessage& m) {
  return complaintAbout(m, "OSC message");
}

std::string complaintAbout(const OscMessage& m, std::string_view what) {
  const Address to = addressOf(m.path);
  if (!to.action)
    return std::string(what) + " " + quotedWord(m.path) +
           " is no command (such as /stadion/pause, /stadion/volume 0.5)";
  if (m.numeric && m.numbers.size() == 1 && m.numbers[0] == 0 && fits(0, to)) return {};
  const std::string got = !m.numeric          ? "what is no number"
                          : m.numbers.empty() ? "nothing"
                                              : fmt::format("{:g}", fmt::join(m.numbers, " "));
  return fmt::format("{} \"{}\" with {} is not taken: it takes {}", what, m.path, got, rangeOf(to));
}

Result<std::unique_ptr<OscOperator>> OscOperator::open(std::uint16_t port, OperatorQueue& queue, Tell tell) {
  std::unique_ptr<OscOperator> made(new OscOperator(queue, std::move(tell)));
  auto server = OscServer::open(port, [o = made.get()](const OscMessage& m) { o->take(m); });
  if (!server) return server.error();
  made->server_ = std::move(server.value());
  return made;
}

void OscOperator::take(const OscMessage& m) {
  if (const auto command = operatorCommandOf(m)) {
    queue_.post(*command);
    return;
  }
  const std::string complaint = complaintAbout(m);
  if (complaint.empty() || told_.size() == kMostToldOf || !told_.insert(complaint).second) return;
  tell_(complaint);
}

}  // namespace stadion
