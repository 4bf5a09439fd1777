#pragma once
/// The broad phase: the boxes that things sweep, in strips along one axis, sorted along another. It finds the
/// pairs that may come near each other. Internal to dynamics/.
///
/// Boxes that are far larger than most are kept apart and visited one by one. So are boxes that have changed
/// since the last sort, until sorting again is cheaper.
/// Order    visits go by what was filed, in which order; no addresses.
/// T        has a member `std::uint32_t place`, which belongs to the broad phase, `kUnfiled` at first.

#include "engine/maths/maths.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
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
    chooseAxes(entries);
    Vec3 mean = Vec3::Zero();
    double bounded = 0;
    for (const Entry& e : entries)
      if (extent(e).maxCoeff() < 1e200) {
        mean += extent(e);
        ++bounded;
      }
    mean /= std::max(bounded, 1.0);
    const double large = bounded > 0 ? 8 * std::max(mean[along_], mean[across_]) : 0;
    for (Entry& e : entries)
      (std::max(extent(e)[along_], extent(e)[across_]) <= large ? sorted_ : apart_).push_back(e);
    for (std::size_t i = 0; i < apart_.size(); ++i) apart_[i].item->place = apartAt(i);
    filedApart_ = apart_.size();
    sortIntoStrips(2 * mean[across_]);
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
    strips_.clear();
    widest_ = 0;
    widestAcross_ = 0;
    filedApart_ = 0;
  }

  /// Returns true if so many boxes have changed that sorting all of them is cheaper.
  bool crowded() const {
    constexpr std::size_t kFew = 32;  // in most frames it is asked four times, and no more have changed
    const std::size_t changed = apart_.size() - filedApart_;
    return changed > kFew &&
           static_cast<double>(changed) > kFew + 4 * std::sqrt(static_cast<double>(sorted_.size()));
  }

  /// Calls f(item) for everything whose box overlaps `box`. f must not file.
  template <class F>
  void eachNear(const Aabb& box, F f) const {
    const std::size_t end = strips_.empty() ? 0 : stripOf(box.hi[across_]) + 1;
    for (std::size_t s = strips_.empty() ? 0 : stripOf(box.lo[across_] - widestAcross_); s < end; ++s) {
      const auto last = low_.begin() + strips_[s + 1];
      auto i = std::lower_bound(low_.begin() + strips_[s], last, box.lo[along_] - widest_);
      for (; i != last && *i <= box.hi[along_]; ++i) {
        const Entry& e = sorted_[static_cast<std::size_t>(i - low_.begin())];
        if (e.item && e.box.overlaps(box)) f(*e.item);
      }
    }
    for (const Entry& e : apart_)
      if (e.item && e.box.overlaps(box)) f(*e.item);
  }

  /// Saves or restores the whole tree; `find` returns the item of an id.
  template <class Fields, class Find>
  void state(Fields& f, const Find& find) {
    for (auto [name, entries] : {std::pair("sorted", &sorted_), std::pair("apart", &apart_)}) {
      const std::size_t n = f.count(name, entries->size());
      if (f.restores()) entries->assign(n, Entry{});
      for (Entry& e : *entries) {
        std::uint32_t id = e.item ? e.item->id : 0;
        f("id", id), f("low", e.box.lo), f("high", e.box.hi);
        if (!f.restores()) continue;
        e.item = id ? find(id) : nullptr;
        if (id && !e.item) return f.fail();
      }
    }
    std::vector<std::uint64_t> strips(strips_.begin(), strips_.end());
    f("low ends", low_), f("strips", strips), f("filed apart", filedApart_);
    f("widest", widest_), f("widest across", widestAcross_);
    f("edge", edge_), f("width", width_), f("along", along_), f("across", across_);
    if (!f.restores()) return;
    if (along_ < 0 || along_ > 2 || across_ < 0 || across_ > 2 || filedApart_ > apart_.size() ||
        !(width_ > 0))
      return f.fail();
    strips_.assign(strips.begin(), strips.end());
    const bool whole =
        strips.empty() ? sorted_.empty() : strips.size() > 1 && strips.back() == sorted_.size();
    if (!whole || !std::ranges::is_sorted(strips) || low_.size() != sorted_.size()) f.fail();
  }

private:
  static constexpr std::uint32_t kApart = 0x80000000;
  static std::uint32_t apartAt(std::size_t i) { return kApart + static_cast<std::uint32_t>(i); }
  static Vec3 extent(const Entry& e) { return e.box.hi - e.box.lo; }
  Entry& entryOf(const T& item) {
    return item.place >= kApart ? apart_[item.place - kApart] : sorted_[item.place];
  }
  std::size_t stripOf(double x) const {
    const double s = (x - edge_) / width_;
    return s > 0 ? std::min(static_cast<std::size_t>(std::min(s, 1e9)), strips_.size() - 2) : 0;
  }

  /// Chooses the two axes along which the middles of the boxes are spread most.
  void chooseAxes(const std::vector<Entry>& entries) {
    Vec3 sum = Vec3::Zero(), squares = Vec3::Zero();
    double n = 0;
    for (const Entry& e : entries) {
      const Vec3 c = e.box.centre();
      if (!(c.cwiseAbs().maxCoeff() < 1e100)) continue;
      sum += c;
      squares += c.cwiseAbs2();
      ++n;
    }
    Vec3 spread = n > 1 ? Vec3(squares - sum.cwiseAbs2() / n) : Vec3::Zero();
    spread.maxCoeff(&along_);
    spread[along_] = -1e300;
    spread.maxCoeff(&across_);
  }

  void sortIntoStrips(double width) {
    if (sorted_.empty()) return;
    double far = -1e300;
    edge_ = 1e300;
    for (const Entry& e : sorted_) {
      edge_ = std::min(edge_, e.box.lo[across_]);
      far = std::max(far, e.box.lo[across_]);
      widest_ = std::max(widest_, extent(e)[along_]);
      widestAcross_ = std::max(widestAcross_, extent(e)[across_]);
    }
    const double most = std::sqrt(static_cast<double>(sorted_.size())) * 4;
    width_ = std::max({width, (far - edge_) / most, 1e-9});
    strips_.assign(static_cast<std::size_t>((far - edge_) / width_) + 2, 0);
    // By strip, within a strip along the axis, then as filed.
    std::vector<std::uint32_t> strip;
    for (const Entry& e : sorted_) strip.push_back(static_cast<std::uint32_t>(stripOf(e.box.lo[across_])));
    std::vector<std::uint32_t> order(sorted_.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<std::uint32_t>(i);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      if (strip[a] != strip[b]) return strip[a] < strip[b];
      const double la = sorted_[a].box.lo[along_], lb = sorted_[b].box.lo[along_];
      return la != lb ? la < lb : a < b;
    });
    std::vector<Entry> sorted;
    sorted.reserve(order.size());
    for (const std::uint32_t i : order) {
      sorted_[i].item->place = static_cast<std::uint32_t>(sorted.size());
      low_.push_back(sorted_[i].box.lo[along_]);
      sorted.push_back(sorted_[i]);
      ++strips_[strip[i] + 1];
    }
    for (std::size_t s = 1; s < strips_.size(); ++s) strips_[s] += strips_[s - 1];
    sorted_ = std::move(sorted);
  }

  std::vector<Entry> sorted_;
  std::vector<double> low_;             ///< lower ends of the sorted boxes, along the axis
  std::vector<std::ptrdiff_t> strips_;  ///< where each strip begins among them, and the end
  std::vector<Entry> apart_;            ///< the large ones, then those that have changed
  std::size_t filedApart_ = 0;          ///< how many large ones
  double widest_ = 0, widestAcross_ = 0;
  double edge_ = 0, width_ = 1;  ///< start of the first strip, width of a strip
  int along_ = 0, across_ = 1;
};

}  // namespace stadion
