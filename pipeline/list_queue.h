#pragma once
/// Draw lists on their way from a wall's Cull to its Draw: two of them, so that one is filled while the other
/// is drawn.

#include "pipeline/draw/draw_list.h"

#include <array>
#include <condition_variable>
#include <deque>
#include <mutex>

namespace stadion {

class ListQueue {
public:
  ListQueue() : empty_{&lists_[0], &lists_[1]} {}

  /// For Cull: a list to fill; waits for one. Null after stop().
  DrawList* takeEmpty() { return take(empty_); }
  void giveFilled(DrawList* list) { give(filled_, list); }
  /// For Draw: the next list; waits for it. Null after stop(), or when finished and nothing is left.
  DrawList* takeFilled() { return take(filled_); }
  void giveEmpty(DrawList* list) { give(empty_, list); }

  void finish() {
    const std::lock_guard lock(mutex_);
    finished_ = true;
    changed_.notify_all();
  }
  void stop() {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
    changed_.notify_all();
  }

private:
  DrawList* take(std::deque<DrawList*>& from) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return !from.empty() || stopped_ || (finished_ && &from == &filled_); });
    if (stopped_ || from.empty()) return nullptr;
    DrawList* list = from.front();
    from.pop_front();
    return list;
  }
  void give(std::deque<DrawList*>& to, DrawList* list) {
    const std::lock_guard lock(mutex_);
    to.push_back(list);
    changed_.notify_all();
  }

  std::array<DrawList, 2> lists_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<DrawList*> empty_, filled_;
  bool finished_ = false, stopped_ = false;
};

}  // namespace stadion
