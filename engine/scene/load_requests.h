#pragma once
/// The loads and unloads that a scene has asked for, and when each takes effect.
///
/// A load is prepared by the SceneLoader beside the show. It takes effect at a show time that was fixed when
/// it was requested, whenever the loader finishes, unless the loader delays it (SceneLoader::takesEffect()).
///
/// Units      show time in nanoseconds.
/// Ownership  borrows the loader; loads belong to the loader until take() returns them.
/// Threads    App only.
/// Errors     state() fails the StateFields if the requests contradict each other.

#include "engine/scene/loaded_scene.h"
#include "engine/scene/scene_tree.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace stadion {

class LoadRequests {
public:
  /// A load or unload that is pending.
  struct Change {
    Nanoseconds at = 0;
    std::uint32_t number = 0;
    bool load = false;

    template <class Self, class Fields>
    static void fields(Self& c, Fields& f) {
      f("at", c.at), f("number", c.number), f("load", c.load);
    }
  };

  explicit LoadRequests(SceneLoader& loader) : loader_(loader) {}

  /// Asks for `file` below `owner`, which is at X_WO now. Returns the new load's number.
  std::uint32_t load(const std::string& file, NodeRef owner, const Affine& X_WO, Nanoseconds at);
  /// A load that has not arrived yet is removed as soon as it arrives.
  void unload(std::uint32_t number, Nanoseconds at) { pending_.push_back({at, number, false}); }
  /// Returns true if that load was requested and has not taken effect yet.
  bool awaits(std::uint32_t number) const;
  bool nonePending() const { return pending_.empty(); }

  /// Takes the first pending load that takes effect in this frame.
  std::optional<Change> takeLoad(const TimeSignature& now);
  /// Takes the first pending unload that takes effect in this frame. A load that is late delays its unload.
  std::optional<Change> takeUnload(const TimeSignature& now);
  /// Announces the unloads of this frame to the tree. They take place at the frame's end.
  void announceUnloads(Nanoseconds now, SceneTree& tree) const;
  /// Drops what is pending for that load.
  void drop(std::uint32_t number);
  /// Forgets the request of a load that failed or was removed.
  void forget(std::uint32_t number) { asked_.erase(number); }

  /// Sets the show's own file, which each machine knows by itself: snapshots do not contain its path.
  void setScript(const std::string& file) { script_ = file; }
  void hash(StateHash& h) const;
  void state(StateFields& f);
  /// After state() has restored: asks the loader for all files again.
  void requestAgain(StateFields& f);
  bool asked(std::uint32_t number) const { return asked_.contains(number); }
  /// Returns true if restored requests fit the loads of the tree.
  bool consistent(const SceneTree& tree) const;

private:
  /// The arguments of a request for a load.
  struct Asked {
    std::string file;
    NodeRef owner;
    Affine X_WO = Affine::Identity();

    template <class Self, class Fields>
    static void fields(Self& a, Fields& f) {
      std::string file = a.owner.valid() ? a.file : "";  // see setScript()
      f("file", file), f("owner", a.owner), f("place", a.X_WO);
      if (f.restores()) a.file = file;
    }
  };

  SceneLoader& loader_;
  std::uint32_t next_ = 1;  ///< number of the next load
  std::vector<Change> pending_;
  std::map<std::uint32_t, Asked> asked_;  ///< by number: of loads that are installed or will come
  std::string script_;
};

}  // namespace stadion
