#pragma once
/// The order in which the nodes of a round are visited: by rank, by level within a rank, then by load number
/// and position in the file.
///
/// A round begins with the busy nodes. Other nodes are called to it, also while it runs. A node that waits is
/// visited once, however often it was called. Memory is used again from frame to frame.
///
/// Ownership  borrows the nodes; updateBusy() forgets those that are no longer busy.
/// Threads    App only.
/// Errors     none.

#include "engine/scene/node.h"

#include <compare>
#include <cstddef>
#include <vector>

namespace stadion {

struct Visit {
  Rank rank{};
  std::uint16_t level = 0;
  NodeRef node;
  auto operator<=>(const Visit&) const = default;

  static Visit of(const Node& node) { return {node.rank(), node.scheduleState().level, node.self()}; }
};

class VisitQueue {
public:
  struct Entry {
    Visit visit;
    Node* node = nullptr;
    bool operator==(const Entry& o) const { return visit == o.visit; }
    auto operator<=>(const Entry& o) const { return visit <=> o.visit; }
  };

  /// Sets whether the node is visited in every round from now on.
  void setBusy(Node& node, bool busy);
  /// Forgets nodes that are no longer busy. Call it before nodes are destroyed.
  void updateBusy();
  /// Sorts the busy nodes again after levels changed. Call it between rounds.
  void reorder();

  /// Begins a round with the busy nodes. Expects that the last round has ended.
  void begin();
  /// Removes the nodes for which `leave` is true. Call it before sort().
  template <class Leave>
  void leaveOut(const Leave& leave) {
    std::erase_if(round_, [&](const Entry& e) { return leave(*e.node); });
  }
  /// Adds a node before the round runs. Call sort() once after the last one.
  void call(Node& node);
  void sort();
  /// Adds a node while the round runs.
  void callNow(Node& node);

  /// The next node; null at the end of the round. It stays the next one until take().
  const Entry* next() const;
  void take();

private:
  std::vector<Entry> busy_, joining_;
  bool left_ = false;  ///< some of busy_ are no longer busy
  std::vector<Entry> round_;
  std::size_t at_ = 0;        ///< index in round_ of the next one
  std::vector<Entry> later_;  ///< called while the round runs: a heap, the first on top
};

}  // namespace stadion
