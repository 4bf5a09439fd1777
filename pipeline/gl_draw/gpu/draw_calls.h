#pragma once
/// Makes OpenGL's draw calls, sets the state that they need, and counts them.
///
/// State    set only where it differs. Binding what is bound already costs a software rasteriser as much as
///          drawing some triangles.
/// Threads  the thread on which the context is current.

#include "pipeline/draw_list/draw_counts.h"
#include "pipeline/gl/gl_object.h"
#include "pipeline/gl/gl_program.h"

#include <cstdint>
#include <utility>

namespace stadion {

class DrawCalls {
public:
  /// Sets the state that never changes. `basesInstances`: a draw call may begin at any instance.
  DrawCalls(const GlTable& gl, bool basesInstances);

  bool basesInstances() const { return basesInstances_; }

  /// Restores the state that an interrupted drawing may have changed.
  void restoreState();
  /// Starts a view: counts from zero, and assumes nothing about what is bound.
  void beginView();

  void use(const GlProgram& program);
  /// Must follow each other use of a program, so that use() binds its program again.
  void forgetProgram() { usedProgram_ = 0; }
  /// `at`: place in the buffer [bytes].
  void bindMaterial(GLuint buffer, GLintptr at);
  /// Which faces are left out.
  void cull(bool front, bool back);

  /// Draws triangles of the bound vertex array. `from`: in its index buffer [bytes]; `first`: of the
  /// instances.
  void drawIndices(std::uintptr_t from, GLsizei count, std::uint32_t first, std::uint32_t instances);
  /// Draws one triangle without vertex data, which covers the picture.
  void drawScreen(const GlVertexArray& nothing);

  /// Counts since beginView(). What draws by other means adds to them.
  DrawCounts& counts() { return counts_; }
  const DrawCounts& counts() const { return counts_; }

private:
  const GlTable& gl_;
  bool basesInstances_;
  GLuint usedProgram_ = 0;
  std::pair<GLuint, GLintptr> boundMaterial_{};  ///< buffer, place in it [bytes]
  DrawCounts counts_;
};

}  // namespace stadion
