#pragma once
/// The progress of Cull in a draw list that Draw has already begun. So Draw need not wait until Cull has
/// filled the whole list (CULLoDRAW in OpenGL Performer). The picture is that of a complete list.
///
/// Order    Cull sets everything but the items and calls begin(). Then it fills the items in the list's
///          order, the opaque ones first, and calls reach() on the way. At the end it calls finish(). Before
///          Draw reads an item, it calls await().
/// Threads  restart(), begin(), reach(), finish(): the Cull thread that fills the list. await(), isVoid(),
///          isCutShort(): the Draw thread that draws it. stop(): any thread.

#include <condition_variable>
#include <cstddef>
#include <functional>
#include <limits>
#include <mutex>
#include <utility>

namespace stadion {

class ListFilling {
public:
  static constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();

  /// `hand`: gives the list to Draw; called once for each list, by Cull. `early`: that is done when it
  /// begins, else when it has finished.
  ListFilling(std::function<void()> hand, bool early) : hand_(std::move(hand)), early_(early) {}

  /// Nothing is there yet.
  void restart() {
    const std::lock_guard lock(mutex_);
    handed_ = void_ = false;
    there_ = 0;
  }
  /// Everything but the items is there, and how many there will be.
  void begin() {
    if (early_) hand();
  }
  /// So many of the opaque items are there.
  void reach(std::size_t items) {
    if (handed_) set(items, false);
  }
  /// All is there. `isVoid`: it was made from a slot that was taken away meanwhile, or is not complete, and
  /// must not be shown.
  void finish(bool isVoid = false) {
    set(kAll, isVoid);
    hand();
  }
  /// So many opaque items are there: more than `beyond`; kAll = everything is.
  std::size_t await(std::size_t beyond) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return there_ > beyond || stopped_; });
    return stopped_ ? kAll : there_;
  }
  /// Waits until everything is there; false: it is void.
  bool isWhole() {
    await(kAll - 1);
    return !isVoid();
  }
  /// Returns true if the finished or stopped list is void.
  bool isVoid() const {
    const std::lock_guard lock(mutex_);
    return void_ || (stopped_ && there_ != kAll);
  }
  /// Returns true if the run ended before it was filled: what was drawn of it is no picture.
  bool isCutShort() const {
    const std::lock_guard lock(mutex_);
    return stopped_ && there_ != kAll;
  }
  /// Ends the filling, and all waits for it.
  void stop() {
    {
      const std::lock_guard lock(mutex_);
      stopped_ = true;
    }
    changed_.notify_all();
  }

private:
  void hand() {
    if (handed_) return;
    handed_ = true;
    hand_();
  }
  void set(std::size_t there, bool isVoid) {
    {
      const std::lock_guard lock(mutex_);
      there_ = there;
      void_ = isVoid;
    }
    changed_.notify_all();
  }

  std::function<void()> hand_;
  const bool early_;
  bool handed_ = false;  ///< Cull's
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::size_t there_ = 0;
  bool void_ = false, stopped_ = false;
};

}  // namespace stadion
