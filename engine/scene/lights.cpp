#include "engine/scene/lights.h"

#include "engine/core/state_fields.h"

#include <algorithm>
#include <string>
#include <tuple>

namespace stadion {
namespace {

/// The light of a show that declares none.
LightRecord afternoonSun() {
  LightRecord sun;
  const Vec3 direction = Vec3(-0.45, 0.35, -0.8).normalized();
  const float colour[3] = {1.0f, 0.96f, 0.88f};
  for (int i = 0; i < 3; ++i) {
    sun.direction[i] = direction[i];
    sun.colour[i] = colour[i];
  }
  sun.range = 1;
  return sun;
}

/// How much of the light arrives at p, computed as the shaders do. The cone of a spot does not count: the
/// spot may light what the visitor sees.
double brightnessAt(const Vec3& p_W, const LightRecord& light) {
  const double colour =
      0.2126 * double{light.colour[0]} + 0.7152 * double{light.colour[1]} + 0.0722 * double{light.colour[2]};
  if (light.kind == 0) return colour;
  const double squared = (Vec3(light.position[0], light.position[1], light.position[2]) - p_W).squaredNorm();
  const double range = double{light.range};
  if (light.fallsOff) return colour / std::max(squared, 0.01);
  return colour / (1 + (range > 0 ? squared / (range * range) : 0));
}

}  // namespace

std::size_t Lights::add(PlacementId placement, const LightRecord& local, NodeRef node) {
  changed_ = true;
  auto at = std::find_if(lights_.begin(), lights_.end(), [](const Light& l) { return !l.live; });
  if (at == lights_.end()) at = lights_.insert(lights_.end(), Light{});
  *at = {placement, local, node, true, true};
  if (at_.size() <= placement) at_.resize(placement + 1);
  ++at_[placement];
  return static_cast<std::size_t>(at - lights_.begin());
}

void Lights::set(std::size_t handle, const LightRecord& local, bool on) {
  lights_[handle].local = local;
  lights_[handle].on = on;
  changed_ = true;
}

void Lights::remove(std::size_t handle) {
  lights_[handle].live = false;
  --at_[lights_[handle].placement];
  changed_ = true;
}

void Lights::setSky(NodeRef node, const SkyRecord& sky) {
  for (Sky& s : skies_)
    if (s.node == node) s.record = sky;
}

void Lights::removeSky(NodeRef node) {
  std::erase_if(skies_, [&](const Sky& s) { return s.node == node; });
}

SkyRecord Lights::skyRecord() const {
  SkyRecord sky = skies_.empty() ? SkyRecord{} : skies_.back().record;
  sky.environment = environments_.last([](const EnvironmentRecord& e) { return e.lit != 0; });
  sky.tones = tones_.last([](const TonesRecord&) { return true; });
  return sky;
}

void Lights::findWanted() {
  wanted_.clear();
  for (std::size_t i = 0; i < lights_.size(); ++i)
    if (lights_[i].live && lights_[i].on && placements_.shown(lights_[i].placement)) wanted_.push_back(i);
}

void Lights::choose(const Vec3& p_WH) {
  chosen_ = wanted_;
  if (wanted_.size() <= kMostLights) return;
  brightest_.clear();
  for (const std::size_t h : wanted_) brightest_.emplace_back(-brightnessAt(p_WH, inWorld(lights_[h])), h);
  std::sort(brightest_.begin(), brightest_.end(), [this](const auto& a, const auto& b) {
    return std::tie(a.first, lights_[a.second].node) < std::tie(b.first, lights_[b.second].node);
  });
  chosen_.clear();
  for (std::size_t i = 0; i < kMostLights; ++i) chosen_.push_back(brightest_[i].second);
  std::sort(chosen_.begin(), chosen_.end());
  warnOfTooMany();
}

LightRecord Lights::inWorld(const Light& light) const {
  LightRecord r = light.local;
  r.owner = light.node;
  const Affine& X_WN = placements_.world(light.placement);
  const Vec3 p = X_WN * Vec3(r.position[0], r.position[1], r.position[2]);
  const Vec3 d = (X_WN.linear() * Vec3(r.direction[0], r.direction[1], r.direction[2])).stableNormalized();
  for (int k = 0; k < 3; ++k) {
    r.position[k] = p[k];
    r.direction[k] = d[k];
  }
  return r;
}

void Lights::publish(const Vec3& p_WH, ChangeSet& changes) {
  findWanted();
  choose(p_WH);
  const bool tooMany = wanted_.size() > kMostLights;
  const bool same = tooMany && chosen_ == shining_;
  shining_.clear();
  if (tooMany) shining_ = chosen_;
  if (same && !changed_) return;
  changed_ = false;
  changes.lightsChanged = true;
  const bool anyLight = std::any_of(lights_.begin(), lights_.end(), [](const Light& l) { return l.live; });
  if (!anyLight) changes.lights.push_back(afternoonSun());
  for (const std::size_t h : chosen_) changes.lights.push_back(inWorld(lights_[h]));
}

void Lights::warnOfTooMany() {
  if (warned_) return;
  warned_ = true;
  constexpr std::size_t kMostNames = 5;
  SourcePosition where;
  std::string names;
  std::size_t dark = 0;
  for (const std::size_t h : wanted_) {
    if (std::binary_search(chosen_.begin(), chosen_.end(), h)) continue;
    const NodeRef node = lights_[h].node;
    const LoadedScene* from = tree_.load(node.load);
    const std::uint32_t line =
        from && node.position < from->lines.size() ? from->lines[node.position] : std::uint32_t{0};
    if (dark == 0 && from) where = {from->file, line, line > 0 ? 1u : 0u};
    if (dark++ >= kMostNames) continue;
    const Node* light = from ? from->nodes[node.position].get() : nullptr;
    names += names.empty() ? "" : ", ";
    names += light && !light->name().empty() ? "\"" + light->name() + "\"" : "line " + std::to_string(line);
  }
  if (dark > kMostNames) names += " and " + std::to_string(dark - kMostNames) + " more";
  loader_.report({Severity::Warning,
                  where,
                  std::to_string(wanted_.size()) + " lights are on, of which the " +
                      std::to_string(kMostLights) +
                      " brightest where the visitor is shine; dark at the moment: " + names,
                  {}});
}

void Lights::stateOfLights(StateFields& f) {
  f("lights", lights_), f("lights at", at_), f("shining", shining_), f("told of lights", warned_);
}

void Lights::stateOfSkies(StateFields& f) {
  f("skies", skies_), f("environments", environments_), f("tones", tones_);
}

bool Lights::consistent() const {
  for (const Light& l : lights_)
    if (l.live && (!placements_.has(l.placement) || l.placement >= at_.size())) return false;
  return std::ranges::all_of(shining_, [&](std::size_t h) { return h < lights_.size(); });
}

}  // namespace stadion
