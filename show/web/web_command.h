#pragma once
/// The operator's commands as the page sends them: {"command": "volume", "value": 0.1, "by": true}.
///
/// `command` is the end of an OSC address (pipeline/operator/osc_operator.h), `value` its number, and `by` adds the
/// value. So the page takes what OSC takes, with the same ranges.
///
/// Threads  pure functions.

#include "engine/input/operator_command.h"

#include <optional>
#include <string>

namespace stadion {

struct WebCommand {
  std::optional<OperatorCommand> command;
  std::string complaint;  ///< why there is none
};

WebCommand readWebCommand(const std::string& body);

}  // namespace stadion
