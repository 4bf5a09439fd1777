#pragma once
/// Things that keep their address and are found by an id that counts up and is never used again. Internal to
/// dynamics/.
///
/// Order    iteration is by id. Cost: finding is one look when nothing older has been erased, else a binary
/// search.

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

namespace stadion {

template <class T>
class IdTable {
  struct Entry {
    std::uint32_t id;
    std::unique_ptr<T> item;
  };
  std::vector<Entry> entries_;

  auto at(std::uint32_t id) const {
    if (entries_.empty() || id < entries_.front().id) return entries_.end();
    const std::size_t guess = id - entries_.front().id;  // right if there is no gap before it
    if (guess < entries_.size() && entries_[guess].id == id)
      return entries_.begin() + static_cast<std::ptrdiff_t>(guess);
    const auto found = std::ranges::lower_bound(entries_, id, {}, &Entry::id);
    return found != entries_.end() && found->id == id ? found : entries_.end();
  }

  template <class U, class Base>
  struct Iterator {
    Base base;
    U& operator*() const { return *base->item; }
    Iterator& operator++() {
      ++base;
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
    if (const auto found = at(id); found != entries_.end()) entries_.erase(found);
  }
  std::size_t size() const { return entries_.size(); }
  bool empty() const { return entries_.empty(); }

  auto begin() const { return Iterator<const T, decltype(entries_.begin())>{entries_.begin()}; }
  auto end() const { return Iterator<const T, decltype(entries_.begin())>{entries_.end()}; }
  auto begin() { return Iterator<T, decltype(entries_.begin())>{entries_.begin()}; }
  auto end() { return Iterator<T, decltype(entries_.begin())>{entries_.end()}; }
};

}  // namespace stadion
