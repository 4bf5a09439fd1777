#include "pipeline/cpu_draw/cpu_renderer.h"

#include "engine/base/run_stopped.h"
#include "pipeline/cpu_draw/kernels/choose_kernels.h"
#include "pipeline/cpu_draw/mesh/cpu_material.h"
#include "pipeline/draw_list/list_filling.h"
#include "pipeline/gl/picture_size.h"
#include "pipeline/gl/problem.h"
#include "pipeline/shader/uniform_blocks.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace stadion {
namespace {

void stopIf(const std::function<bool()>& giveUp) {
  if (giveUp && giveUp()) throw RunStopped();
}

/// Waits until Cull has filled the list; false: it is void.
bool isFilled(const DrawList& list, FrameProbe* probe) {
  if (!list.filling) return true;
  const SpanScope span(probe, Span::ForDraw, list.ticket.signature.frame, list.wall);
  return list.filling->isWhole();
}

/// The rays of a view block go through the corners (-1,-1), (3,-1) and (-1,3) of clip space.
ViewParameters viewParameters(const ViewBlock& block, std::uint32_t width, std::uint32_t height) {
  ViewParameters to{};
  for (std::size_t k = 0; k < 3; ++k) {
    to.eye[k] = block.eye[k];
    to.ray[k] = block.rays[0][k];
    to.rayX[k] = (block.rays[1][k] - block.rays[0][k]) / (2 * static_cast<float>(width));
    to.rayY[k] = (block.rays[2][k] - block.rays[0][k]) / (2 * static_cast<float>(height));
  }
  return to;
}

}  // namespace

CpuRoom::CpuRoom(const MeshStore& store, Look look, DrawPool& pool, const DrawKernels& kernels)
    : kernels_(kernels), pool_(pool), meshes_(store, look), paints_(look), shadows_(kernels),
      environments_(store) {}

CpuRoom::CpuRoom(const MeshStore& store, Look look, DrawPool& pool)
    : CpuRoom(store, look, pool, bestDrawKernels()) {}

Result<std::unique_ptr<CpuRenderer>> CpuRenderer::create(CpuRoom& room, std::uint32_t width,
                                                         std::uint32_t height, PictureRung rung) {
  if (auto why = checkPictureSize(width, height)) return *why;
  return std::unique_ptr<CpuRenderer>(new CpuRenderer(room, width, height, rung));
}

CpuRenderer::CpuRenderer(CpuRoom& room, std::uint32_t width, std::uint32_t height, PictureRung rung)
    : room_(room), width_(width), height_(height), rung_(rung),
      costs_(room.meshes(), room.poses(), room.paints(), room.bands(), room.kernels()) {}

std::string CpuRenderer::description() const {
  return std::string("CPU renderer, ") + room_.kernels().name;
}

std::optional<Diagnostic> CpuRenderer::draw(const DrawList& list, const std::function<bool()>& giveUp,
                                            FrameProbe* probe) {
  if (isFilled(list, probe)) drawWhole(list, giveUp, probe);
  if (auto why = room_.meshes().takeProblem()) report(why->message);
  return std::exchange(problem_, std::nullopt);
}

void CpuRenderer::drawWhole(const DrawList& list, const std::function<bool()>& giveUp, FrameProbe* probe) {
  stopIf(giveUp);
  drawing_ = rung_.under(list.viewer.stress);
  if (list.lights.size() > DrawList::kMaxLights)
    report("more than " + std::to_string(DrawList::kMaxLights) + " lights: the rest are left out");
  {
    const SpanScope span(probe, Span::Prepare);
    room_.meshes().freeUnused();
    room_.poses().begin(list.ticket.signature.frame);
    room_.paints().begin(list.ticket.signature.frame);
    prepare(list, giveUp);
  }
  const bool shadowed = list.shadows.light >= 0 && drawing_.look == Look::Full;
  std::shared_ptr<const ShadowSet> shadows;
  if (shadowed) {
    const SpanScope span(probe, Span::ShadowMaps);
    shadows = room_.shadows().find(list.shadows, meshesOf(list), room_.pool());
  }
  stopIf(giveUp);
  const auto surroundings = room_.environments().find(list.sky);
  SceneParameters scene = sceneParameters(fillScene(list.sky, list.lights, drawing_.look,
                                                    shadowed ? list.shadows.light : -1, surroundings.get()));
  EnvironmentParameters environment{};
  if (surroundings && drawing_.look == Look::Full) {
    environment = environmentParameters(list.sky.environment, *surroundings, drawing_.reflections);
    scene.environment = &environment;
  }
  const ShadowParameters shadow =
      shadows ? shadows->parameters(list.shadows, drawing_.shadowTaps) : ShadowParameters{};
  {
    // Bands of both eyes are drawn side by side, so their time is reported as one.
    const SpanScope span(probe, Span::LeftEye);
    drawBands(scene, shadows ? &shadow : nullptr, giveUp);
    count(list, Eye::Left, probe);
  }
  if (std::ranges::any_of(std::span(list.views).first(views_),
                          [](const DrawView& v) { return v.eye == Eye::Right; })) {
    const SpanScope span(probe, Span::RightEye);
    count(list, Eye::Right, probe);
  }
  if (probe) sample(list, scene, shadows ? &shadow : nullptr, *probe);
}

/// Times what the probe wants to know, by drawing it once more.
void CpuRenderer::sample(const DrawList& list, const SceneParameters& scene, const ShadowParameters* shadow,
                         FrameProbe& probe) {
  const DrawSample how = probe.drawSample(list.ticket.signature.frame, list.wall);
  if (how == DrawSample::None) return costs_.reportLargest(list, probe);
  for (std::uint32_t view = 0; view < views_; ++view) {
    Picture& p = pictures_[view];
    if (!p.drawn) continue;
    const PieceCosts::View drawn{
        list, view, {&room_.kernels(), &p.setup, &scene, shadow, &p.view, drawing_, p.rgba}};
    how == DrawSample::Whole ? costs_.sampleWhole(drawn, probe) : costs_.sampleSome(drawn, probe);
  }
}

void CpuRenderer::prepare(const DrawList& list, const std::function<bool()>& giveUp) {
  views_ = std::min<std::size_t>(list.viewCount, DrawList::kMostViews);
  const std::size_t bytes = std::size_t{width_} * height_ * 4;
  while (pictures_.size() < views_) pictures_.emplace_back(room_.kernels(), bytes);
  poseFigures(list);
  room_.pool().run(views_, [&](std::size_t view) { begin(list, static_cast<std::uint32_t>(view)); });
  for (std::size_t view = 0; view < views_; ++view) {
    if (!pictures_[view].drawn)
      report(
          "a view's matrices are not finite, have no inverse or are no projection: its picture is not drawn");
    if (pictures_[view].refused > 0) report("an object is left out: its matrix is not finite");
  }
  stopIf(giveUp);
  forAll([](const Picture& p) { return p.setup.placePieces(); },
         [](Picture& p, std::size_t i) { p.setup.place(i); }, giveUp);
  forAll([](const Picture& p) { return p.setup.setUpPieces(); },
         [](Picture& p, std::size_t i) { p.setup.setUp(i); }, giveUp);
  stopIf(giveUp);
}

/// Each on a thread of its own. A view that begins finds them.
void CpuRenderer::poseFigures(const DrawList& list) {
  std::vector<const DrawItem*> figures;
  for (const auto* items : {&list.opaque, &list.transparent})
    for (const DrawItem& item : *items)
      if (item.figure != 0) figures.push_back(&item);
  const ListMeshes meshes = meshesOf(list);
  room_.pool().run(figures.size(), [&](std::size_t i) { meshes.find(*figures[i]); });
}

void CpuRenderer::begin(const DrawList& list, std::uint32_t view) {
  Picture& picture = pictures_[view];
  const DrawView& from = list.views[view];
  ViewBlock block;
  const auto geometry = ViewGeometry::of(from.projection, from.view, width_, height_);
  picture.drawn = geometry && fillView(from, ClipDepth::ZeroToOne, block);
  picture.refused = 0;
  if (!picture.drawn) return;
  picture.view = viewParameters(block, width_, height_);
  picture.setup.begin(*geometry, drawing_.samples);
  MeshId last = kNoMesh;
  std::shared_ptr<const CpuMesh> mesh;
  const ListMeshes meshes = meshesOf(list);
  const auto addAll = [&](const std::vector<DrawItem>& items, Transparency which) {
    for (const DrawItem& item : items) {
      if (!(item.views >> view & 1)) continue;
      if (item.mesh != last || item.figure != 0 || !mesh) mesh = meshes.find(item);
      last = item.figure != 0 ? kNoMesh : item.mesh;
      const auto paint = item.paint != 0 ? meshes.paintOf(item) : nullptr;
      if (mesh && !picture.setup.add(mesh, item.level, item.model, which, paint)) ++picture.refused;
    }
  };
  addAll(list.opaque, Transparency::Opaque);
  addAll(list.transparent, Transparency::Opaque);
  addAll(list.transparent, Transparency::Transparent);
  picture.setup.divide();
}

void CpuRenderer::drawBands(const SceneParameters& scene, const ShadowParameters* shadow,
                            const std::function<bool()>& giveUp) {
  forAll([](const Picture& p) { return p.setup.bands(); },
         [&](Picture& p, std::size_t band) {
           room_.bands().draw({&room_.kernels(), &p.setup, &scene, shadow, &p.view, drawing_, p.rgba}, band);
         },
         giveUp);
}

void CpuRenderer::forAll(std::size_t (*pieces)(const Picture&),
                         const std::function<void(Picture&, std::size_t)>& work,
                         const std::function<bool()>& giveUp) {
  std::vector<std::pair<Picture*, std::size_t>> all;
  for (std::size_t view = 0; view < views_; ++view) {
    Picture& picture = pictures_[view];
    if (!picture.drawn) continue;
    for (std::size_t i = 0, count = pieces(picture); i < count; ++i) all.emplace_back(&picture, i);
  }
  room_.pool().run(all.size(), [&](std::size_t i) {
    stopIf(giveUp);
    work(*all[i].first, all[i].second);
  });
}

void CpuRenderer::count(const DrawList& list, Eye eye, FrameProbe* probe) {
  for (std::size_t view = 0; view < views_; ++view) {
    Picture& picture = pictures_[view];
    if (!picture.drawn || list.views[view].eye != eye) continue;
    picture.counts = {picture.setup.partsAdded(), picture.setup.partsAdded(), picture.setup.trianglesAdded()};
    totals_[view].add(picture.counts);
    if (!probe) continue;
    probe->counted(Count::Calls, picture.counts.calls),
        probe->counted(Count::Instances, picture.counts.instances);
    probe->counted(Count::Triangles, picture.counts.triangles);
    probe->counted(Count::Pixels, std::uint64_t{width_} * height_);
  }
}

std::optional<Diagnostic> CpuRenderer::read(std::uint32_t view, std::span<std::uint8_t> rgba) {
  assert(view < pictures_.size() && rgba.size() == pictures_[view].rgba.size());
  std::ranges::copy(pictures_[view].rgba, rgba.begin());
  return std::exchange(problem_, std::nullopt);
}

void CpuRenderer::report(std::string what) {
  if (reported_.insert(what).second && !problem_) problem_ = problem(std::move(what));
}

}  // namespace stadion
