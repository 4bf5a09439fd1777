#pragma once
/// Maps a node to the account of its costs: that of the nearest watched node at or above it. It is asked for
/// every visit and every instance, so it uses tables and no trees.
///
/// Threads  built by one thread; constant from then on.

#include "engine/core/message.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace stadion {

class NodeAccounts {
public:
  using Account = std::uint32_t;
  static constexpr Account kNone = ~Account{0};

  explicit NodeAccounts(std::vector<NodeRef> holders) : holders_(std::move(holders)) {}
  /// Call it in the order of loads, then of positions.
  void add(NodeRef node, Account account) {
    if (loads_.empty() || loads_.back().number != node.load) loads_.push_back({node.load, {}});
    std::vector<Account>& whose = loads_.back().whose;
    while (whose.size() < node.position) whose.push_back(kNone);
    whose.push_back(account);
  }

  Account of(NodeRef node) const {
    const auto at = std::ranges::lower_bound(loads_, node.load, {}, &OfLoad::number);
    const bool known = at != loads_.end() && at->number == node.load && node.position < at->whose.size();
    return known ? at->whose[node.position] : kNone;
  }
  /// By account.
  const std::vector<NodeRef>& holders() const { return holders_; }

private:
  struct OfLoad {
    std::uint32_t number;
    std::vector<Account> whose;  ///< by position
  };
  std::vector<OfLoad> loads_;
  std::vector<NodeRef> holders_;
};

}  // namespace stadion
