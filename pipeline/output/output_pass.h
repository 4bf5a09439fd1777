#pragma once
/// The last step with OpenGL: finished pictures onto the content of a window.
///
/// A picture that is as large as its place and is not warped is copied pixel by pixel; others are filtered.
///
/// Ownership  owns its GL objects; the table must outlive it.
/// Threads    made, used and destroyed on the thread on which the window's context is current.

#include "pipeline/gl/gl_object.h"
#include "pipeline/gl/gl_program.h"
#include "pipeline/output/window_canvas.h"
#include "pipeline/picture/picture.h"

#include <memory>

namespace stadion {

/// A picture on the graphics card.
class PictureTexture {
public:
  explicit PictureTexture(const GlTable& gl) : gl_(gl), texture_(gl) {}

  void upload(const Picture& picture);
  bool empty() const { return width_ == 0; }
  std::uint32_t width() const { return width_; }
  std::uint32_t height() const { return height_; }
  GLuint name() const { return texture_.name(); }

private:
  const GlTable& gl_;
  GlTexture texture_;
  std::uint32_t width_ = 0, height_ = 0;
};

/// A pane of the window: the picture of one wall.
struct Pane {
  const PictureTexture* left = nullptr;
  const PictureTexture* right = nullptr;  ///< null = as left
  std::int32_t x = 0, y = 0;              ///< upper left corner [pixels of the window]
  std::uint32_t width = 0, height = 0;    ///< [pixels]
  EyeMix mix = EyeMix::Left;
  OutputShape shape;
  std::int32_t firstRow = 0;  ///< for Interlaced: the monitor's row that shows the top row of the window
};

class OutputPass {
public:
  static Result<std::unique_ptr<OutputPass>> create(const GlTable& gl);

  /// Begins a new content of so many pixels: all black. Of a quad-buffered window one buffer after the other.
  void begin(std::uint32_t width, std::uint32_t height, GLenum buffer = GL_BACK);
  void draw(const Pane& pane);
  /// From now on draws only there, from the upper left corner of the content; without a width everywhere
  /// again.
  void clip(std::int32_t x, std::int32_t y, std::uint32_t width, std::uint32_t height);
  /// Lays a picture with transparency over the target's picture.
  void overlay(const PictureTexture& picture, std::int32_t x, std::int32_t y);
  /// Reads the pixels of the back buffer.
  Picture read() const;

private:
  struct Uniforms {
    GLint place, toPicture, mode, gamma, gain;
  };

  OutputPass(const GlTable& gl, GlProgram program);
  void sample(GLenum unit, const PictureTexture& picture, bool exact);
  void fill(std::int32_t x, std::int32_t y, std::uint32_t width, std::uint32_t height);

  const GlTable& gl_;
  GlProgram program_;
  GlVertexArray nothing_;  // the triangle has no vertex data
  Uniforms uniforms_;
  std::uint32_t width_ = 0, height_ = 0;
  GLenum buffer_ = GL_BACK;
};

}  // namespace stadion
