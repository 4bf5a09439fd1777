#include "pipeline/gl_draw/gpu/gpu_scene.h"

#include <algorithm>
#include <string>

namespace stadion {
namespace {

bool isLocal(const DrawLight& light) {
  return light.kind != DrawLight::Kind::Directional;
}

bool canBaseInstances(const GlTable& gl) {
  return gl.DrawElementsInstancedBaseInstance && hasGlExtension(gl, "GL_ARB_base_instance");
}

}  // namespace

GpuScene::GpuScene(const GlTable& gl, const MeshStore& store, RenderQuality quality, bool sortsObjects,
                   ProblemLog& problems)
    : gl_(gl), look_(quality.look), problems_(problems), calls_(gl, canBaseInstances(gl)),
      cullsTriangles_(quality.samples == 1 && quality.leavesOutUnseen && isSoftware(gl) &&
                      calls_.basesInstances()),
      meshes_(gl, store, quality.look, cullsTriangles_), surfaces_(gl, quality.look, calls_, problems),
      instances_(gl, sortsObjects), scene_(gl) {
  growTo(1);
}

void GpuScene::begin(const DrawList& list, FrameProbe* probe) {
  calls_.restoreState();
  meshes_.freeUnused();
  if (list.lights.size() > DrawList::kMaxLights)
    problems_.report("more than " + std::to_string(DrawList::kMaxLights) + " lights: the rest are left out");
  meshes_.setProbe(probe);
  instances_.begin(list, probe);
  instances_.takeMore();
}

void GpuScene::light(const DrawList& list, bool shadowed) {
  lighting_ = fillScene(list.sky, list.lights, look_, shadowed ? list.shadows.light : -1);
  skyIsFlat_ =
      look_ == Look::Plain && lighting_.zenith == lighting_.horizon && lighting_.zenith == lighting_.ground;
  if (skyIsFlat_) gl_.ClearColor(lighting_.zenith[0], lighting_.zenith[1], lighting_.zenith[2], 1);
  stream(gl_, GL_UNIFORM_BUFFER, scene_, std::span<const SceneBlock>(&lighting_, 1));
  surfaces_.choose({shadowed, list.sky.hazeDistance > 0, std::ranges::any_of(list.lights, isLocal),
                    std::min(list.lights.size(), DrawList::kMaxLights)});
  isLit_ = true;
}

void GpuScene::growTo(std::size_t views) {
  while (views_.size() < views) views_.emplace_back(gl_);
}

void GpuScene::setView(std::size_t view, const ViewBlock& block) {
  stream(gl_, GL_UNIFORM_BUFFER, views_[view], std::span<const ViewBlock>(&block, 1));
}

void GpuScene::bindView(std::size_t view) const {
  gl_.BindBufferBase(GL_UNIFORM_BUFFER, kViewBinding, views_[view].name());
  gl_.BindBufferBase(GL_UNIFORM_BUFFER, kSceneBinding, scene_.name());
}

}  // namespace stadion
