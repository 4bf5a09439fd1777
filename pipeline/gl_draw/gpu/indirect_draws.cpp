#include "pipeline/gl_draw/gpu/indirect_draws.h"

#include "pipeline/shader/uniform_blocks.h"

#include <algorithm>

namespace stadion {

bool IndirectDraws::isSupported(const GlTable& gl) {
  const auto has = [&](const char* extension) { return hasGlExtension(gl, extension); };
  if (!gl.MultiDrawElementsIndirect || !has("GL_ARB_multi_draw_indirect") || !has("GL_ARB_base_instance") ||
      !has("GL_ARB_shader_draw_parameters") || !has("GL_ARB_shader_storage_buffer_object"))
    return false;
  GLint major = 0, minor = 0, readable = 0;
  gl.GetIntegerv(GL_MAJOR_VERSION, &major);
  gl.GetIntegerv(GL_MINOR_VERSION, &minor);
  gl.GetIntegerv(GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS, &readable);
  return major * 10 + minor >= 43 && readable >= 2;
}

/// With any order there are few different states, so a search among them takes no time.
IndirectDraws::Run& IndirectDraws::runFor(const State& state) {
  const auto end = runs_.begin() + static_cast<std::ptrdiff_t>(used_);
  const auto from = order_ == Order::Any || used_ == 0 ? runs_.begin() : end - 1;
  if (const auto same = std::find_if(from, end, [&](const Run& run) { return run.state == state; });
      same != end)
    return *same;
  if (used_ == runs_.size()) runs_.emplace_back();
  Run& run = runs_[used_++];
  run.state = state;
  run.commands.clear();
  return run;
}

void IndirectDraws::add(const State& state, const GlMesh& mesh, const GlSubmesh& part, std::uint32_t first,
                        std::uint32_t count) {
  const auto firstIndex = static_cast<GLuint>(part.indexOffset / sizeof(std::uint32_t));
  runFor(state).commands.push_back(
      {static_cast<GLuint>(part.indexCount), count, firstIndex, 0, first, mesh.packedMaterial(part)});
}

/// The commands of all runs, one after the other, as OpenGL's source of draws and as the shader's.
void IndirectDraws::upload() {
  static_assert(sizeof(Command) == 24, "the shader reads six words a draw");
  all_.clear();
  for (std::size_t i = 0; i < used_; ++i)
    all_.insert(all_.end(), runs_[i].commands.begin(), runs_[i].commands.end());
  uploads_.fill(std::span<const Command>(all_));
  gl_.BindBuffer(GL_DRAW_INDIRECT_BUFFER, uploads_.buffer());
  gl_.BindBufferRange(GL_SHADER_STORAGE_BUFFER, kDrawsBinding, uploads_.buffer(),
                      static_cast<GLintptr>(uploads_.offset()),
                      static_cast<GLsizeiptr>(all_.size() * sizeof(Command)));
}

void IndirectDraws::setState(const State& state, const FrameData& instances) const {
  gl_.BindVertexArray(state.page->vertexArray.name());
  pointAtInstances(gl_, instances, 0);
  gl_.BindBufferBase(GL_SHADER_STORAGE_BUFFER, kMaterialsBinding, state.materials);
  gl_.UseProgram(state.program->name());
  bindMaps(gl_, state.maps);
  gl_.FrontFace(state.mirrored ? GL_CW : GL_CCW);
  gl_.CullFace(GL_BACK);
  if (state.bothSides)
    gl_.Disable(GL_CULL_FACE);
  else
    gl_.Enable(GL_CULL_FACE);
}

DrawCounts IndirectDraws::draw(const FrameData& instances) {
  DrawCounts counts;
  if (used_ == 0) return counts;
  upload();
  std::size_t first = 0;
  for (std::size_t i = 0; i < used_; ++i) {
    const Run& run = runs_[i];
    setState(run.state, instances);
    if (run.state.program->firstDraw() >= 0)
      gl_.Uniform1i(run.state.program->firstDraw(), static_cast<GLint>(first));
    gl_.MultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT,
                                  inBuffer(uploads_.offset() + first * sizeof(Command)),
                                  static_cast<GLsizei>(run.commands.size()), sizeof(Command));
    first += run.commands.size();
    ++counts.calls;
    for (const Command& command : run.commands) {
      counts.instances += command.instances;
      counts.triangles += std::uint64_t{command.instances} * (command.indices / 3);
    }
  }
  used_ = 0;
  return counts;
}

}  // namespace stadion
