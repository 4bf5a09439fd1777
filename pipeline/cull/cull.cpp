#include "pipeline/cull/cull.h"

#include "engine/maths/angles.h"
#include "pipeline/cull/eye_test.h"
#include "pipeline/cull/shadow_cull.h"
#include "pipeline/draw_list/list_filling.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

/// How large things are seen on a wall.
struct PixelScale {
  float ofSteradian = 0, most = 0;  ///< pixels: of a steradian in the picture's middle, of the picture

  PixelScale(const DrawList& list, const WallViews& wall) {
    const auto width = static_cast<float>(wall.width), height = static_cast<float>(wall.height);
    const Mat4& p = list.views[0].projection;
    ofSteradian = 0.25f * static_cast<float>(p(0, 0) * p(1, 1)) * width * height;
    most = width * height;
  }
  float of(float radius, float distance) const {
    return distance > radius ? std::min(most, static_cast<float>(kPi) * ofSteradian * radius * radius /
                                                  (distance * distance))
                             : most;
  }
};

std::array<float, 3> centreOf(const InstanceRecord& r, const Vec3& origin) {
  return {static_cast<float>(r.centre[0] - origin[0]), static_cast<float>(r.centre[1] - origin[1]),
          static_cast<float>(r.centre[2] - origin[2])};
}

DrawItem itemOf(const DrawnRecord& drawn, const Vec3& origin, const PixelScale& scale) {
  const InstanceRecord& r = *drawn.record;
  DrawItem item;
  for (int row = 0; row < 3; ++row) {
    for (int k = 4 * row; k < 4 * row + 3; ++k)
      item.model[static_cast<std::size_t>(k)] = static_cast<float>(r.model[k]);
    item.model[static_cast<std::size_t>(4 * row + 3)] =
        static_cast<float>(r.model[4 * row + 3] - origin[row]);
  }
  item.mesh = drawn.mesh;
  item.owner = r.owner;
  item.distance = drawn.distance;
  item.pixels = scale.of(r.radius, drawn.distance);
  item.level = drawn.level;
  item.figure = r.figure();
  item.paint = r.paint();
  item.views = drawn.views;
  return item;
}

/// A record lies anywhere among many: it is asked for while others are worked on.
constexpr std::size_t kAhead = 8;
void fetch(const InstanceRecord* r) {
  const auto* at = reinterpret_cast<const char*>(r);
  for (std::size_t line = 0; line < sizeof *r; line += 64) __builtin_prefetch(at + line);
}

void setLights(const SlotView& state, DrawList& out) {
  out.lights.clear();
  for (const LightRecord& l : state.lights) {
    if (out.lights.size() == DrawList::kMaxLights) break;
    DrawLight d;
    d.kind = static_cast<DrawLight::Kind>(l.kind);
    for (std::size_t k = 0; k < 3; ++k) {
      d.position[k] = static_cast<float>(l.position[k] - out.origin[static_cast<int>(k)]);
      d.direction[k] = static_cast<float>(l.direction[k]);
      d.colour[k] = l.colour[k];
    }
    d.range = l.range;
    d.cosInner = l.cosInner;
    d.cosOuter = l.cosOuter;
    d.fallsOff = l.fallsOff;
    d.shadows = d.kind == DrawLight::Kind::Directional && l.range > 0;
    out.lights.push_back(d);
  }
}

/// In front of a sky without light and without a sun.
void makeBlack(DrawList& out) {
  out.lights.clear();
  out.sky = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, 0, {}, {}};
}

void setSky(const SkyRecord& sky, DrawList& out) {
  const auto copy = [](const float(&from)[3], std::array<float, 3>& to) {
    std::copy(from, from + 3, to.begin());
  };
  copy(sky.zenith, out.sky.zenith);
  copy(sky.horizon, out.sky.horizon);
  copy(sky.ground, out.sky.ground);
  copy(sky.ambient, out.sky.ambient);
  out.sky.hazeDistance = sky.haze;
  out.sky.environment = sky.environment;
  out.sky.tones = sky.tones;
}

/// Bits of the views whose pictures are for that eye.
std::uint32_t viewsFor(Eye eye, const DrawList& list) {
  std::uint32_t mask = 0;
  for (std::uint32_t v = 0; v < list.viewCount; ++v)
    if (list.views[v].eye == eye) mask |= 1U << v;
  return mask;
}

/// The light finds its rings and what stands still in them, kept from frame to frame; what moves is looked
/// for.
void addOwners(const SlotView& state, const DrawShadows& shadows, std::vector<NodeRef>& owners) {
  if (shadows.light >= 0)
    if (const NodeRef owner = state.lights[static_cast<std::size_t>(shadows.light)].owner; owner.valid())
      owners.push_back(owner);
  for (const DrawShadowRing& ring : shadows.rings)
    for (const DrawItem& item : ring.moving) owners.push_back(item.owner);
}

}  // namespace

WallCull::WallCull(const CullParts& parts, std::uint32_t wall) : parts_(parts), wall_(wall) {
  if (parts.meshes) levels_.emplace(parts.pixels, *parts.meshes);
}

void WallCull::fill(const SlotView& state, const CullOptions& options, DrawList& out) {
  FrameProbe* probe = parts_.probe;
  out.wall = wall_;
  out.shadows.light = -1;
  opaque_.clear();
  transparent_.clear();
  added_.clear();
  const RoomCull::Visibility room = [&] {
    const SpanScope span(probe, Span::Test);
    return parts_.room.visibleIn(state, options.eyes);
  }();
  const VisibleSet& seen = room.on(wall_);
  if (!seen.looks) {
    out.opaque.clear();
    out.transparent.clear();
    out.viewCount = 0;
    return;
  }
  {
    const SpanScope span(probe, Span::Eyes);
    lookThrough(state, seen, out);
  }
  if (options.black) {
    makeBlack(out);
  } else {
    const SpanScope span(probe, Span::Fill);
    choose(state, seen, out);
  }
  if (parts_.still && !options.black) {
    const SpanScope span(probe, Span::ShadowCasts);
    addCasters(state, out);
  }
  {
    const SpanScope span(probe, Span::Sort);
    order_.sortOpaque(opaque_);
    order_.sortTransparent(transparent_);
  }
  {
    const SpanScope span(probe, Span::Fill);
    write(out);
  }
  if (probe) reportCounts(state, seen, options.eyes, out);
}

void WallCull::lookThrough(const SlotView& state, const VisibleSet& seen, DrawList& out) const {
  out.viewer = *state.viewer;
  seen.placed.setUp(out);
  setLights(state, out);
  out.figures.assign(state.figures.begin(), state.figures.end());
  out.paints.assign(state.paints.begin(), state.paints.end());
  setSky(*state.sky, out);
}

/// What is drawn of the records that may be seen, by which views, at which level.
void WallCull::choose(const SlotView& state, const VisibleSet& seen, const DrawList& out) {
  if (levels_) levels_->setViewer(*state.viewer);
  const WallViews& wall = parts_.room.wall(wall_);
  const bool eyesMove = wall.reach.metres > 0 || wall.reach.radians > 0;  // before they draw
  const std::uint32_t all = (1U << out.viewCount) - 1;
  const EyeTest eyes(out, parts_.oneSample, wall.width, wall.height);
  const auto consider = [&](const InstanceRecord& r) {
    const auto centre = centreOf(r, out.origin);
    const std::uint32_t seenBy = eyesMove ? all : eyes.viewsThatSee(centre, r.radius);
    if (seenBy == 0) return;
    const float distance = std::sqrt(centre[0] * centre[0] + centre[1] * centre[1] + centre[2] * centre[2]);
    auto& things = r.flags & InstanceRecord::kTransparent ? transparent_ : opaque_;
    things.push_back({&r, r.mesh, distance, r.lodFactor != 0 && levels_ ? levels_->levelOf(r) : 0, seenBy});
  };
  const std::span<const InstanceRecord* const> records = seen.records;
  for (std::size_t i = 0; i < std::min(kAhead, records.size()); ++i) fetch(records[i]);
  for (std::size_t i = 0; i < records.size(); ++i) {
    if (i + kAhead < records.size()) fetch(records[i + kAhead]);
    consider(*records[i]);
  }
  if (seen.from) wall.camera->addTo(added_, *state.viewer);
  for (const InstanceRecord& r : added_) consider(r);
}

/// The items, in their order. Draw may begin with the first of them.
void WallCull::write(DrawList& out) const {
  const PixelScale scale(out, parts_.room.wall(wall_));
  const auto writeSome = [&](std::span<const DrawnRecord> things, DrawItem* items) {
    for (std::size_t i = 0; i < things.size(); ++i) {
      if (i + kAhead < things.size()) fetch(things[i + kAhead].record);
      items[i] = itemOf(things[i], out.origin, scale);
    }
  };
  out.opaque.resize(opaque_.size());
  out.transparent.resize(transparent_.size());
  if (out.filling) out.filling->begin();
  for (std::size_t from = 0; from < opaque_.size(); from += DrawList::kPortion) {
    const std::size_t count = std::min(DrawList::kPortion, opaque_.size() - from);
    writeSome(std::span(opaque_).subspan(from, count), out.opaque.data() + from);
    if (out.filling) out.filling->reach(from + count);
  }
  writeSome(transparent_, out.transparent.data());
}

void WallCull::addCasters(const SlotView& state, DrawList& out) const {
  ShadowCull shadows(state, *parts_.still, out);
  if (!shadows.any()) return;
  for (const InstanceRecord& r : state.instances) shadows.consider(r);
}

/// Reports the counts, and the nodes that the work was for.
void WallCull::reportCounts(const SlotView& state, const VisibleSet& seen, const EyeChoice& choice,
                            const DrawList& out) const {
  FrameProbe& probe = *parts_.probe;
  std::size_t casters = 0;
  if (out.shadows.light >= 0)
    for (const DrawShadowRing& ring : out.shadows.rings) casters += ring.moving.size();
  probe.counted(Count::Tested, seen.tested);
  probe.counted(Count::Seen, out.opaque.size() + out.transparent.size());
  probe.counted(Count::Casters, casters);

  const std::uint64_t frame = state.signature->frame;
  if (!probe.wantsShares(frame, wall_)) return;
  std::vector<NodeRef> owners;
  parts_.room.reached(state, choice, wall_, owners);
  probe.shared(Span::Test, frame, wall_, owners);
  owners.clear();
  for (const auto* items : {&out.opaque, &out.transparent})
    for (const DrawItem& item : *items) owners.push_back(item.owner);
  probe.shared(Span::Fill, frame, wall_, owners);
  probe.shared(Span::Sort, frame, wall_, owners);
  for (const Eye eye : kEyes) {
    const std::uint32_t mask = viewsFor(eye, out);
    owners.clear();
    for (const auto* items : {&out.opaque, &out.transparent})
      for (const DrawItem& item : *items)
        if (item.views & mask) owners.push_back(item.owner);
    probe.shared(eye == Eye::Left ? Span::LeftEye : Span::RightEye, frame, wall_, owners);
  }
  if (!parts_.still) return;
  owners.clear();
  addOwners(state, out.shadows, owners);
  probe.shared(Span::ShadowCasts, frame, wall_, owners);
}

}  // namespace stadion
