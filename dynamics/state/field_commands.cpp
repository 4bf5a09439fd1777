#include "dynamics/state/field_commands.h"

#include "dynamics/state/step_grid.h"

#include <algorithm>

namespace stadion {

void FieldCommands::switchField(FieldId field, bool on, Nanoseconds when) {
  insert({when, 0, Command::Kind::Switch, field, 0, on, 0});
}

void FieldCommands::hook(BodyId body, FieldId field, Nanoseconds when) {
  insert({when, 0, Command::Kind::Hook, field, body, true, 0});
}

void FieldCommands::unhook(BodyId body, FieldId field, Nanoseconds when) {
  insert({when, 0, Command::Kind::Unhook, field, body, false, 0});
}

void FieldCommands::insert(Command c) {
  c.order = queue_.takeOrder();
  const auto later = [](const Command& x, const Command& y) {
    return x.when != y.when ? x.when < y.when : x.order < y.order;
  };
  commands_.insert(std::upper_bound(commands_.begin(), commands_.end(), c, later), c);
  post(c);
}

void FieldCommands::post(const Command& c) const {
  if (time_.started() && time_.inWindow(c.when)) queue_.postCommand(time_.tauOf(c.when));
}

void FieldCommands::postAll() const {
  const Command* before = nullptr;
  for (const Command& c : commands_) {
    if (!before || before->when != c.when) post(c);
    before = &c;
  }
}

void FieldCommands::finish(FieldId field) {
  std::vector<Command> due;
  for (const Command& c : commands_)
    if (c.field == field && c.when <= time_.t1()) due.push_back(c);
  std::erase_if(commands_, [&](const Command& c) { return c.field == field; });
  for (const Command& c : due)
    if (c.kind == Command::Kind::Unhook || !c.on) execute(c, time_.partEnd());
}

void FieldCommands::forgetBody(BodyId id) {
  std::erase_if(commands_, [&](const Command& c) { return c.body == id; });
}

void FieldCommands::apply(double tau) {
  while (!commands_.empty() && time_.tauOf(commands_.front().when) <= tau) {
    const Command c = commands_.front();
    commands_.pop_front();
    execute(c, tau);
  }
}

/// Applies a change of fields at tau and stirs the bodies that it concerns.
void FieldCommands::execute(const Command& c, double tau) {
  FieldEntry* field = fields_.find(c.field);
  RigidBody* b = objects_.body(c.body);
  held_.accumulate(tau);
  switch (c.kind) {
  case Command::Kind::Switch:
  case Command::Kind::Expire:
    if (!field) return;
    if (c.kind == Command::Kind::Expire && (c.activation != field->activation || !field->on)) return;
    if (c.on) {
      ++field->activation;
      if (field->field.duration > 0)
        insert(
            {c.when + field->field.duration, 0, Command::Kind::Expire, c.field, 0, false, field->activation});
    }
    if (field->on == c.on) return;
    field->on = c.on;
    for (RigidBody& o : objects_.bodies())
      if (isHooked(o, c.field)) stir(o);
    return;
  case Command::Kind::Hook:
    if (!b || !field || isHooked(*b, c.field)) return;
    if (b->flight && b->flight->inVacuum && std::holds_alternative<MediumField>(field->field.law)) return;
    b->hooks.push_back({c.field});
    break;
  case Command::Kind::Unhook:
    if (!b || !isHooked(*b, c.field)) return;
    std::erase_if(b->hooks, [&](const Hook& h) { return h.field == c.field; });
    break;
  }
  if (field->on) stir(*b);
}

void FieldCommands::stir(RigidBody& b) {
  if (b.stirred || !b.enabled) return;
  b.stirred = true;
  stirred_.push_back(&b);
}

void FieldCommands::followFields() {
  const std::vector<FieldId> different = fields_.takeChanged();
  if (different.empty()) return;
  for (RigidBody& b : objects_.bodies()) {
    const bool concerned = std::ranges::any_of(
        b.hooks, [&](const Hook& h) { return std::ranges::find(different, h.field) != different.end(); });
    if (!concerned || !b.enabled) continue;
    // A pile's step goes on. So does a step that ends at once, since a part of a frame may be as short.
    if (b.mode == BodyMode::Contact &&
        (b.contact.inPile || b.contact.dueAge - b.age(time_.partStart()) <= kShortestStep))
      continue;
    stir(b);
  }
}

}  // namespace stadion
