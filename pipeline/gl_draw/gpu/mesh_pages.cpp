#include "pipeline/gl_draw/gpu/mesh_pages.h"

#include "pipeline/shader/uniform_blocks.h"

#include <algorithm>

namespace stadion {
namespace {

/// Of 30 MB: Olympia needs one.
constexpr MeshRoom kUsualPage{std::size_t{1} << 19, std::size_t{1} << 21, std::size_t{1} << 12};

MeshRoom sum(const MeshRoom& a, const MeshRoom& b) {
  return {a.vertices + b.vertices, a.indices + b.indices, a.materials + b.materials};
}

bool fits(const MeshRoom& needed, const MeshRoom& room) {
  return needed.vertices <= room.vertices && needed.indices <= room.indices &&
         needed.materials <= room.materials;
}

}  // namespace

void MeshPageRelease::operator()(MeshPage* page) const {
  pages->release(*page);
}

MeshPlace MeshPages::placeFor(const MeshRoom& needed) {
  const auto found = std::ranges::find_if(
      pages_, [&](const auto& page) { return shared_ && fits(sum(page->used, needed), page->room); });
  const bool isNew = found == pages_.end();
  MeshPage& page = isNew ? add(shared_ && fits(needed, kUsualPage) ? kUsualPage : needed) : **found;
  const MeshRoom first = page.used;
  page.used = sum(first, needed);
  ++page.meshes;
  gl_.BindVertexArray(page.vertexArray.name());
  gl_.BindBuffer(GL_ARRAY_BUFFER, page.vertices.name());
  return {{&page, MeshPageRelease{this}}, first, isNew};
}

MeshPlace MeshPages::shared(const MeshPlace& place) {
  ++place.page->meshes;
  return {{place.page.get(), place.page.get_deleter()}, place.first, false};
}

MeshPage& MeshPages::add(const MeshRoom& room) {
  MeshPage& page = *pages_.emplace_back(std::make_unique<MeshPage>(gl_));
  page.room = room;
  const auto storage = [&](GLenum target, const GlBuffer& buffer, std::size_t bytes) {
    gl_.BindBuffer(target, buffer.name());
    gl_.BufferData(target, static_cast<GLsizeiptr>(bytes), nullptr, GL_STATIC_DRAW);
  };
  gl_.BindVertexArray(page.vertexArray.name());
  storage(GL_ARRAY_BUFFER, page.vertices, room.vertices * vertexBytes_);
  storage(GL_ELEMENT_ARRAY_BUFFER, page.indices, room.indices * sizeof(std::uint32_t));
  if (shared_) storage(GL_SHADER_STORAGE_BUFFER, page.materials, room.materials * sizeof(MaterialBlock));
  return page;
}

void MeshPages::release(MeshPage& page) {
  if (--page.meshes > 0) return;
  std::erase_if(pages_, [&](const auto& each) { return each.get() == &page; });
}

}  // namespace stadion
