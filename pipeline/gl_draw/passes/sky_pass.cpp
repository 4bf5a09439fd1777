#include "pipeline/gl_draw/passes/sky_pass.h"

#include "pipeline/shader/shaders.h"

namespace stadion {

Result<std::unique_ptr<SkyPass>> SkyPass::create(const GlTable& gl, GpuScene& scene, Look look,
                                                 ProblemLog& problems) {
  std::unique_ptr<SkyPass> pass(new SkyPass(gl, scene, look, problems));
  auto usual = pass->build({0, false});
  if (!usual) return usual.error();
  pass->programs_.emplace(Key{0, false}, std::move(usual.value()));
  return pass;
}

Result<GlProgram> SkyPass::build(const Key& key) const {
  return GlProgram::build(gl_, skyVertexShader(), skyFragmentShader(look_, key.first, key.second),
                          shaderBindings());
}

/// If it cannot be built, the usual sky is drawn.
const GlProgram& SkyPass::program() {
  const Key key{scene_.tones(), scene_.hasBackground()};
  if (const auto known = programs_.find(key); known != programs_.end()) return known->second;
  auto built = build(key);
  scene_.calls().forgetProgram();
  if (built) return programs_.emplace(key, std::move(built.value())).first->second;
  problems_.report(built.error().message);
  return programs_.at({0, false});
}

void SkyPass::draw() {
  scene_.calls().use(program());
  scene_.calls().drawScreen(nothing_);
}

}  // namespace stadion
