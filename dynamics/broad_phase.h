#pragma once
/// Who may come near whom: the boxes that things sweep, sorted along one axis. Internal to dynamics/.
///
/// Far larger boxes than most are kept apart and looked at one by one; so are those that have changed since
/// the sorting, until there are too many of them.
/// Order    visits go by what was filed, in which order; no addresses.
/// T        has a member `std::uint32_t place`, which belongs to the broad phase, `kUnfiled` at first.

#include "engine/maths/maths.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace stadion {

constexpr std::uint32_t kUnfiled = 0xffffffff;

template <class T>
class BroadPhase {
public:
  struct Entry {
    Aabb box;
    T* item = nullptr;
  };

  /// Files these, and nothing else any more.
  void file(std::vector<Entry> entries) {
    clear();
    if (entries.empty()) return;
    chooseAxis(entries);
    double mean = 0;
    std::size_t bounded = 0;
    for (const Entry& e : entries)
      if (extent(e) < 1e200) mean += extent(e), ++bounded;
    const double large = bounded ? 8 * mean / static_cast<double>(bounded) : 0;
    for (Entry& e : entries) (extent(e) <= large ? sorted_ : apart_).push_back(e);
    std::stable_sort(sorted_.begin(), sorted_.end(),
                     [&](const Entry& a, const Entry& b) { return a.box.lo[axis_] < b.box.lo[axis_]; });
    for (std::size_t i = 0; i < sorted_.size(); ++i) {
      sorted_[i].item->place = static_cast<std::uint32_t>(i);
      low_.push_back(sorted_[i].box.lo[axis_]);
      widest_ = std::max(widest_, extent(sorted_[i]));
    }
    for (std::size_t i = 0; i < apart_.size(); ++i) apart_[i].item->place = apartAt(i);
    filedApart_ = apart_.size();
  }

  /// The item now sweeps this box.
  void put(T& item, const Aabb& box) {
    if (item.place != kUnfiled) {
      Entry& e = entryOf(item);
      if ((e.box.lo.array() <= box.lo.array()).all() && (box.hi.array() <= e.box.hi.array()).all()) return;
      if (item.place >= kApart) {
        e.box = box;
        return;
      }
      e = {};
    }
    item.place = apartAt(apart_.size());
    apart_.push_back({box, &item});
  }

  void remove(T& item) {
    if (item.place != kUnfiled) entryOf(item) = {};
    item.place = kUnfiled;
  }

  void clear() {
    for (std::vector<Entry>* entries : {&sorted_, &apart_}) {
      for (const Entry& e : *entries)
        if (e.item) e.item->place = kUnfiled;
      entries->clear();
    }
    low_.clear();
    widest_ = 0, filedApart_ = 0;
  }

  /// So many have changed that sorting anew is cheaper.
  bool crowded() const { return apart_.size() - filedApart_ > 32 + sorted_.size() / 8; }

  /// Calls f(item) for everything whose box overlaps `box`. f must not file.
  template <class F>
  void eachNear(const Aabb& box, F f) const {
    const auto first = std::lower_bound(low_.begin(), low_.end(), box.lo[axis_] - widest_);
    for (auto i = static_cast<std::size_t>(first - low_.begin()); i < low_.size() && low_[i] <= box.hi[axis_]; ++i)
      if (sorted_[i].item && sorted_[i].box.overlaps(box)) f(*sorted_[i].item);
    for (const Entry& e : apart_)
      if (e.item && e.box.overlaps(box)) f(*e.item);
  }

private:
  static constexpr std::uint32_t kApart = 0x80000000;
  static std::uint32_t apartAt(std::size_t i) { return kApart + static_cast<std::uint32_t>(i); }
  double extent(const Entry& e) const { return e.box.hi[axis_] - e.box.lo[axis_]; }
  Entry& entryOf(const T& item) {
    return item.place >= kApart ? apart_[item.place - kApart] : sorted_[item.place];
  }
  /// The one along which the boxes' middles are spread most.
  void chooseAxis(const std::vector<Entry>& entries) {
    Vec3 sum = Vec3::Zero(), squares = Vec3::Zero();
    double n = 0;
    for (const Entry& e : entries) {
      const Vec3 c = e.box.centre();
      if (!(c.cwiseAbs().maxCoeff() < 1e100)) continue;
      sum += c, squares += c.cwiseAbs2();
      ++n;
    }
    axis_ = 0;
    if (n > 1) (squares - sum.cwiseAbs2() / n).maxCoeff(&axis_);
  }

  std::vector<Entry> sorted_;
  std::vector<double> low_;     ///< of the sorted ones, along the axis
  std::vector<Entry> apart_;    ///< the large ones, then those that have changed
  std::size_t filedApart_ = 0;  ///< how many large ones
  double widest_ = 0;
  int axis_ = 0;
};

}  // namespace stadion
