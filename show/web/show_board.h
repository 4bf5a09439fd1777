#pragma once
/// What a show tells the operator's page, published by its threads and read by the page's.
///
/// A thread of the show never waits here: if a reader looks at that moment, it leaves the board as it is and publishes
/// again with its next frame.
///
/// Threads  beginShow() and setPhase() on the thread that opens shows; publish() and publishHosts() on the App thread;
///          read() from any thread of the page.

#include "engine/base/time_signature.h"
#include "pipeline/operator/operator_state.h"
#include "show/console/show_cues.h"
#include "show/player/player.h"

#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

namespace stadion {

/// A host of the cluster.
struct BoardHost {
  std::string name, state;
  bool leads = false, isWell = true;
};

/// A wall, with the names of its pictures.
struct BoardWall {
  std::string name;
  std::vector<std::string> views;
};

/// What stays the same from a show's first frame to its last.
struct BoardShow {
  std::string script;
  double rate = 60;  ///< [1/s]
  std::vector<BoardWall> walls;
};

/// What changes from frame to frame.
struct BoardFrame {
  std::uint64_t frame = 0, group = 0;
  Nanoseconds time = 0;  ///< show time [ns]
  OperatorState state{};
};

enum class BoardPhase { Opening, Playing, Over };

struct BoardStatus {
  BoardPhase phase = BoardPhase::Opening;
  BoardShow show;
  BoardFrame frame;
  std::vector<ShowCue> cues;
  std::vector<BoardHost> hosts;
};

/// Returns what the board says of a show that is about to be played.
BoardShow boardShowOf(const std::string& script, const Player& player, const ShowParts& parts);

class ShowBoard {
public:
  void setPhase(BoardPhase phase);
  void beginShow(BoardShow show, const BoardFrame& first);

  /// Returns false if a reader looks just now, and nothing was published.
  bool publish(const BoardFrame& frame);
  bool publishCues(std::vector<ShowCue>& cues);
  bool publishHosts(std::vector<BoardHost>& hosts);

  BoardStatus read() const;

private:
  mutable std::mutex mutex_;
  BoardStatus status_;
};

}  // namespace stadion
