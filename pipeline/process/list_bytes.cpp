#include "pipeline/process/list_bytes.h"

#include "engine/base/value_reader.h"

#include <algorithm>
#include <cstring>
#include <type_traits>

namespace stadion::wall_process {
namespace {

struct RingHead {
  std::array<float, 3> offset;
  std::array<float, 4> movingArea;
  std::uint64_t stillKey, movingKey, moving, still;
  std::uint32_t stillIsNew;
};

struct Head {
  std::uint64_t frame;
  std::uint32_t wall, viewCount;
  double origin[3];
  Eye eye[DrawList::kMostViews];
  double view[DrawList::kMostViews][16], projection[DrawList::kMostViews][16];
  DrawSky sky;
  std::int32_t shadowLight;
  std::array<float, 9> shadowAxes;
  std::array<RingHead, kShadowRings> rings;
  std::uint64_t lights, figures, paints, opaque, transparent, meshes, gone;
};
static_assert(std::is_trivially_copyable_v<Head> && std::is_trivially_copyable_v<DrawItem> &&
              std::is_trivially_copyable_v<DrawLight> && std::is_trivially_copyable_v<SharedMeshPlace>);

template <class T>
std::size_t bytesOf(const std::vector<T>& values) {
  return values.size() * sizeof(T);
}

Head headOf(const DrawList& list, const ListNews& news) {
  Head h{};
  h.frame = list.ticket.signature.frame;
  h.wall = list.wall;
  h.viewCount = list.viewCount;
  std::copy_n(list.origin.data(), 3, h.origin);
  for (std::size_t v = 0; v < list.views.size(); ++v) {
    std::copy_n(list.views[v].view.data(), 16, h.view[v]);
    std::copy_n(list.views[v].projection.data(), 16, h.projection[v]);
    h.eye[v] = list.views[v].eye;
  }
  h.sky = list.sky;
  h.shadowLight = list.shadows.light;
  h.shadowAxes = list.shadows.axes;
  h.lights = list.lights.size();
  h.figures = list.figures.size();
  h.paints = list.paints.size();
  h.opaque = list.opaque.size();
  h.transparent = list.transparent.size();
  h.meshes = news.meshes.size();
  h.gone = news.gone.size();
  return h;
}

RingHead headOf(const DrawShadowRing& ring, bool stillIsNew) {
  RingHead h{};
  h.offset = ring.offset;
  h.movingArea = ring.movingArea;
  h.stillKey = ring.stillKey;
  h.movingKey = ring.movingKey;
  h.moving = ring.moving.size();
  h.still = stillIsNew && ring.still ? ring.still->size() : 0;
  h.stillIsNew = stillIsNew;
  return h;
}

class Writer {
public:
  explicit Writer(SharedSegment& to) : to_(to) {}
  template <class T>
  void put(const std::vector<T>& values) {
    if (values.empty()) return;
    to_.growTo(at_ + bytesOf(values));
    std::memcpy(to_.data() + at_, values.data(), bytesOf(values));
    at_ += bytesOf(values);
  }
  void put(const Head& head) {
    to_.growTo(at_ + sizeof head);
    std::memcpy(to_.data() + at_, &head, sizeof head);
    at_ += sizeof head;
  }
  std::size_t bytes() const { return at_; }

private:
  SharedSegment& to_;
  std::size_t at_ = 0;
};

void fill(DrawList& list, const Head& h) {
  list.ticket.signature.frame = h.frame;
  list.wall = h.wall;
  list.viewCount = h.viewCount;
  std::copy_n(h.origin, 3, list.origin.data());
  for (std::size_t v = 0; v < list.views.size(); ++v) {
    std::copy_n(h.view[v], 16, list.views[v].view.data());
    std::copy_n(h.projection[v], 16, list.views[v].projection.data());
    list.views[v].eye = h.eye[v];
  }
  list.sky = h.sky;
  list.shadows.light = h.shadowLight;
  list.shadows.axes = h.shadowAxes;
}

bool readRing(ValueReader& in, const RingHead& h, DrawShadowRing& ring) {
  ring.offset = h.offset;
  ring.movingArea = h.movingArea;
  ring.stillKey = h.stillKey;
  ring.movingKey = h.movingKey;
  if (!in.get(ring.moving, h.moving)) return false;
  if (!h.stillIsNew) return true;
  auto still = std::make_shared<std::vector<DrawItem>>();
  if (!in.get(*still, h.still)) return false;
  ring.still = std::move(still);
  return true;
}

}  // namespace

std::size_t write(const DrawList& list, const ListNews& news, StillKeys& known, SharedSegment& to) {
  Head head = headOf(list, news);
  const bool shadows = list.shadows.light >= 0;
  for (std::size_t i = 0; i < kShadowRings; ++i) {
    const DrawShadowRing& ring = list.shadows.rings[i];
    const bool stillIsNew = shadows && known[i] != ring.stillKey;
    head.rings[i] = headOf(ring, stillIsNew);
    if (!shadows) head.rings[i].moving = 0;
    if (stillIsNew) known[i] = ring.stillKey;
  }
  Writer out(to);
  out.put(head);
  out.put(list.lights);
  out.put(list.figures);
  out.put(list.paints);
  out.put(list.opaque);
  out.put(list.transparent);
  for (std::size_t i = 0; shadows && i < kShadowRings; ++i) {
    const DrawShadowRing& ring = list.shadows.rings[i];
    out.put(ring.moving);
    if (head.rings[i].still > 0) out.put(*ring.still);
  }
  out.put(news.meshes);
  out.put(news.gone);
  return out.bytes();
}

bool read(std::span<const std::byte> bytes, DrawList& list, ListNews& news) {
  ValueReader in(bytes);
  Head head;
  if (!in.get(head) || head.viewCount > list.views.size()) return false;
  fill(list, head);
  if (!in.get(list.lights, head.lights) || !in.get(list.figures, head.figures) ||
      !in.get(list.paints, head.paints) || !in.get(list.opaque, head.opaque) ||
      !in.get(list.transparent, head.transparent))
    return false;
  for (std::size_t i = 0; i < kShadowRings; ++i)
    if (!readRing(in, head.rings[i], list.shadows.rings[i])) return false;
  return in.get(news.meshes, head.meshes) && in.get(news.gone, head.gone) && in.atEnd();
}

}  // namespace stadion::wall_process
