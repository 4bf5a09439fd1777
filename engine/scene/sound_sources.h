#pragma once
/// The sound sources of a scene: what nodes play at placements.
///
/// Frames     sounds are published in World.
/// Ownership  borrows placements.
/// Threads    App only.
/// Errors     expects handles that exist; consistent() checks those of a restored snapshot.

#include "engine/core/state_fields.h"
#include "engine/published/sound_scape.h"
#include "engine/scene/placements.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace stadion {

class SoundSources {
public:
  explicit SoundSources(const Placements& placements) : placements_(placements) {}

  std::size_t add(PlacementId placement) {
    auto at = std::ranges::find(sources_, false, &Source::live);
    if (at == sources_.end()) at = sources_.insert(sources_.end(), Source{});
    *at = {placement, {}, false, true};
    return static_cast<std::size_t>(at - sources_.begin());
  }
  void set(std::size_t handle, bool on, const SoundRecord& sound) {
    sources_[handle].on = on;
    sources_[handle].sound = sound;
  }
  void remove(std::size_t handle) { sources_[handle] = {}; }
  /// Returns true if the source exists at that placement; nodes ask this when they are restored.
  bool isAt(std::size_t handle, PlacementId placement) const {
    return handle < sources_.size() && sources_[handle].live && sources_[handle].placement == placement;
  }

  /// Fills `out` with the sounds that play, at their places in World.
  void collect(std::vector<SoundRecord>& out) const {
    out.clear();
    for (const Source& s : sources_) {
      if (!s.on) continue;
      out.push_back(s.sound);
      out.back().position = placements_.world(s.placement).translation();
    }
  }
  void state(StateFields& f) { f("sounds", sources_); }
  bool consistent() const {
    return std::ranges::all_of(sources_,
                               [&](const Source& s) { return !s.live || placements_.has(s.placement); });
  }

private:
  struct Source {
    PlacementId placement = kNoPlacement;
    SoundRecord sound;
    bool on = false, live = false;

    template <class Self, class Fields>
    static void fields(Self& s, Fields& f) {
      f("placement", s.placement), f("on", s.on), f("live", s.live);
    }
  };

  const Placements& placements_;
  std::vector<Source> sources_;  ///< by handle
};

}  // namespace stadion
