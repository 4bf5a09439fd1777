#include "pipeline/gl_draw/gpu/gpu_scene.h"

#include "pipeline/gl_draw/gpu/indirect_draws.h"

#include <algorithm>
#include <string>

namespace stadion {
namespace {

bool isLocal(const DrawLight& light) {
  return light.kind != DrawLight::Kind::Directional;
}

int tonesOf(const TonesRecord& tones) {
  if (tones.curve == ToneCurve::Soft && tones.exposure == 1) return 0;
  return static_cast<int>(tones.curve) + 1;
}

bool canBaseInstances(const GlTable& gl) {
  return gl.DrawElementsInstancedBaseInstance && hasGlExtension(gl, "GL_ARB_base_instance");
}

bool isUsed(const GlTable& gl, GlUse use) {
  return use == GlUse::Always || (use == GlUse::OnCard && !isSoftware(gl));
}

}  // namespace

/// Makes the ring, if it is to be used and the context has one.
UploadRing* GpuScene::withRing(GlUse use) {
  if (isUsed(gl_, use) && UploadRing::isSupported(gl_)) uploads_.emplace(gl_);
  return uploads();
}

GpuScene::GpuScene(const GlTable& gl, const MeshStore& store, RenderQuality quality, bool sortsObjects,
                   ProblemLog& problems)
    : gl_(gl), look_(quality.look), problems_(problems), calls_(gl, canBaseInstances(gl)),
      cullsTriangles_(quality.samples == 1 && quality.leavesOutUnseen && isSoftware(gl) &&
                      calls_.basesInstances()),
      drawsIndirectly_(isUsed(gl, quality.submission.indirect) && IndirectDraws::isSupported(gl) &&
                       calls_.basesInstances() && !cullsTriangles_ && quality.mostAtOnce > 1),
      meshes_(gl, store, quality.look, {cullsTriangles_, drawsIndirectly_}), figures_(meshes_, store),
      painted_(meshes_, store), surfaces_(gl, quality.look, drawsIndirectly_, calls_, problems),
      instances_(gl, withRing(quality.submission.mapped), sortsObjects), environments_(store),
      environment_(gl, uploads()), reflections_(quality.reflections),
      scene_(gl, uploads(), GL_UNIFORM_BUFFER) {
  growTo(1);
}

void GpuScene::begin(const DrawList& list, FrameProbe* probe) {
  calls_.restoreState();
  if (uploads_) uploads_->beginFrame();
  painted_.begin(list);
  figures_.begin(list);
  meshes_.freeUnused();
  if (list.lights.size() > DrawList::kMaxLights)
    problems_.report("more than " + std::to_string(DrawList::kMaxLights) + " lights: the rest are left out");
  meshes_.setProbe(probe);
  instances_.begin(list, probe);
  instances_.takeMore();
}

void GpuScene::light(const DrawList& list, bool shadowed) {
  const auto light = environments_.find(list.sky);
  lighting_ = fillScene(list.sky, list.lights, look_, shadowed ? list.shadows.light : -1, light.get());
  const Surroundings surroundings = surround(list.sky, light);
  tones_ = look_ == Look::Plain ? 0 : tonesOf(list.sky.tones);
  skyIsFlat_ =
      look_ == Look::Plain && lighting_.zenith == lighting_.horizon && lighting_.zenith == lighting_.ground;
  if (skyIsFlat_) gl_.ClearColor(lighting_.zenith[0], lighting_.zenith[1], lighting_.zenith[2], 1);
  scene_.fill(std::span<const SceneBlock>(&lighting_, 1));
  surfaces_.choose({shadowed, list.sky.hazeDistance > 0, std::ranges::any_of(list.lights, isLocal),
                    std::min(list.lights.size(), DrawList::kMaxLights), surroundings, tones_});
  isLit_ = true;
}

/// Returns what gives light from all around.
Surroundings GpuScene::surround(const DrawSky& sky, const std::shared_ptr<const EnvironmentLight>& light) {
  isSurrounded_ = light && look_ == Look::Full;
  hasBackground_ = isSurrounded_ && sky.environment.background != 0 && light->pictureSide > 0;
  if (!isSurrounded_) return Surroundings::None;
  environment_.show(sky.environment, light);
  return reflections_ ? Surroundings::Maps : Surroundings::Harmonics;
}

void GpuScene::growTo(std::size_t views) {
  while (views_.size() < views) views_.emplace_back(gl_, uploads(), GL_UNIFORM_BUFFER);
}

void GpuScene::setView(std::size_t view, const ViewBlock& block) {
  views_[view].fill(std::span<const ViewBlock>(&block, 1));
}

void GpuScene::bindView(std::size_t view) const {
  views_[view].bindBlock(kViewBinding);
  scene_.bindBlock(kSceneBinding);
  if (isSurrounded_) environment_.bindBlock();
}

}  // namespace stadion
