#include "pipeline/operator/osc_operator.h"

#include "engine/text_line.h"

namespace stadion {
namespace {

constexpr std::string_view kHead = "/stadion/", kBy = "/by";
constexpr std::size_t kMostToldOf = 20;

bool isFigure(OperatorAction a) {
  return a == OperatorAction::EyeSeparation || a == OperatorAction::Volume;
}
bool isSwitch(OperatorAction a) {
  return a == OperatorAction::Pause || a == OperatorAction::Black || a == OperatorAction::SwapEyes ||
         a == OperatorAction::FreezeHead;
}

}  // namespace

std::optional<OperatorCommand> operatorCommandOf(const OscMessage& m) {
  if (!m.numeric || !m.path.starts_with(kHead)) return {};
  std::string_view word = m.path.substr(kHead.size());
  const bool relative = word.ends_with(kBy);
  if (relative) word.remove_suffix(kBy.size());
  const auto action = operatorActionNamed(word);
  if (!action || (relative && !isFigure(*action))) return {};
  OperatorCommand command{*action, {}, relative};
  if (m.numbers.size() > 1 || (m.numbers.empty() && isFigure(*action))) return {};
  if (m.numbers.empty()) return command;
  if (isFigure(*action) || isSwitch(*action))
    command.value = m.numbers[0];
  else if (m.numbers[0] == 0)
    return {};  // a button on a tablet sends 1 when it is pressed and 0 when it is let go
  return command;
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
  const bool released = m.numbers.size() == 1 && m.numbers[0] == 0 && m.path.starts_with(kHead) &&
                        operatorActionNamed(m.path.substr(kHead.size()));
  if (!released && told_.size() < kMostToldOf && told_.insert(std::string(m.path)).second)
    tell_("OSC message " + quotedWord(m.path) +
          " is no command (such as /stadion/pause, /stadion/volume 0.5)");
}

}  // namespace stadion
