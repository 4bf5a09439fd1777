#pragma once
/// Finds stages that write what they may only read (`--guard`).
///
/// Published slots and static objects are read-only pages, except for App while it publishes. Draw lists
/// cannot be, since their parts lie in memory of all kinds. Each is copied before Draw and compared
/// afterwards.
///
/// Threads  construction and destruction while no stage runs; keep() and inList() on a wall's Draw thread,
///          inScene() by a thread in its WriteGuard::Stage.

#include "pipeline/draw_list/draw_list.h"
#include "pipeline/state/scene_state.h"
#include "pipeline/state/write_guard.h"

#include <optional>
#include <string>
#include <vector>

namespace stadion {

struct WrongWrite {
  std::string what;  ///< "the published scene, field \"model\""
  NodeRef node;      ///< invalid: of no node
};

class WriteWatch {
public:
  /// Expects that the state outlives the watch. Throws std::bad_alloc.
  WriteWatch(SceneState& state, std::size_t walls);
  ~WriteWatch();
  WriteWatch(const WriteWatch&) = delete;
  WriteWatch& operator=(const WriteWatch&) = delete;

  /// The first write to the published scene in this stage.
  std::optional<WrongWrite> inScene(const WriteGuard::Stage& stage) const;
  /// Keeps a copy of the wall's list.
  void keep(std::size_t wall, const DrawList& list) { kept_[wall] = list; }
  /// How the list differs from the copy.
  std::optional<WrongWrite> inList(std::size_t wall, const DrawList& list) const;

private:
  SceneState& state_;
  WriteGuard guard_;
  std::vector<DrawList> kept_;  ///< by wall
};

}  // namespace stadion
