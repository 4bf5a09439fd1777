#include "pipeline/cull/draw_order.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace stadion {
namespace {

/// Grows with the distance, which is not negative.
std::uint32_t bitsOf(float distance) {
  return std::bit_cast<std::uint32_t>(distance);
}

constexpr int kRankBits = 6;  ///< views have numbers below 32

/// What one of two views sees lies together: before what both see, or after it. Expects that any sees it.
std::uint32_t rankOf(std::uint32_t views) {
  return static_cast<std::uint32_t>(std::countr_zero(views) + std::bit_width(views) - 1);
}

std::uint64_t joined(std::uint32_t high, std::uint32_t low) {
  return std::uint64_t{high} << 32 | low;
}

}  // namespace

void DrawOrder::sortOpaque(std::vector<DrawnRecord>& things) {
  keys_.clear();
  std::uint32_t thing = 0;
  for (const DrawnRecord& d : things)
    keys_.push_back({joined(d.mesh, d.level << kRankBits | rankOf(d.views)), bitsOf(d.distance), thing++});
  arrange(things);
}

void DrawOrder::sortTransparent(std::vector<DrawnRecord>& things) {
  keys_.clear();
  std::uint32_t thing = 0;
  for (const DrawnRecord& d : things)
    keys_.push_back({joined(d.record->owner.load, d.record->owner.position), d.mesh, thing++});
  arrange(things);
}

void DrawOrder::arrange(std::vector<DrawnRecord>& things) {
  sortKeys();
  sortAlike(things);
  moved_.clear();
  for (const Key& key : keys_) moved_.push_back(things[key.thing]);
  things.swap(moved_);
}

void DrawOrder::sortKeys() {
  constexpr std::size_t kFew = 64;
  if (keys_.size() < kFew) return std::sort(keys_.begin(), keys_.end());
  for (auto& count : counts_) count.fill(0);
  for (const Key& key : keys_)
    for (std::size_t k = 0; k < kBytes; ++k) ++counts_[k][key.byte(k)];
  spare_.resize(keys_.size());
  for (std::size_t k = 0; k < kBytes; ++k) {
    auto& count = counts_[k];
    if (count[keys_[0].byte(k)] == keys_.size()) continue;
    std::uint32_t before = 0;
    for (std::uint32_t& c : count) before += std::exchange(c, before);
    for (const Key& key : keys_) spare_[count[key.byte(k)]++] = key;
    keys_.swap(spare_);
  }
}

void DrawOrder::sortAlike(const std::vector<DrawnRecord>& things) {
  const auto before = [&things](const Key& a, const Key& b) {
    const InstanceRecord &x = *things[a.thing].record, &y = *things[b.thing].record;
    return x.owner != y.owner ? x.owner < y.owner : std::ranges::lexicographical_compare(x.model, y.model);
  };
  for (auto first = keys_.begin(); first != keys_.end();) {
    const auto end = std::find_if(first, keys_.end(), [&](const Key& key) { return *first < key; });
    if (end - first > 1) std::sort(first, end, before);
    first = end;
  }
}

}  // namespace stadion
