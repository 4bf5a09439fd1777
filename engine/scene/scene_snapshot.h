#pragma once
/// Saves, restores and compares the state of a scene, field by field (engine/core/state_fields.h).
///
/// The state is all that the show's future depends on. A restored scene continues with the same hashes and
/// the same pictures. Values that follow from the state, such as published records, are computed again.
///
/// Ownership  borrows the scene.
/// Threads    App only, between two frames.
/// Errors     restore() returns the reason. After a failure, destroy the scene.

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
    std::string field;  ///< name of the field, such as "velocity"
    std::string here, there;
  };

  struct NamedField {
    NodeRef node;  ///< as in Difference
    std::string name, value;
  };

  explicit SceneSnapshot(Scene& scene) : scene_(scene) {}

  std::vector<std::uint8_t> save();
  /// Restores what save() wrote. Expects a scene in which nothing was opened, and the same files. `script` is
  /// the file for open(), whose path may differ. Waits until all files are loaded. Returns nothing on
  /// success; else the reason: the bytes are no saved state, or the files have changed.
  std::optional<std::string> restore(std::span<const std::uint8_t> state, const std::string& script);
  /// A hash of all that save() writes and of filesOf(). It visits every field of every node.
  /// Scene::stateHash() is updated from frame to frame, and omits fields that usually follow from others.
  std::uint64_t digest();
  /// A hash of the scripts and models that the scene has loaded.
  static std::uint64_t filesOf(const Scene& scene);
  /// The first difference from a state that another process saved after the same frame. A difference in a
  /// node comes before one in the scene. Returns nothing if the states are equal.
  std::optional<Difference> difference(std::span<const std::uint8_t> there);

  /// All fields that are not zero, as text: of the nodes in their order, then of the scene. Lists are
  /// shortened to hashes. Unlike the bytes of save(), another build can compare it.
  std::vector<NamedField> named();

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
