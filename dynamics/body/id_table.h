#pragma once
/// Things that keep their address and are found by an id that counts up and is never used again. Internal to
/// dynamics/.
///
/// Order    iteration is by id. Cost: finding is one look when little has been erased, else a binary search;
///          erasing costs little, as the gaps are closed once they are half of all.

#include <algorithm>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace stadion {

template <class T>
class IdTable {
  struct Entry {
    std::uint32_t id;
    std::unique_ptr<T> item;
  };
  std::vector<Entry> entries_;
  std::size_t gaps_ = 0;  ///< entries without an item

  auto at(std::uint32_t id) const {
    if (entries_.empty() || id < entries_.front().id) return entries_.end();
    const std::size_t guess = id - entries_.front().id;  // right if there is no gap before it
    auto found = entries_.begin();
    if (guess < entries_.size() && entries_[guess].id == id)
      found += static_cast<std::ptrdiff_t>(guess);
    else
      found = std::ranges::lower_bound(entries_, id, {}, &Entry::id);
    return found != entries_.end() && found->id == id && found->item ? found : entries_.end();
  }

  template <class U, class Base>
  struct Iterator {
    Base base, end;
    U& operator*() const { return *base->item; }
    Iterator& operator++() {
      ++base;
      return overGaps();
    }
    Iterator& overGaps() {
      while (base != end && !base->item) ++base;
      return *this;
    }
    bool operator!=(const Iterator& o) const { return base != o.base; }
  };

public:
  /// `id` is greater than every one before.
  T& add(std::uint32_t id) { return *entries_.emplace_back(Entry{id, std::make_unique<T>()}).item; }
  T* find(std::uint32_t id) const {
    const auto found = at(id);
    return found == entries_.end() ? nullptr : found->item.get();
  }
  void erase(std::uint32_t id) {
    const auto found = at(id);
    if (found == entries_.end()) return;
    entries_[static_cast<std::size_t>(found - entries_.begin())].item = nullptr;
    if (2 * ++gaps_ <= entries_.size()) return;
    std::erase_if(entries_, [](const Entry& e) { return !e.item; });
    gaps_ = 0;
  }
  template <class F>
  void eachId(const F& f) const {
    for (const Entry& e : entries_)
      if (e.item) f(e.id);
  }
  /// Saves or restores the ids, and calls each(id, item) for the items' own fields.
  template <class Name, class Fields, class Each>
  void state(const Name& name, Fields& f, const Each& each) {
    std::vector<std::uint32_t> ids;
    eachId([&](std::uint32_t id) { ids.push_back(id); });
    f(name, ids);
    if (f.restores()) *this = {};
    std::uint32_t last = 0;
    for (const std::uint32_t id : ids) {
      if (f.failed()) return;
      if (f.restores() && id <= std::exchange(last, id)) return f.fail();
      T& item = f.restores() ? add(id) : *find(id);
      each(id, item);
    }
  }
  std::size_t size() const { return entries_.size() - gaps_; }
  bool empty() const { return size() == 0; }

  auto begin() const { return first<const T>(entries_); }
  auto end() const { return Iterator<const T, decltype(entries_.begin())>{entries_.end(), entries_.end()}; }
  auto begin() { return first<T>(entries_); }
  auto end() { return Iterator<T, decltype(entries_.begin())>{entries_.end(), entries_.end()}; }

private:
  template <class U, class Entries>
  static auto first(Entries& entries) {
    return Iterator<U, decltype(entries.begin())>{entries.begin(), entries.end()}.overGaps();
  }
};

/// Saves or restores a list of such things by their ids; find(id) returns the item or null.
template <class Name, class T, class Fields, class Find>
void listState(const Name& name, std::vector<T*>& list, Fields& f, const Find& find) {
  std::vector<std::uint32_t> ids;
  for (const T* item : list) ids.push_back(item->id);
  f(name, ids);
  if (!f.restores()) return;
  list.clear();
  for (const std::uint32_t id : ids) {
    T* item = find(id);
    if (!item) return f.fail();
    list.push_back(item);
  }
}

}  // namespace stadion
