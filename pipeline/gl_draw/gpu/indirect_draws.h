#pragma once
/// Many draws in one call of OpenGL (glMultiDrawElementsIndirect).
///
/// Draws share a call if they differ in nothing but triangles, instances and material. So a call draws any
/// number of meshes of one page (mesh_pages.h). The shader looks up the material of each draw.
///
/// Order      draws keep their order, since of two surfaces at the same depth the later one is seen. So only
///            neighbours share a call. Where just the depth is drawn, any order gives the same depths.
/// Ownership  owns a GL buffer; the function table and the ring must outlive it.
/// Threads    the thread on which the context is current.

#include "pipeline/draw_list/draw_counts.h"
#include "pipeline/gl/gl_program.h"
#include "pipeline/gl_draw/gpu/frame_data.h"
#include "pipeline/gl_draw/gpu/mesh_cache.h"

#include <cstdint>
#include <vector>

namespace stadion {

class IndirectDraws {
public:
  enum class Order { AsAdded, Any };

  /// Returns true if the context can do it, and its vertex shaders can read the materials.
  static bool isSupported(const GlTable& gl);
  /// `ring`: where the draws are uploaded; null = into a buffer of their own.
  IndirectDraws(const GlTable& gl, UploadRing* ring, Order order)
      : gl_(gl), order_(order), uploads_(gl, ring, GL_DRAW_INDIRECT_BUFFER) {}

  /// What all draws of a call share.
  struct State {
    const GlProgram* program = nullptr;
    const MeshPage* page = nullptr;
    GLuint materials = 0;  ///< the buffer that has them
    MapTextures maps{};
    bool bothSides = false;  ///< no faces are culled
    bool mirrored = false;   ///< front faces run clockwise
    bool operator==(const State&) const = default;
  };
  /// Adds a draw of `count` instances from number `first` on.
  void add(const State& state, const GlMesh& mesh, const GlSubmesh& part, std::uint32_t first,
           std::uint32_t count);
  /// Draws all that was added, and forgets it. `instances`: the matrices. Leaves another program in use.
  /// Returns what was drawn.
  DrawCounts draw(const FrameData& instances);
  /// Forgets what was added.
  void clear() { used_ = 0; }

private:
  /// What OpenGL reads, and the shader after it.
  struct Command {
    GLuint indices, instances, firstIndex;
    GLint baseVertex;
    GLuint firstInstance, material;
  };
  struct Run {
    State state;
    std::vector<Command> commands;
  };

  Run& runFor(const State& state);
  void upload();
  void setState(const State& state, const FrameData& instances) const;

  const GlTable& gl_;
  Order order_;
  FrameData uploads_;
  std::vector<Run> runs_;  ///< `used_` of them count; the others keep their memory
  std::size_t used_ = 0;
  std::vector<Command> all_;
};

}  // namespace stadion
