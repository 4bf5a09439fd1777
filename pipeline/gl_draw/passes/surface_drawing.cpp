#include "pipeline/gl_draw/passes/surface_drawing.h"

namespace stadion {

void SurfaceDrawing::beginBatch(const GlMesh& mesh, const InstanceBatch& seen) {
  with_.scene.instances().upload();
  with_.gl.BindVertexArray(mesh.vertexArray.name());
  with_.gl.FrontFace(seen.mirrored ? GL_CW : GL_CCW);
  if (with_.scene.calls().basesInstances()) with_.scene.instances().pointAt(0);
}

void SurfaceDrawing::beginCall(std::uint32_t first) {
  with_.stop.check();
  if (!with_.scene.calls().basesInstances()) with_.scene.instances().pointAt(first);
}

const GlProgram& SurfaceDrawing::beginPart(const GlMesh& mesh, const GlSubmesh& part, SurfaceWrites writes) {
  const GlTable& gl = with_.gl;
  const GlProgram& program = with_.scene.surfaces().use(part, writes);
  if (part.texture) gl.BindTexture(GL_TEXTURE_2D, part.texture);
  if (part.glowTexture) {
    gl.ActiveTexture(GL_TEXTURE0 + kGlowUnit);
    gl.BindTexture(GL_TEXTURE_2D, part.glowTexture);
    gl.ActiveTexture(GL_TEXTURE0);
  }
  with_.scene.calls().bindMaterial(mesh.materials.name(), part.materialOffset);
  return program;
}

void SurfaceDrawing::drawPart(const GlMesh& mesh, const GlSubmesh& part, std::uint32_t first,
                              std::uint32_t count, SurfaceWrites writes) {
  beginPart(mesh, part, writes);
  with_.scene.calls().drawIndices(part.indexOffset, part.indexCount, first, count);
}

void SurfaceDrawing::drawOpaqueParts(const MeshParts& mesh, std::uint32_t first, std::uint32_t count,
                                     bool opaqueOnly) {
  for (const GlSubmesh& part : mesh.parts) {
    if (opaqueOnly && part.transparent) continue;
    with_.scene.calls().cull(false, !part.bothSides);
    drawPart(*mesh.gl, part, first, count, SurfaceWrites::Picture);
  }
}

}  // namespace stadion
