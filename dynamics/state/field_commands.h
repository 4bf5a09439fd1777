#pragma once
/// Commands to fields at exact times, and the bodies that need new arcs because of them.

#include "dynamics/state/event_queue.h"
#include "dynamics/state/field_set.h"
#include "dynamics/state/held_bodies.h"
#include "dynamics/state/world_objects.h"

#include <deque>
#include <vector>

namespace stadion {

class FieldCommands {
public:
  FieldCommands(const WorldTime& time, EventQueue& queue, WorldObjects& objects, FieldSet& fields,
                HeldBodies& held)
      : time_(time), queue_(queue), objects_(objects), fields_(fields), held_(held) {}

  void switchField(FieldId field, bool on, Nanoseconds when);
  void hook(BodyId body, FieldId field, Nanoseconds when);
  void unhook(BodyId body, FieldId field, Nanoseconds when);
  bool empty() const { return commands_.empty(); }
  /// Executes commands of the field that are due now, and drops the others.
  void finish(FieldId field);
  void forgetBody(BodyId id);

  /// Posts an event for each time of a command in the present window.
  void postAll() const;
  /// Executes what is due up to tau.
  void apply(double tau);
  /// Bodies that feel a field which differs from the last frame, or changes, are stirred.
  void followFields();
  /// Calls restart(body) for each stirred body, once for all that has changed.
  template <class F>
  void restartStirred(F restart) {
    for (RigidBody* b : stirred_) {
      b->stirred = false;
      restart(*b);
    }
    stirred_.clear();
  }

  template <class Fields>
  void state(Fields& f) {
    const std::size_t n = f.count("commands", commands_.size());
    if (f.restores()) commands_.assign(n, {});
    for (Command& c : commands_) {
      f("when", c.when), f("order", c.order), f("kind", c.kind), f("field", c.field), f("body", c.body);
      f("on", c.on), f("activation", c.activation);
    }
  }
  template <class Fields, class Find>
  void stateOfStirred(Fields& f, const Find& find) {
    listState("stirred", stirred_, f, find);
  }

private:
  struct Command {
    enum class Kind : std::uint8_t { Switch, Expire, Hook, Unhook };
    friend constexpr Kind lastOf(Kind) { return Kind::Unhook; }
    Nanoseconds when = 0;
    std::uint64_t order = 0;
    Kind kind = Kind::Switch;
    FieldId field = 0;
    BodyId body = 0;
    bool on = false;
    std::uint32_t activation = 0;
  };
  void insert(Command c);
  void post(const Command& c) const;
  void execute(const Command& c, double tau);
  void stir(RigidBody& b);

  const WorldTime& time_;
  EventQueue& queue_;
  WorldObjects& objects_;
  FieldSet& fields_;
  HeldBodies& held_;
  std::deque<Command> commands_;  ///< in the order of (when, order)
  std::vector<RigidBody*> stirred_;
};

}  // namespace stadion
