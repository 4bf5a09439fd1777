#pragma once
/// Controls access to the slots of the scene state, and chooses the next frame for all walls.
///
/// App asks for a slot to write. The Cull stages of all walls get the same frames in the same order, each as
/// a lease on its slot. App does not write a leased slot before the lease is older than its deadline. A
/// reader that is later learns from release() that its work is void. The frame is chosen once, when the first
/// wall asks. Walls should ask only when they can use a frame at once: then one slot always remains for App.
///
/// Threads  every function from any thread; one thread per wall.

#include "pipeline/frame/frame_ticket.h"
#include "pipeline/state/chunk_arena.h"

#include <array>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <vector>

namespace stadion {

enum class Delivery {
  Every,   ///< every frame is shown; App waits for slow readers (recording, regression)
  Latest,  ///< the newest frame is shown (live). App waits only if all slots are
           ///< leased. That cannot happen if each wall asks only with an empty list.
};

struct Lease {
  std::size_t slot = 0;
  FrameTicket ticket;
  std::uint64_t serial = 0;  ///< number of the shown frame, counted from 0
};

class FrameSlots {
public:
  FrameSlots(std::size_t walls, Delivery delivery,
             std::chrono::milliseconds deadline = std::chrono::milliseconds(2000));

  /// Returns a slot for App to write; waits for one if necessary. Returns nothing after stop().
  std::optional<std::size_t> beginWrite();
  void endWrite(std::size_t slot, const FrameTicket& ticket);

  /// Waits for the next frame for `wall`. Returns nothing when the run is over.
  std::optional<Lease> lease(std::size_t wall);
  /// Ends the lease. Returns false if it was past its deadline and the slot was taken away: the work is void.
  bool release(const Lease& lease);

  /// Limits the frames in flight; 0 = no limit besides the slots. A frame counts until the swap, from App
  /// (Every) or from its selection (Latest). With a lower limit, pictures show younger poses, and the stages
  /// overlap less. One frame more may begin as soon as at most `wallsLeft` walls still draw the oldest frame,
  /// because processors would be idle otherwise. The limit may change at any time.
  void limitInFlight(std::size_t frames, std::size_t wallsLeft = 0);
  /// Reports that a wall has drawn its frame and waits for the others.
  void noteDrawn();
  /// Reports that all walls have shown a frame.
  void noteShown();

  /// Ends writing: the readers finish the frames that exist.
  void finish();
  /// Ends all waiting at once.
  void stop();

private:
  enum class State { Free, Writing, Published, Leased };
  struct Slot {
    State state = State::Free;
    FrameTicket ticket;
    std::size_t readers = 0;
    std::uint64_t serial = 0;
    std::chrono::steady_clock::time_point since{};
    std::uint64_t written = 0;  ///< number of frames written before; a paused frame is written again
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
  bool oldestIsNearlyDrawn() const;

  std::mutex mutex_;
  std::condition_variable changed_;
  std::array<Slot, kSlots> slots_;
  std::vector<std::uint64_t> cursor_;  ///< by wall: serial of the frame that it leases next
  std::vector<Selection> selections_;  ///< a few, the oldest first; a deque would allocate now and then
  std::uint64_t nextSerial_ = 0, writes_ = 0, framesShown_ = 0;
  std::size_t mostInFlight_ = 0, wallsLeft_ = 0;
  std::size_t wallsDrawn_ = 0;  ///< walls that have drawn the oldest frame in flight
  Delivery delivery_;
  std::chrono::milliseconds deadline_;
  bool finished_ = false, stopped_ = false;
};

}  // namespace stadion
