#include "engine/scene/load_requests.h"

#include "engine/core/state_fields.h"

#include <algorithm>

namespace stadion {

std::uint32_t LoadRequests::load(const std::string& file, NodeRef owner, const Affine& X_WO, Nanoseconds at) {
  const std::uint32_t number = next_++;
  const Asked& asked = asked_[number] = {file, owner, X_WO};
  loader_.request(number, asked.file, asked.owner, asked.X_WO);
  pending_.push_back({at, number, true});
  return number;
}

bool LoadRequests::awaits(std::uint32_t number) const {
  return std::ranges::any_of(pending_, [&](const Change& c) { return c.load && c.number == number; });
}

std::optional<LoadRequests::Change> LoadRequests::takeLoad(const TimeSignature& now) {
  const auto due = std::ranges::find_if(pending_, [&](const Change& c) {
    return c.load && c.at <= now.time && loader_.takesEffect(c.number, now.time);
  });
  if (due == pending_.end()) return std::nullopt;
  const Change taken = *due;
  pending_.erase(due);
  return taken;
}

std::optional<LoadRequests::Change> LoadRequests::takeUnload(const TimeSignature& now) {
  const auto due = std::ranges::find_if(
      pending_, [&](const Change& c) { return !c.load && c.at <= now.time && !awaits(c.number); });
  if (due == pending_.end()) return std::nullopt;
  const Change taken = *due;
  pending_.erase(due);
  return taken;
}

void LoadRequests::announceUnloads(Nanoseconds now, SceneTree& tree) const {
  for (const Change& change : pending_)
    if (!change.load && change.at <= now) tree.end(change.number, change.at);
}

void LoadRequests::drop(std::uint32_t number) {
  std::erase_if(pending_, [&](const Change& c) { return c.number == number; });
}

void LoadRequests::hash(StateHash& h) const {
  for (const Change& c : pending_) {
    h.add(c.at);
    h.add(c.number);
    h.add(c.load);
  }
}

void LoadRequests::state(StateFields& f) {
  f("next load", next_), f("asked for", asked_), f("pending", pending_);
}

void LoadRequests::requestAgain(StateFields& f) {
  // The load that contains the owner came earlier; the owner says where the new load is placed.
  for (const auto& [number, asked] : asked_) {
    if (asked.owner.load >= number || !asked.X_WO.matrix().allFinite()) return f.fail();
    if (!asked.owner.valid() && asked.X_WO.matrix() != Affine::Identity().matrix()) return f.fail();
  }
  for (auto& [number, asked] : asked_) {
    if (!asked.owner.valid()) asked.file = script_;
    loader_.request(number, asked.file, asked.owner, asked.X_WO);
  }
}

bool LoadRequests::consistent(const SceneTree& tree) const {
  return std::ranges::none_of(pending_, [&](const Change& c) {
    return c.load && (!asked_.contains(c.number) || tree.load(c.number));
  });
}

}  // namespace stadion
