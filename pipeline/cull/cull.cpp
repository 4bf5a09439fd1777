#include "pipeline/cull/cull.h"

#include "pipeline/cull/shadow_cull.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace stadion {
namespace {

/// What a camera that is nobody's eye can see (World axes relative to the list's origin).
ConvexVolume setCamera(const ViewerRecord& viewer, const CameraView& from, const DepthRange& depth,
                       DrawList& out) {
  const Pose X_WR = viewer.rig();
  out.origin = X_WR * from.eye;
  out.eyeCount = 1;
  const EyeFrustum frustum = eyeFrustum(from.screen, from.eye, depth);
  out.eyes[0].projection = projectionMatrix(frustum);
  out.eyes[0].view = viewMatrix(frustum, X_WR, out.origin);
  return unionFrustum(from.screen, {&from.eye, 1}, depth).transformed(X_WR, out.origin);
}

/// The cameras of the wall's eyes, and what they can see together (World axes relative to the list's origin).
ConvexVolume setEyes(const ViewerRecord& viewer, const WallView& view, DrawList& out) {
  const Pose X_WR = viewer.rig(), X_RH = viewer.head();
  out.origin = X_WR * X_RH.p;
  out.eyeCount = view.stereo ? 2 : 1;
  std::array<Vec3, 2> eyes;
  for (std::uint32_t e = 0; e < out.eyeCount; ++e) {
    eyes[e] = eyePosition(X_RH, kEyes[e], view.stereo ? view.eyeSeparation : 0);
    const EyeFrustum frustum = eyeFrustum(view.wall, eyes[e], view.depth);
    out.eyes[e].projection = projectionMatrix(frustum);
    out.eyes[e].view = viewMatrix(frustum, X_WR, out.origin);
  }
  return unionFrustum(view.wall, {eyes.data(), out.eyeCount}, view.depth).transformed(X_WR, out.origin);
}

/// What is in the slot, one record after the other.
template <class F>
void forEachRecord(const SlotView& state, const F& f) {
  for (const ChunkId id : state.chunks) {
    const ChunkView chunk = state.chunk(id);
    for (std::size_t i = 0; i < chunk.records.size(); ++i)
      if (!((chunk.hidden[i / 64] >> (i % 64)) & 1)) f(chunk.records[i]);
  }
  for (const InstanceRecord& r : state.instances) f(r);
}

bool isShown(const InstanceRecord& r) {
  return r.radius >= 0 && (r.flags & InstanceRecord::kShown) != 0;
}

Vec3 centreOf(const InstanceRecord& r, const DrawList& list) {
  return Vec3(r.centre[0], r.centre[1], r.centre[2]) - list.origin;
}

CullCounts findSeen(const SlotView& state, const ConvexVolume& volume, DrawList& out) {
  CullCounts counts;
  out.seen.clear();
  forEachRecord(state, [&](const InstanceRecord& r) {
    if (!isShown(r)) return;
    ++counts.tested;
    if (volume.mayTouch(Sphere{centreOf(r, out), r.radius})) out.seen.push_back(&r);
  });
  counts.kept = out.seen.size();
  return counts;
}

/// How large things are seen on a wall.
struct PixelScale {
  float ofSteradian = 0, most = 0;  ///< pixels: of a steradian in the picture's middle, of the picture

  PixelScale(const DrawList& list, const WallView& view) {
    const auto width = static_cast<float>(view.width), height = static_cast<float>(view.height);
    const Mat4& p = list.eyes[0].projection;
    ofSteradian = 0.25f * static_cast<float>(p(0, 0) * p(1, 1)) * width * height;
    most = width * height;
  }
  float of(float radius, float distance) const {
    constexpr float kPi = 3.14159265f;
    return distance > radius ? std::min(most, kPi * ofSteradian * radius * radius / (distance * distance))
                             : most;
  }
};

DrawItem itemOf(const InstanceRecord& r, const DrawList& list, const PixelScale& scale) {
  DrawItem item;
  for (int k = 0; k < 12; ++k) {
    const double shift = k % 4 == 3 ? list.origin[k / 4] : 0.0;
    item.model[static_cast<std::size_t>(k)] = static_cast<float>(r.model[k] - shift);
  }
  item.mesh = r.mesh;
  item.owner = r.owner;
  item.distance = static_cast<float>(centreOf(r, list).norm());
  item.pixels = scale.of(r.radius, item.distance);
  return item;
}

void fill(DrawList& out, const PixelScale& scale, LevelChoice* levels) {
  for (const InstanceRecord* r : out.seen) {
    auto& items = r->flags & InstanceRecord::kTransparent ? out.transparent : out.opaque;
    items.push_back(itemOf(*r, out, scale));
    if (levels) items.back().level = levels->levelOf(*r);
  }
}

/// The order must not depend on where records lie, only on what they are.
void sort(DrawList& out) {
  const auto key = [](const DrawItem& d) {
    return std::tuple(d.mesh, d.level, d.distance, d.owner, d.model);
  };
  std::sort(out.opaque.begin(), out.opaque.end(),
            [&](const DrawItem& a, const DrawItem& b) { return key(a) < key(b); });
  std::sort(out.transparent.begin(), out.transparent.end(), [](const DrawItem& a, const DrawItem& b) {
    return std::tuple(-a.distance, a.mesh, a.owner, a.model) <
           std::tuple(-b.distance, b.mesh, b.owner, b.model);
  });
}

/// Who the tests and the filling were for.
void tellShares(const SlotView& state, const DrawList& list, FrameProbe& probe) {
  const std::uint64_t frame = state.signature->frame;
  std::vector<NodeRef> owners;
  forEachRecord(state, [&](const InstanceRecord& r) {
    if (isShown(r)) owners.push_back(r.owner);
  });
  probe.shared(Span::Test, frame, list.wall, owners);
  owners.clear();
  for (const InstanceRecord* r : list.seen) owners.push_back(r->owner);
  probe.shared(Span::Fill, frame, list.wall, owners);
  probe.shared(Span::Sort, frame, list.wall, owners);
  owners.clear();
  // The light finds its rings and what stands still in them, kept from frame to frame; what moves is looked
  // for.
  if (const std::int32_t light = list.shadows.light; light >= 0)
    if (const NodeRef owner = state.lights[static_cast<std::size_t>(light)].owner; owner.valid())
      owners.push_back(owner);
  for (const DrawShadowRing& ring : list.shadows.rings)
    for (const DrawItem& item : ring.moving) owners.push_back(item.owner);
  probe.shared(Span::ShadowCasts, frame, list.wall, owners);
}

/// Within the stage itself.
void tellCounts(const CullCounts& counts, const DrawList& list, FrameProbe& probe) {
  std::size_t casters = 0;
  for (const DrawShadowRing& ring : list.shadows.rings) casters += ring.moving.size();
  probe.counted(Count::Tested, counts.tested);
  probe.counted(Count::Seen, counts.kept);
  probe.counted(Count::Casters, casters);
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
    d.range = l.range, d.cosInner = l.cosInner, d.cosOuter = l.cosOuter;
    d.shadows = d.kind == DrawLight::Kind::Directional && l.range > 0;
    out.lights.push_back(d);
  }
}

void setSky(const SkyRecord& sky, DrawList& out) {
  const auto copy = [](const float(&from)[3], std::array<float, 3>& to) {
    std::copy(from, from + 3, to.begin());
  };
  copy(sky.zenith, out.sky.zenith), copy(sky.horizon, out.sky.horizon);
  copy(sky.ground, out.sky.ground), copy(sky.ambient, out.sky.ambient);
  out.sky.hazeDistance = sky.haze;
}

}  // namespace

CullCounts cullWall(const SlotView& state, const WallView& view, std::uint32_t index, StillCasters& still,
                    DrawList& out, FrameProbe* probe, LevelChoice* levels) {
  out.ticket.signature = *state.signature;
  out.wall = index;
  out.opaque.clear(), out.transparent.clear();
  const auto from = view.camera ? view.camera->view() : std::nullopt;
  if (view.camera && !from) {
    out.eyeCount = 0, out.shadows.light = -1;
    return {};
  }
  const ConvexVolume volume = [&] {
    const SpanScope span(probe, Span::Eyes);
    const ConvexVolume visible =
        from ? setCamera(*state.viewer, *from, view.depth, out) : setEyes(*state.viewer, view, out);
    setLights(state, out);
    setSky(*state.sky, out);
    return visible;
  }();
  CullCounts counts;
  {
    const SpanScope span(probe, Span::Test);
    counts = findSeen(state, volume, out);
  }
  {
    const SpanScope span(probe, Span::Fill);
    fill(out, PixelScale(out, view), levels);
  }
  {
    const SpanScope span(probe, Span::ShadowCasts);
    ShadowCull shadows(state, still, out);
    if (shadows.any())
      for (const InstanceRecord& r : state.instances) shadows.consider(r);
  }
  if (from) view.camera->addTo(out, *state.viewer);
  {
    const SpanScope span(probe, Span::Sort);
    sort(out);
  }
  if (probe) tellCounts(counts, out, *probe);
  if (probe && probe->wantsShares(state.signature->frame, index)) tellShares(state, out, *probe);
  return counts;
}

}  // namespace stadion
