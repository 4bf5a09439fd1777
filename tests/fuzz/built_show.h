#pragma once
/// A show without files and threads: what its scripts say, with stand-ins for models and sounds.
///
/// Threads  one.

#include "engine/build/builder.h"
#include "engine/scene/scene.h"

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace stadion::fuzz {

/// What loads are built with; nothing of it changes from show to show.
class Workshop {
public:
  Workshop();
  /// Of a document whose names are resolved and that has no errors.
  Built build(const Document& document, std::uint32_t number, NodeRef owner, const Affine& X_WO,
              std::vector<std::uint32_t> surroundings, Diagnostics& findings) const;
  MeshStore& meshes() const { return meshes_; }

private:
  mutable NodeServices services_;
  mutable MeshStore meshes_;
  MeshId box_;
  std::vector<std::unique_ptr<LoadedScene>>
      kept_{};  ///< with the shapes of all shows, because fitting them takes longest
};

/// Those of tests/fuzz/shows that are shows by themselves: one of everything, and small ones, whose states
/// are read many times as often.
struct FuzzedShow {
  std::string_view name;
  bool bodies = false;  ///< some are simulated
};
inline constexpr FuzzedShow kShows[] = {
    {"everything", true}, {"places"}, {"signals"}, {"bodies", true}, {"parts"}};

/// One of kShows, and the part that it loads.
class BuiltShow final : private SceneLoader {
public:
  BuiltShow(const Workshop& workshop, const FuzzedShow& show)
      : workshop_(workshop), show_(show.name), scene_(*this, workshop.meshes()) {}
  Scene& scene() { return scene_; }

  /// From the show's beginning. Before restore() nothing is opened.
  void open();
  /// The next frames, at 60 Hz; trackers go their ways.
  void play(std::uint64_t frames);
  /// Some frames, after what has been put back.
  void goOn();

private:
  struct Asked {
    std::string file;
    NodeRef owner;
    Affine X_WO;
  };

  void request(std::uint32_t number, const std::string& file, NodeRef owner, const Affine& X_WO) override;
  std::unique_ptr<LoadedScene> take(std::uint32_t number) override;
  void dispose(std::unique_ptr<LoadedScene>, std::uint64_t) override {}

  const Workshop& workshop_;
  std::string_view show_;
  std::map<std::uint32_t, Asked> asked_;
  std::map<std::uint32_t, std::vector<InstanceRecord>> records_;  ///< of static objects, by load
  Scene scene_;
  ChangeSet changes_;
  std::uint64_t next_ = 0;
};

}  // namespace stadion::fuzz
