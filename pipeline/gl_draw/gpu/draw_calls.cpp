#include "pipeline/gl_draw/gpu/draw_calls.h"

#include "pipeline/shader/uniform_blocks.h"

namespace stadion {

DrawCalls::DrawCalls(const GlTable& gl, bool basesInstances) : gl_(gl), basesInstances_(basesInstances) {
  gl_.Enable(GL_MULTISAMPLE);
  gl_.Enable(GL_DEPTH_TEST);
  gl_.DepthFunc(GL_GEQUAL);  // depths are 1 at the near plane and 0 at the far one
  gl_.ClearDepth(0);
  gl_.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);  // pictures stay opaque
  gl_.ClearColor(0, 0, 0, 1);
  gl_.ActiveTexture(GL_TEXTURE0);
}

void DrawCalls::restoreState() {
  gl_.Disable(GL_SCISSOR_TEST);
  gl_.Disable(GL_POLYGON_OFFSET_FILL);
  gl_.Disable(GL_BLEND);
  gl_.DepthMask(GL_TRUE);
  gl_.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

void DrawCalls::beginView() {
  counts_ = {};
  usedProgram_ = 0;
  boundMaterial_ = {};
}

void DrawCalls::use(const GlProgram& program) {
  if (usedProgram_ == program.name()) return;
  usedProgram_ = program.name();
  gl_.UseProgram(usedProgram_);
}

void DrawCalls::bindMaterial(GLuint buffer, GLintptr at) {
  if (boundMaterial_ == std::pair(buffer, at)) return;
  boundMaterial_ = {buffer, at};
  gl_.BindBufferRange(GL_UNIFORM_BUFFER, kMaterialBinding, buffer, at, sizeof(MaterialBlock));
}

void DrawCalls::cull(bool front, bool back) {
  if (!front && !back) {
    gl_.Disable(GL_CULL_FACE);
    return;
  }
  gl_.Enable(GL_CULL_FACE);
  gl_.CullFace(front ? GL_FRONT : GL_BACK);
}

void DrawCalls::drawIndices(std::uintptr_t from, GLsizei count, std::uint32_t first,
                            std::uint32_t instances) {
  const auto times = static_cast<GLsizei>(instances);
  if (basesInstances_)
    gl_.DrawElementsInstancedBaseInstance(GL_TRIANGLES, count, GL_UNSIGNED_INT, inBuffer(from), times, first);
  else
    gl_.DrawElementsInstanced(GL_TRIANGLES, count, GL_UNSIGNED_INT, inBuffer(from), times);
  ++counts_.calls;
  counts_.instances += instances;
  counts_.triangles += std::uint64_t{instances} * static_cast<std::uint64_t>(count / 3);
}

void DrawCalls::drawScreen(const GlVertexArray& nothing) {
  gl_.BindVertexArray(nothing.name());
  gl_.FrontFace(GL_CCW);
  cull(false, false);
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
  ++counts_.calls;
}

}  // namespace stadion
