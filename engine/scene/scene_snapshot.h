#pragma once
/// Saves, restores and compares the state of a scene, field by field (engine/core/state_fields.h).
///
/// The state is all that the show's future depends on. A restored scene goes on to the same hashes and the
/// same pictures. What is computed from the state, such as records that are published, is made anew.
///
/// Ownership  borrows the scene.
/// Threads    App only, between two frames.
/// Errors     returned in words; after a failed restore() the scene is of no use.

#include "engine/scene/scene.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace stadion {

class SceneSnapshot {
public:
  /// Where two scenes differ.
  struct Difference {
    NodeRef node;       ///< the node with the field; invalid: the scene as a whole
    std::string field;  ///< such as "velocity"
    std::string here, there;
  };

  explicit SceneSnapshot(Scene& scene) : scene_(scene) {}

  std::vector<std::uint8_t> save();
  /// Restores what save() wrote, in a scene in which nothing was opened, with the same files. `script` is the
  /// file for open(), which may lie elsewhere now. Waits until all files are loaded. Returns nothing if all
  /// is well; else why not: this is no such state, or the files have changed.
  std::optional<std::string> restore(std::span<const std::uint8_t> state, const std::string& script);
  /// A hash of all that save() writes and of filesOf(). It visits every field of every node. stateHash() in
  /// contrast is kept up to date from frame to frame and leaves out what usually follows from the rest.
  std::uint64_t digest();
  /// A hash of the scripts and models that the scene has loaded.
  static std::uint64_t filesOf(const Scene& scene);
  /// The first difference from a state that save() wrote elsewhere after the same frame, that of a node if
  /// there is one; nothing if the states are equal.
  std::optional<Difference> difference(std::span<const std::uint8_t> there);

private:
  void visitAll(StateFields& f);
  void visitLoads(StateFields& f);
  void visitLoad(StateFields& f, std::uint32_t number);
  void visitRest(StateFields& f);
  void visitNodes(StateFields& f);
  void visitNode(StateFields& f, Node& node);
  bool consistent() const;
  bool placementsAreDistinct() const;
  std::optional<std::string> resume();

  Scene& scene_;
};

}  // namespace stadion
