#include "pipeline/gl_draw/passes/sky_pass.h"

#include "pipeline/shader/shaders.h"

namespace stadion {

Result<std::unique_ptr<SkyPass>> SkyPass::create(const GlTable& gl, GpuScene& scene, Look look) {
  auto program = GlProgram::build(gl, skyVertexShader(), skyFragmentShader(look), shaderBindings());
  if (!program) return program.error();
  return std::unique_ptr<SkyPass>(new SkyPass(gl, scene, std::move(program.value())));
}

void SkyPass::draw() {
  scene_.calls().use(program_);
  scene_.calls().drawScreen(nothing_);
}

}  // namespace stadion
