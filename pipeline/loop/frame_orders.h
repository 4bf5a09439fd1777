#pragma once
/// What frame comes next and when it may be shown, where several machines play one show: one of them leads,
/// the others follow (cluster/).
///
/// Threads  next() and issue() on the App thread; mayShow() on the Draw thread that arrived last.
/// Errors   whoever is to wait no longer answers nothing, or false; the run then ends as if it had been asked
///          to.

#include "engine/base/time_signature.h"
#include "pipeline/frame/presentation.h"

#include <cstdint>
#include <optional>

namespace stadion {

/// Why show time stands still.
enum class Standstill : std::uint8_t { None, Paused, Waiting };  ///< Waiting: for the operator's Start

/// A frame, as the machine that leads has decided it for all.
struct FrameOrder {
  TimeSignature signature;
  Presentation shown{};
  Standstill still = Standstill::None;        ///< if it stands, this is its last frame once more
  Standstill standsAfter = Standstill::None;  ///< what a machine that leads in our place goes on with
  bool last = false;                          ///< no frame follows it
  bool drawn = true;                          ///< false: this machine is not yet one of those that show it
};

class FrameOrders {
public:
  virtual ~FrameOrders() = default;
  virtual bool leads() const = 0;
  /// Who leads: this is the next frame; it may be made the last one. Its input follows with the sample that
  /// App takes for it.
  virtual void issue(FrameOrder& order) = 0;
  /// Who follows: waits for the next frame. Nothing: there is none.
  virtual std::optional<FrameOrder> next() = 0;
  /// All walls of this machine have drawn that frame (or it is not drawn): waits until all machines have.
  virtual bool mayShow(const TimeSignature& now) = 0;
};

}  // namespace stadion
