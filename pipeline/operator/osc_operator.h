#pragma once
/// The operator's commands as Open Sound Control messages: from a tablet, a show controller, `oscsend`.
///
///     /stadion/start           /stadion/step          /stadion/next-group      /stadion/end
///     /stadion/pause [0|1]     /stadion/black [0|1]   /stadion/swap-eyes [0|1] /stadion/freeze-head [0|1]
///     /stadion/test-pattern [0|1]                     /stadion/cue 1..32
///     /stadion/eye-separation METRES    /stadion/eye-separation/by METRES
///     /stadion/volume 0..1              /stadion/volume/by -1..1
///
/// Without a number, the command toggles.
///
/// Threads  the server's own.
/// Errors   Unknown commands and wrong values are ignored. The first one is reported, with the valid commands
///          or values. Any program that can send to the port can command the show.

#include "pipeline/device/osc_server.h"
#include "pipeline/operator/operator_queue.h"

#include <set>

namespace stadion {

/// Returns the command that a message stands for, or nothing.
std::optional<OperatorCommand> operatorCommandOf(const OscMessage& m);
/// Returns the error of a message without a command, in one line. Empty if there is none: a tablet's button
/// was released.
std::string complaintAbout(const OscMessage& m);
/// The same with another word for the message, such as "command".
std::string complaintAbout(const OscMessage& m, std::string_view what);

class OscOperator {
public:
  using Tell = std::function<void(const std::string&)>;

  /// Fails if the port is taken. The queue must outlive it.
  static Result<std::unique_ptr<OscOperator>> open(std::uint16_t port, OperatorQueue& queue, Tell tell);

  std::uint16_t port() const { return server_->port(); }

private:
  OscOperator(OperatorQueue& queue, Tell tell) : queue_(queue), tell_(std::move(tell)) {}
  void take(const OscMessage& m);

  OperatorQueue& queue_;
  Tell tell_;
  std::set<std::string> told_;
  std::unique_ptr<OscServer> server_;  ///< declared last: its thread uses the others
};

}  // namespace stadion
