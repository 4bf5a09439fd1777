#pragma once
/// The force fields of a world, and what they do to a body in the present part of a frame.
///
/// Frames   World. Units: SI; accelerations in m/s2.
/// Time     a field that changes is known to the end of the part only.

#include "dynamics/body/id_table.h"
#include "dynamics/body/rigid_body.h"
#include "dynamics/motion/coupled_step.h"
#include "dynamics/motion/force_field.h"
#include "dynamics/state/world_time.h"

#include <optional>
#include <vector>

namespace stadion {

struct FieldEntry {
  FieldId id = 0;
  ForceField field;
  bool on = false;
  bool changed = false;          ///< the push may differ from the last frame's
  std::uint32_t activation = 0;  ///< counts activations: an old one's end is void
};

/// Returns true if the body is hooked to the field.
bool isHooked(const RigidBody& b, FieldId field);

class FieldSet {
public:
  explicit FieldSet(const WorldTime& time) : time_(time) {}

  FieldId add(const ForceField& field);
  void erase(FieldId id) { fields_.erase(id); }
  FieldEntry* find(FieldId id) const { return fields_.find(id); }
  bool move(FieldId id, const Pose& start, const Pose& end);
  bool setStrength(FieldId id, double start, double end);
  bool setLaw(FieldId id, const FieldLaw& law);
  /// Fields that are on and differ from the last frame, or change in this one.
  std::vector<FieldId> takeChanged();

  Vec3 accelerationAt(const RigidBody& b, const Vec3& p, const Vec3& v, double tau) const;
  /// Force and torque on a body that flies by a model: media act by the model instead of on a point.
  CoupledPush airPush(const RigidBody& b, const CoupledState& s, const Vec3& omega, double tau) const;
  /// Returns true if all that acts on the body is the same everywhere and at all times.
  bool uniformFor(const RigidBody& b) const;
  /// Returns true if what acts on the body changes within this part of the frame.
  bool feelsChange(const RigidBody& b) const;
  /// Returns true if the body is hooked to a medium that is on.
  bool inMedium(const RigidBody& b) const;
  /// Returns the push on a body under constant pulls and at most one even medium. Nothing if anything else
  /// acts.
  std::optional<EvenPull> evenPullOn(const RigidBody& b) const;
  /// How long from tau on it is known what acts on the body [s].
  double knownFor(const RigidBody& b, double tau) const;
  /// The longest step that skips no detail of a field, if the body gains `more` speed meanwhile [s].
  double timeToPass(const RigidBody& b, const Vec3& p, const Vec3& v, double more) const;

  template <class Fields>
  void state(Fields& f) {
    fields_.state("fields", f, [&](FieldId id, FieldEntry& e) {
      e.id = id;
      f("field", e.field), f("on", e.on), f("changed", e.changed), f("activation", e.activation);
    });
  }
  template <class Fields>
  void stateOfIds(Fields& f) {
    f("next field", nextField_);
  }

private:
  /// Calls f(field) for each field that the body feels.
  template <class F>
  void eachFelt(const RigidBody& b, F f) const {
    for (const Hook& h : b.hooks)
      if (const FieldEntry* e = fields_.find(h.field); e && e->on) f(e->field);
  }

  const WorldTime& time_;
  IdTable<FieldEntry> fields_;
  FieldId nextField_ = 1;
};

}  // namespace stadion
