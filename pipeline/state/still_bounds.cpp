#include "pipeline/state/still_bounds.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <vector>

namespace stadion {
namespace {

struct Header {
  double origin[3];
  std::uint32_t count;
};

/// A sphere to be sorted: its centre and its radius, relative to the origin [m].
struct Item {
  std::array<float, 4> at;
  std::uint32_t index;
};

using Items = std::span<Item>;

std::size_t aligned(std::size_t bytes) {
  return (bytes + 63) / 64 * 64;
}

std::size_t orderAt() {
  return aligned(sizeof(Header));
}
std::size_t floatsAt(std::size_t records) {
  return orderAt() + aligned(records * sizeof(std::uint32_t));
}

/// Returns the key for halving: an axis, or 3 for the radius.
std::size_t splitOf(Items items) {
  std::array<float, 4> lo = items[0].at, hi = lo;
  double radii = 0;
  for (const Item& item : items) {
    for (std::size_t k = 0; k < 4; ++k) {
      lo[k] = std::min(lo[k], item.at[k]);
      hi[k] = std::max(hi[k], item.at[k]);
    }
    radii += double{item.at[3]};
  }
  std::size_t widest = 0;
  for (const std::size_t k : {1, 2})
    if (hi[k] - lo[k] > hi[widest] - lo[widest]) widest = k;
  const double mean = radii / static_cast<double>(items.size());
  const bool huge = 8 * mean > double{hi[widest] - lo[widest]};
  return huge && double{hi[3] - lo[3]} > mean ? 3 : widest;
}

/// Puts neighbours into the same group of `unit`, and eight groups into the same one of the next level.
void arrange(Items items, std::size_t unit) {
  while (items.size() <= unit) {
    if (unit == BoundsLayout::kWide) return;
    unit /= BoundsLayout::kWide;
  }
  const std::size_t groups = (items.size() + unit - 1) / unit, half = (groups + 1) / 2 * unit;
  const std::size_t by = splitOf(items);
  std::nth_element(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(half), items.end(),
                   [by](const Item& a, const Item& b) { return a.at[by] < b.at[by]; });
  arrange(items.first(half), unit);
  arrange(items.subspan(half), unit);
}

/// Returns the middle of most of them: a single distant record does not move it.
Vec3 middleOf(std::span<const InstanceRecord> records, std::span<const std::uint32_t> shown) {
  Vec3 middle = Vec3::Zero();
  if (shown.empty()) return middle;
  std::vector<double> along(shown.size());
  for (int k = 0; k < 3; ++k) {
    std::ranges::transform(shown, along.begin(), [&](std::uint32_t i) {
      const double at = records[i].centre[k];
      return std::isfinite(at) ? at : 0;
    });
    const auto median = along.begin() + static_cast<std::ptrdiff_t>(along.size() / 2);
    std::nth_element(along.begin(), median, along.end());
    middle[k] = *median;
  }
  return middle;
}

/// Returns finite numbers, which can be sorted.
Item itemOf(const InstanceRecord& r, std::uint32_t index, const Vec3& origin) {
  const auto tame = [](double x) {
    constexpr double kMost = 1e30;
    return static_cast<float>(x < kMost ? (x > -kMost ? x : -kMost) : kMost);
  };
  return {{tame(r.centre[0] - origin[0]), tame(r.centre[1] - origin[1]), tame(r.centre[2] - origin[2]),
           tame(double{r.radius})},
          index};
}

}  // namespace

std::size_t stillBoundsBytes(std::size_t records) {
  return floatsAt(records) +
         aligned(BoundsLayout(static_cast<std::uint32_t>(records)).floats * sizeof(float));
}

void buildStillBounds(std::span<const InstanceRecord> records, std::byte* memory) {
  std::vector<std::uint32_t> shown;
  for (std::uint32_t i = 0; i < records.size(); ++i)
    if (isShown(records[i])) shown.push_back(i);
  const Vec3 origin = middleOf(records, shown);
  std::vector<Item> items(shown.size());
  std::ranges::transform(shown, items.begin(),
                         [&](std::uint32_t i) { return itemOf(records[i], i, origin); });
  std::size_t unit = BoundsLayout::kWide;
  while (unit * BoundsLayout::kWide < items.size()) unit *= BoundsLayout::kWide;
  if (!items.empty()) arrange(items, unit);

  const auto count = static_cast<std::uint32_t>(items.size());
  new (memory) Header{{origin.x(), origin.y(), origin.z()}, count};
  auto* order = reinterpret_cast<std::uint32_t*>(memory + orderAt());
  auto* floats = reinterpret_cast<float*>(memory + floatsAt(records.size()));
  for (std::uint32_t place = 0; place < count; ++place) {
    order[place] = items[place].index;
    putSphere(floats, place, records[items[place].index], origin);
  }
  const BoundsTree tree = stillBounds(memory, records.size());
  for (std::uint32_t level = 1; level <= tree.top(); ++level)
    putBoxes(floats, tree.layout, level, 0, tree.nodes(level), tree.nodes(level - 1));
}

BoundsTree stillBounds(const std::byte* memory, std::size_t records) {
  const auto& header = *reinterpret_cast<const Header*>(memory);
  BoundsTree tree;
  tree.origin = Vec3(header.origin[0], header.origin[1], header.origin[2]);
  tree.count = std::min(header.count, static_cast<std::uint32_t>(records));
  tree.order = reinterpret_cast<const std::uint32_t*>(memory + orderAt());
  tree.floats = reinterpret_cast<const float*>(memory + floatsAt(records));
  tree.layout = BoundsLayout(static_cast<std::uint32_t>(records));
  return tree;
}

}  // namespace stadion
