#pragma once
/// Draw lists on their way from a wall's Cull to its Draw. There are two: one is filled while the other is
/// drawn.
///
/// Threads  takeEmpty() and finish() on the wall's Cull thread, takeHanded() and giveEmpty() on its Draw
///          thread; stop() on any.

#include "pipeline/draw_list/draw_list.h"
#include "pipeline/draw_list/list_filling.h"

#include <array>
#include <condition_variable>
#include <mutex>
#include <vector>

namespace stadion {

class ListQueue {
public:
  /// `early`: Draw may take a list while it is filled (ListFilling), else only after that.
  explicit ListQueue(bool early)
      : fillings_{ListFilling([this] { give(handed_, &lists_[0]); }, early),
                  ListFilling([this] { give(handed_, &lists_[1]); }, early)},
        empty_{&lists_[0], &lists_[1]} {
    handed_.reserve(lists_.size());
    for (std::size_t i = 0; i < lists_.size(); ++i) lists_[i].filling = &fillings_[i];
  }

  /// For Cull: waits for a list to fill. Null after stop(). It goes to Draw by its ListFilling.
  DrawList* takeEmpty() {
    DrawList* list = take(empty_);
    if (list) list->filling->restart();
    return list;
  }
  /// For Draw: waits for the next list. Null after stop(), or when finished and nothing is left.
  DrawList* takeHanded() { return take(handed_); }
  void giveEmpty(DrawList* list) { give(empty_, list); }

  void finish() {
    const std::lock_guard lock(mutex_);
    finished_ = true;
    changed_.notify_all();
  }
  /// Ends all waiting. Incomplete lists are void.
  void stop() {
    {
      const std::lock_guard lock(mutex_);
      stopped_ = true;
    }
    changed_.notify_all();
    for (ListFilling& filling : fillings_) filling.stop();
  }

private:
  DrawList* take(std::vector<DrawList*>& from) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return !from.empty() || stopped_ || (finished_ && &from == &handed_); });
    if (stopped_ || from.empty()) return nullptr;
    DrawList* list = from.front();
    from.erase(from.begin());
    return list;
  }
  void give(std::vector<DrawList*>& to, DrawList* list) {
    const std::lock_guard lock(mutex_);
    to.push_back(list);
    changed_.notify_all();
  }

  std::array<DrawList, 2> lists_;
  std::array<ListFilling, 2> fillings_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<DrawList*> empty_, handed_;  ///< the oldest first
  bool finished_ = false, stopped_ = false;
};

}  // namespace stadion
