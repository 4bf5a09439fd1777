#pragma once
/// Vertex and index buffers with room for several meshes, so that one call can draw many of them.
///
/// A mesh's indices count from the start of its page, so no draw needs to know where its vertices begin.
/// The room of a freed mesh is not used again; a page goes when all of its meshes have gone.
///
/// Ownership  owns the GL objects; a MeshPlace must go before its MeshPages.
/// Threads    the thread on which the context is current.

#include "pipeline/gl/gl_object.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace stadion {

/// How much a mesh needs of a page, or a page has.
struct MeshRoom {
  std::size_t vertices = 0, indices = 0, materials = 0;
};

struct MeshPage {
  explicit MeshPage(const GlTable& gl) : vertexArray(gl), vertices(gl), indices(gl), materials(gl) {}

  GlVertexArray vertexArray;
  GlBuffer vertices, indices;
  GlBuffer materials;  ///< MaterialBlock after MaterialBlock; empty where meshes share no pages
  MeshRoom room, used;
  std::size_t meshes = 0;
};

class MeshPages;

/// Gives a mesh's share of a page back.
struct MeshPageRelease {
  MeshPages* pages = nullptr;
  void operator()(MeshPage* page) const;
};

/// Where a mesh is.
struct MeshPlace {
  std::unique_ptr<MeshPage, MeshPageRelease> page;
  MeshRoom first;          ///< the mesh begins there in its page
  bool opensPage = false;  ///< the page is new: its vertex array has no attributes yet

  /// Returns true if both have the same vertices and indices.
  bool isSame(const MeshPlace& o) const {
    return page.get() == o.page.get() && first.vertices == o.first.vertices &&
           first.indices == o.first.indices;
  }
};

class MeshPages {
public:
  /// `vertexBytes`: size of a vertex. `shared`: meshes share pages; else each has its own.
  MeshPages(const GlTable& gl, std::size_t vertexBytes, bool shared)
      : gl_(gl), vertexBytes_(vertexBytes), shared_(shared) {}

  bool areShared() const { return shared_; }
  /// Returns a place for a mesh. Its vertex array is bound, and its vertex buffer to GL_ARRAY_BUFFER.
  MeshPlace placeFor(const MeshRoom& needed);
  /// Returns the same place once more: vertices and indices stay until the last one has gone.
  static MeshPlace shared(const MeshPlace& place);
  void release(MeshPage& page);

private:
  MeshPage& add(const MeshRoom& room);

  const GlTable& gl_;
  std::size_t vertexBytes_;
  bool shared_;
  std::vector<std::unique_ptr<MeshPage>> pages_;
};

}  // namespace stadion
