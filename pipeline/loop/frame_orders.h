#pragma once
/// The next frame, and the permission to show it, when several hosts play one show: one leads, the others
/// follow (cluster/).
///
/// Threads  next() and issue() on the App thread; mayShow() on the Draw thread that arrived last.
/// Errors   If the wait is no longer wanted, the functions return nothing or false. The run then ends as if
///          it had been asked to.

#include "engine/base/time_signature.h"
#include "pipeline/frame/presentation.h"

#include <cstdint>
#include <optional>

namespace stadion {

/// The reason for which show time stands still.
enum class Standstill : std::uint8_t { None, Paused, Waiting };  ///< Waiting: for the operator's Start

/// A frame, as the leader has decided it for all.
struct FrameOrder {
  TimeSignature signature;
  Presentation presentation{};
  Standstill still = Standstill::None;        ///< if show time stands still, this is the last frame again
  Standstill standsAfter = Standstill::None;  ///< the state with which a new leader continues
  bool last = false;                          ///< no frame follows it
  bool drawn = true;                          ///< false: this host skips the frame (FrameTicket::drawn)
};

class FrameOrders {
public:
  virtual ~FrameOrders() = default;
  virtual bool leads() const = 0;
  /// Leader: issues the next frame; it may be changed into the last one. Its input follows with App's sample.
  virtual void issue(FrameOrder& order) = 0;
  /// Follower: waits for the next frame. Returns nothing if there is none.
  virtual std::optional<FrameOrder> next() = 0;
  /// All walls of this host have drawn that frame (or it is not drawn). Waits until all hosts have.
  virtual bool mayShow(const TimeSignature& now) = 0;
};

}  // namespace stadion
