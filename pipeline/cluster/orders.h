#pragma once
/// A frame's order and input, as they travel (wire.idl).
///
/// Threads  plain values.

#include "engine/input/input_sample.h"
#include "pipeline/cluster/bus.h"
#include "pipeline/loop/frame_orders.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace stadion::cluster {

/// Numbers of an order that the frame loop does not know.
struct OrderNumbers {
  std::uint64_t session = 0, serial = 0;
  std::uint32_t members = 0;  ///< bit n: node n shows it
  std::uint32_t explain = 0;  ///< bit n: node n is to say where its scene differs
};

/// An order that can be told; refilled, so that nothing is allocated once it is large enough.
class WrittenOrder {
public:
  /// `input`: null, nobody has said anything. Valid until the next one.
  const Order& write(const OrderNumbers& numbers, const FrameOrder& order, const InputSample* input);
  /// What it takes on the network, without what the protocol adds.
  std::size_t bytes() const;

private:
  Order order_{};
  std::vector<stadion_wire_Decision> decisions_;
  std::vector<stadion_wire_Tracker> trackers_;
  std::vector<std::vector<stadion_wire_PoseKnot>> knots_;
  std::vector<std::vector<stadion_wire_ControlKnot>> controls_;
};

/// An order that was heard.
struct HeardOrder {
  OrderNumbers numbers;
  FrameOrder order;
  bool sampled = false;
  InputSample input;  ///< `measured` is 0: it is another machine's clock
};
/// Nothing, if it says what no machine that leads says: poses and axes that are no numbers or far out of
/// range, times that do not follow each other, one tracker twice.
std::optional<HeardOrder> readOrder(const Order& order);
stadion_wire_Presentation written(const Presentation& shown);
/// Nothing, if eyes are nowhere.
std::optional<Presentation> read(const stadion_wire_Presentation& shown);
/// Nothing, if it is none.
std::optional<Standstill> readStandstill(std::uint8_t still);
/// Whether a show can be there: not before its beginning, nor for thirty years.
bool isTime(Nanoseconds time);

}  // namespace stadion::cluster
