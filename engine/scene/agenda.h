#pragma once
/// Which nodes are to be visited in a frame, in the order of ranks, of levels within a rank, then of load
/// numbers and positions in the file.
///
/// A round begins with the nodes that are busy; others are called to it, also while it is under way. Each
/// that waits is visited once, however often it was called. From frame to frame the memory is used again.
///
/// Threads  App only.

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

  static Visit of(const Node& node) { return {node.rank(), node.standing().level, node.self()}; }
};

class Agenda {
public:
  struct Entry {
    Visit visit;
    Node* node = nullptr;
    bool operator==(const Entry& o) const { return visit == o.visit; }
    auto operator<=>(const Entry& o) const { return visit <=> o.visit; }
  };

  /// Whether the node is visited in every round from now on.
  void setBusy(Node& node, bool busy);
  /// Forgets those that are not busy any more: before nodes go.
  void settle();
  /// Levels have changed. Between rounds.
  void reorder();

  /// A new round, of those that are busy. Nobody of the last one is left.
  void begin();
  /// Takes out of the round, before it is under way, whom `leave` names.
  template <class Leave>
  void leaveOut(const Leave& leave) {
    std::erase_if(round_, [&](const Entry& e) { return leave(*e.node); });
  }
  /// Before the round is under way; then sort() once.
  void call(Node& node);
  void sort();
  /// While it is under way.
  void callNow(Node& node);

  /// Who is next; nullptr = nobody. It stays the next one until it is taken.
  const Entry* next() const;
  void take();

private:
  std::vector<Entry> busy_, joining_;
  bool left_ = false;  ///< some of busy_ are so no more
  std::vector<Entry> round_;
  std::size_t at_ = 0;        ///< in the round
  std::vector<Entry> later_;  ///< called while it is under way: a heap, the first on top
};

}  // namespace stadion
