#pragma once
/// Who may touch which slot of the scene state when, and which frame all walls show next.
///
/// App asks for a slot to write; the Cull stages of all walls are handed the same frames in the same order,
/// each as a lease on its slot. A slot under lease is never written. The choice of the frame is made once,
/// when the first wall asks.
///
/// Threads  every function from any thread; one thread per wall.

#include "pipeline/frame/frame_ticket.h"
#include "pipeline/state/chunk_arena.h"

#include <array>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>

namespace stadion {

enum class Delivery {
  Every,   ///< every frame is shown; App waits when the readers fall behind (recording, regression)
  Latest,  ///< the newest frame is shown; App never waits for a reader (live)
};

struct Lease {
  std::size_t slot = 0;
  FrameTicket ticket;
  std::uint64_t serial = 0;  ///< which frame to show this is, counted from 0
};

class FrameSlots {
public:
  FrameSlots(std::size_t walls, Delivery delivery,
             std::chrono::milliseconds deadline = std::chrono::milliseconds(2000));

  /// A slot for App to write; waits for one if need be. Nothing after stop().
  std::optional<std::size_t> beginWrite();
  void endWrite(std::size_t slot, const FrameTicket& ticket);

  /// The next frame for `wall`; waits for it. Nothing when the run is over.
  std::optional<Lease> lease(std::size_t wall);
  /// Gives the lease back. False if it had lasted past its deadline and the slot was taken away: the work is
  /// void.
  bool release(const Lease& lease);

  /// So many frames at most are under way between App, or where only the newest is shown between its choice,
  /// and the swap: the fewer, the younger is what is seen, and the less the stages overlap. 0 = as many as
  /// there is room for. It may change at any time. One more may begin once only `last` walls still draw the
  /// oldest: processors have nothing else to do.
  void limitUnderWay(std::size_t frames, std::size_t last = 0);
  /// A wall has drawn its frame, and waits for the others.
  void drawn();
  /// A frame has been shown on all walls.
  void shown();

  /// No further frame will be written; the readers finish what there is.
  void finish();
  /// Everybody stops waiting, at once.
  void stop();

private:
  enum class State { Free, Writing, Published, Leased };
  struct Slot {
    State state = State::Free;
    FrameTicket ticket;
    std::size_t readers = 0;
    std::uint64_t serial = 0;
    std::chrono::steady_clock::time_point since{};

    std::uint64_t written =
        0;  ///< how many frames had been written before; a frame that stands still comes again
  };
  struct Selection {
    std::uint64_t serial = 0;
    std::size_t slot = 0;
    FrameTicket ticket;
    std::size_t unread = 0;  ///< walls that have not asked for it yet
  };

  std::optional<std::size_t> writable();
  std::optional<std::size_t> choose() const;
  bool mayBegin(std::uint64_t begun) const;
  bool ending() const;

  std::mutex mutex_;
  std::condition_variable changed_;
  std::array<Slot, kSlots> slots_;
  std::vector<std::uint64_t> cursor_;  ///< per wall: the serial it wants next
  std::vector<Selection> selections_;  ///< a few, the oldest first; a deque would allocate now and then
  std::uint64_t nextSerial_ = 0, writes_ = 0, shown_ = 0;
  std::size_t mostUnderWay_ = 0, last_ = 0;
  std::size_t drawn_ = 0;  ///< walls that have drawn the oldest frame under way
  Delivery delivery_;
  std::chrono::milliseconds deadline_;
  bool finished_ = false, stopped_ = false;
};

}  // namespace stadion
