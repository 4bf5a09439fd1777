#pragma once
/// The drawn instances of nodes: a mesh at a placement, each published as one InstanceRecord.
///
/// A change marks an instance; publishing writes the record of marked instances and of those whose placement
/// moved, each once a frame.
///
/// Frames     records are in World.
/// Ownership  borrows placements and meshes.
/// Threads    App only.
/// Errors     ids and handles are the caller's to keep: expects that they exist. consistent() checks those of
///            a restored snapshot.

#include "engine/asset/mesh_store.h"
#include "engine/published/records.h"
#include "engine/scene/placements.h"
#include "engine/scene/scene_time.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

namespace stadion {

class Degradation;
class StateFields;

class Instances {
public:
  Instances(Placements& placements, MeshStore& meshes, const SceneTime& time)
      : placements_(placements), meshes_(meshes), time_(time) {}

  // For nodes.

  InstanceId add(PlacementId placement, MeshId mesh, bool drawn, NodeRef owner);
  void remove(InstanceId id);
  /// Sets what the instance shows; kNoMesh = nothing.
  void setMesh(InstanceId id, MeshId mesh);
  /// Sets the number of the figure that the instance shows (figure_records.h).
  void setFigure(InstanceId id, std::uint16_t figure);
  /// Sets the number of the instance's paint (PaintTable), and what follows from its opacity.
  void setPaint(InstanceId id, std::uint16_t number, double opacity);
  /// Sets the sphere (in N) that holds what the instance shows; nothing: that of its mesh. Not saved.
  void setReach(InstanceId id, const std::optional<Sphere>& reach);
  /// Returns true if the instance exists and belongs to `owner`; nodes ask this when they are restored.
  bool owns(InstanceId id, NodeRef owner) const {
    return id < all_.size() && all_[id].live && all_[id].owner == owner;
  }
  const Mesh* mesh(MeshId id) const { return meshes_.find(id); }
  /// Adds a mesh that a node has made; the node gives it back with releaseMesh().
  MeshId addMesh(std::unique_ptr<const Mesh> mesh) { return meshes_.add(std::move(mesh)); }
  void releaseMesh(MeshId mesh);

  // For the scene.

  /// Marks all instances at the placement.
  void markAt(PlacementId placement);
  /// Publishes the unmarked instances at a placement that moved.
  void publishAt(PlacementId placement, const Degradation& degradation, ChangeSet& changes) {
    if (placement < first_.size() && first_[placement] != kNone) publishAll(placement, degradation, changes);
  }
  /// Publishes the unmarked instances at a fleet's members.
  void publishFleet(std::span<const PlacementId> ids, std::span<const MemberPlace> places,
                    const Degradation& degradation, ChangeSet& changes);
  /// Publishes the marked instances and hands on all records that are left.
  void publishMarked(const Degradation& degradation, ChangeSet& changes);
  /// How many records were published since the last call.
  std::uint64_t takePublished() { return std::exchange(published_, 0); }

  void state(StateFields& f);
  bool consistent() const;
  /// After state() has restored: finds the meshes again and marks all instances.
  void resume();
  /// Returns true if every instance has found its mesh.
  bool complete() const;

private:
  static constexpr InstanceId kNone = ~InstanceId{0};
  struct Instance {
    const Mesh* form = nullptr;  ///< mesh with the id `mesh`; null = none
    PlacementId placement = kNoPlacement;
    MeshId mesh = kNoMesh;
    NodeRef owner;
    InstanceId next = kNone;  ///< at the same placement
    std::uint32_t figure : 12 = 0, paint : 11 = 0;
    std::uint32_t drawn : 1 = true, live : 1 = false, changed : 1 = false;
    /// Properties of the mesh; leveled: it has simplified levels.
    std::uint32_t transparent : 1 = false, leveled : 1 = false;
    /// Properties of the paint: it lets the background shine through, or all of it.
    std::uint32_t seeThrough : 1 = false, vanished : 1 = false;
    std::uint32_t ownReach : 1 = false;  ///< not that of its mesh

    template <class Self, class Fields>
    static void fields(Self& i, Fields& f) {
      bool drawn = i.drawn, live = i.live, seeThrough = i.seeThrough, vanished = i.vanished;
      std::uint16_t figure = i.figure, paint = i.paint;
      f("placement", i.placement), f("mesh", i.mesh), f("owner", i.owner), f("next", i.next);
      f("figure", figure), f("paint", paint);
      f("drawn", drawn), f("live", live), f("see through", seeThrough), f("vanished", vanished);
      if (f.restores()) {
        if (figure > kMostFigures || paint > kMostPaints) f.fail();
        i.figure = figure & kMostFigures;
        i.paint = paint & kMostPaints;
        i.seeThrough = seeThrough;
        i.vanished = vanished;
        i.drawn = drawn;
        i.live = live;
      }
    }
  };

  void mark(InstanceId id);
  void findForm(Instance& i) const;
  const Sphere& sphereOf(const Instance& i, InstanceId id) const {
    return i.ownReach ? reaches_.at(id) : i.form->sphere;
  }
  void publishAll(PlacementId placement, const Degradation& degradation, ChangeSet& changes);
  void publish(const Instance& i, InstanceId id, const Affine& X_WN, bool shown,
               const Degradation& degradation, ChangeSet& changes);
  static void describe(const Instance& i, bool shown, const Degradation& degradation, InstanceRecord& r);
  InstanceRecord& nextRecord(InstanceId id, ChangeSet& changes);
  static void handOn(ChangeSet& changes);

  Placements& placements_;
  MeshStore& meshes_;
  const SceneTime& time_;
  std::vector<Instance> all_;  ///< by id
  std::vector<InstanceId> free_, changed_;
  std::vector<InstanceId> first_;  ///< by placement: the first of its instances
  std::unordered_map<InstanceId, Sphere> reaches_;
  std::uint64_t published_ = 0;
};

}  // namespace stadion
