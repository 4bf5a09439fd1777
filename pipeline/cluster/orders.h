#pragma once
/// Conversion of a frame's order and input to and from their network form (wire.idl).
///
/// Threads  plain values.

#include "engine/input/input_sample.h"
#include "pipeline/cluster/bus.h"
#include "pipeline/loop/frame_orders.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace stadion::cluster {

/// The fields of an order that the frame loop does not know.
struct OrderNumbers {
  std::uint64_t session = 0, serial = 0;
  std::uint32_t members = 0;  ///< bit n: host n shows it
  std::uint32_t explain = 0;  ///< bit n: host n must say where its scene differs
};

/// An order in network form. It is refilled, so that it allocates nothing once it is large enough.
class WrittenOrder {
public:
  /// `input`: null if there is no input. The result is valid until the next call.
  const Order& write(const OrderNumbers& numbers, const FrameOrder& order, const InputSample* input);
  /// Size on the network, without the protocol's additions [byte].
  std::size_t bytes() const;

private:
  Order order_{};
  std::vector<stadion_wire_Decision> decisions_;
  std::vector<stadion_wire_Tracker> trackers_;
  std::vector<std::vector<stadion_wire_PoseKnot>> knots_;
  std::vector<std::vector<stadion_wire_ControlKnot>> controls_;
};

/// An order that was received.
struct HeardOrder {
  OrderNumbers numbers;
  FrameOrder order;
  bool sampled = false;
  InputSample input;  ///< `measured` is 0, since it would come from another host's clock
};
/// Returns nothing if no leader sends such an order: poses and axes that are not finite or far out of range,
/// times that go backwards, or one tracker twice.
std::optional<HeardOrder> readOrder(const Order& order);
stadion_wire_Presentation written(const Presentation& shown);
/// Returns nothing if an eye's position is not valid.
std::optional<Presentation> read(const stadion_wire_Presentation& shown);
/// Returns nothing if the value is not a Standstill.
std::optional<Standstill> readStandstill(std::uint8_t still);
/// Returns true if a show can have that time: not before its beginning, and at most thirty years after.
bool isTime(Nanoseconds time);

}  // namespace stadion::cluster
