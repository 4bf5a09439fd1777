#include "pipeline/gl_draw/passes/surface_drawing.h"

namespace stadion {

SurfaceDrawing::SurfaceDrawing(const PassContext& with) : with_(with) {
  if (with.scene.drawsIndirectly())
    indirect_.emplace(with.gl, with.scene.uploads(), IndirectDraws::Order::AsAdded);
}

void SurfaceDrawing::beginBatch(const GlMesh& mesh, const InstanceBatch& seen) {
  with_.scene.instances().upload();
  with_.gl.BindVertexArray(mesh.vertexArray());
  with_.gl.FrontFace(seen.mirrored ? GL_CW : GL_CCW);
  if (with_.scene.calls().basesInstances()) with_.scene.instances().pointAt(0);
}

void SurfaceDrawing::beginCall(std::uint32_t first) {
  with_.stop.check();
  if (!with_.scene.calls().basesInstances()) with_.scene.instances().pointAt(first);
}

const GlProgram& SurfaceDrawing::beginPart(const GlMesh& mesh, const GlSubmesh& part, SurfaceWrites writes) {
  const GlProgram& program = with_.scene.surfaces().use(part, writes);
  bindMaps(with_.gl, part.maps);
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

void SurfaceDrawing::drawOpaque(const GlMesh& mesh, const InstanceBatch& seen, bool opaqueOnly) {
  if (indirect_) return collectOpaque(partsOf(mesh, seen.level), seen, opaqueOnly);
  forEachCall(mesh, seen, false, [&](const MeshParts& of, std::uint32_t first, std::uint32_t count) {
    drawOpaqueParts(of, first, count, opaqueOnly);
  });
}

/// Of timed pieces each is drawn by itself.
void SurfaceDrawing::collectOpaque(const MeshParts& mesh, const InstanceBatch& seen, bool opaqueOnly) {
  for (std::uint32_t done = 0, count = 0; done < seen.count; done += count) {
    with_.stop.check();
    const std::uint32_t first = seen.first + done;
    count = with_.pieces.togetherFrom(seen, done, mesh);
    if (with_.pieces.areTimed()) {
      finishOpaque();
      with_.pieces.next(first);
    }
    for (const GlSubmesh& part : mesh.parts) {
      if (opaqueOnly && part.transparent) continue;
      const GlProgram& program = with_.scene.surfaces().programFor(part, SurfaceWrites::Picture);
      indirect_->add({&program, mesh.gl->place.page.get(), mesh.gl->packedMaterials(), part.maps,
                      part.bothSides, seen.mirrored},
                     *mesh.gl, part, first, count);
    }
  }
}

void SurfaceDrawing::finishOpaque() {
  if (!indirect_) return;
  with_.scene.instances().upload();
  with_.scene.calls().counts().add(indirect_->draw(with_.scene.instances().uploaded()));
  with_.scene.calls().forgetProgram();
}

void SurfaceDrawing::forgetOpaque() {
  if (indirect_) indirect_->clear();
}

}  // namespace stadion
