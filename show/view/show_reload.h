#pragma once
/// A show that is read again while the one before it plays on.
///
/// Its scripts are read once and checked first. So a mistake is reported before any asset is read, and the
/// text that was checked is the text that plays. Recording begins when it plays.
///
/// Threads  the caller's. A thread of its own reads the show; it ends with this object.

#include "engine/base/diagnostic.h"
#include "show/view/playing_show.h"

#include <atomic>
#include <exception>
#include <memory>
#include <thread>

namespace stadion {

class ShowReload {
public:
  /// Begins to read the show that `around` names.
  explicit ShowReload(ShowSurroundings around);
  /// Stops reading, and drops the files that are not read yet.
  ~ShowReload();

  bool done() const { return done_; }
  /// Returns the show that was opened; null if it has errors, which are in the findings. Expects done().
  std::unique_ptr<PlayingShow> take(Diagnostics& findings);

private:
  void read();

  ShowSurroundings around_;
  std::unique_ptr<PlayingShow> show_;
  Diagnostics errors_;
  std::exception_ptr thrown_;
  std::atomic<bool> done_ = false;
  std::thread thread_;
};

}  // namespace stadion
