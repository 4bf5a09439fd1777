#include "pipeline/draw_list/instance_batches.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace stadion {
namespace {

enum class Handedness { Kept, Mirrored, NotFinite };

Handedness handednessOf(const InstanceMatrix& m) {
  double sum = 0;
  for (const float x : m) sum += std::fabs(static_cast<double>(x));
  if (!std::isfinite(sum)) return Handedness::NotFinite;
  const auto at = [&](std::size_t i) { return static_cast<double>(m[i]); };
  const double determinant = at(0) * (at(5) * at(10) - at(6) * at(9)) -
                             at(1) * (at(4) * at(10) - at(6) * at(8)) +
                             at(2) * (at(4) * at(9) - at(5) * at(8));
  return determinant < 0 ? Handedness::Mirrored : Handedness::Kept;
}

bool alike(const DrawItem& a, const DrawItem& b) {
  return a.mesh == b.mesh && a.level == b.level && a.figure == b.figure && a.paint == b.paint;
}

}  // namespace

/// Another instance, seen by those views.
void InstanceBatch::add(std::uint32_t views) {
  constexpr std::uint32_t kOfAWall = (1U << DrawList::kMostViews) - 1;
  for (std::uint32_t left = views & kOfAWall; left != 0; left &= left - 1) {
    const auto view = static_cast<std::size_t>(std::countr_zero(left));
    if (ends[view] == 0) begins[view] = count;
    ends[view] = count + 1;
  }
  ++count;
}

void InstanceBatches::add(const DrawItem& item) {
  matrices_.push_back(item.model);
  distances_.push_back(item.distance);
  if (withOwners_) {
    owners_.push_back(item.owner);
    pixels_.push_back(item.pixels);
  }
}

void InstanceBatches::addRun(std::span<const DrawItem> run, bool mirrored) {
  const auto first = static_cast<std::uint32_t>(matrices_.size());
  const Handedness wanted = mirrored ? Handedness::Mirrored : Handedness::Kept;
  const DrawItem& like = run.front();
  InstanceBatch batch{like.mesh, like.level, like.figure, like.paint, first, 0, mirrored, {}, {}};
  for (const DrawItem& item : run) {
    if (handednessOf(item.model) != wanted) continue;
    add(item);
    batch.add(item.views);
  }
  if (batch.count > 0) opaque_.push_back(batch);
}

void InstanceBatches::begin(bool withOwners) {
  withOwners_ = withOwners;
  matrices_.clear();
  distances_.clear();
  owners_.clear();
  pixels_.clear();
  opaque_.clear();
  transparent_.clear();
  taken_ = refused_ = 0;
}

void InstanceBatches::addOpaque(std::span<const DrawItem> list, std::size_t end) {
  constexpr std::size_t kPortion = DrawList::kPortion;
  while (taken_ < end) {
    const std::size_t count = std::min(kPortion, list.size() - taken_);
    if (taken_ + count > end) return;
    addPortion(list.subspan(taken_, count));
    taken_ += count;
  }
}

void InstanceBatches::addPortion(std::span<const DrawItem> items) {
  const std::size_t before = matrices_.size();
  for (std::size_t begin = 0; begin < items.size();) {
    std::size_t end = begin + 1;
    while (end < items.size() && alike(items[end], items[begin])) ++end;
    const std::span run = items.subspan(begin, end - begin);
    addRun(run, false);
    addRun(run, true);
    begin = end;
  }
  refused_ += items.size() - (matrices_.size() - before);
}

void InstanceBatches::addTransparent(std::span<const DrawItem> items) {
  const std::size_t before = matrices_.size();
  for (const DrawItem& item : items) {
    const Handedness hand = handednessOf(item.model);
    if (hand == Handedness::NotFinite) continue;
    const bool mirrored = hand == Handedness::Mirrored;
    const InstanceBatch* last = transparent_.empty() ? nullptr : &transparent_.back();
    if (!last || last->mesh != item.mesh || last->level != item.level || last->figure != item.figure ||
        last->paint != item.paint || last->mirrored != mirrored)
      transparent_.push_back({item.mesh,
                              item.level,
                              item.figure,
                              item.paint,
                              static_cast<std::uint32_t>(matrices_.size()),
                              0,
                              mirrored,
                              {},
                              {}});
    add(item);
    transparent_.back().add(DrawItem::kAllViews);
  }
  refused_ += items.size() - (matrices_.size() - before);
}

}  // namespace stadion
