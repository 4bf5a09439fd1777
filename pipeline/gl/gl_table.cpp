#include "pipeline/gl/gl_table.h"

#include <cstring>

namespace stadion {

Result<GlTable> loadGlTable(GlResolver resolve) {
  GlTable table;
  const char* missing = nullptr;
#define STADION_GL_LOAD(type, name)                                                                          \
  table.name = reinterpret_cast<type>(resolve("gl" #name));                                                  \
  if (!table.name && !missing) missing = "gl" #name;
  STADION_GL_FUNCTIONS(STADION_GL_LOAD)
#undef STADION_GL_LOAD
#define STADION_GL_LOAD(type, name) table.name = reinterpret_cast<type>(resolve("gl" #name));
  STADION_GL_MORE_FUNCTIONS(STADION_GL_LOAD)
#undef STADION_GL_LOAD
  if (missing) return Result<GlTable>::failure(std::string("this OpenGL has no function ") + missing);
  return table;
}

bool hasGlExtension(const GlTable& gl, const char* name) {
  GLint count = 0;
  gl.GetIntegerv(GL_NUM_EXTENSIONS, &count);
  for (GLint i = 0; i < count; ++i) {
    const auto* extension =
        reinterpret_cast<const char*>(gl.GetStringi(GL_EXTENSIONS, static_cast<GLuint>(i)));
    if (extension && std::strcmp(extension, name) == 0) return true;
  }
  return false;
}

ClipDepth setClipDepth(const GlTable& gl) {
  if (!gl.ClipControl || !hasGlExtension(gl, "GL_ARB_clip_control")) return ClipDepth::MinusOneToOne;
  gl.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  return ClipDepth::ZeroToOne;
}

bool isSoftware(const GlTable& gl) {
  const auto* renderer = reinterpret_cast<const char*>(gl.GetString(GL_RENDERER));
  return renderer && (std::strstr(renderer, "llvmpipe") || std::strstr(renderer, "softpipe"));
}

const char* glErrorName(GLenum error) {
  switch (error) {
  case GL_NO_ERROR: return "no error";
  case GL_INVALID_ENUM: return "invalid enum";
  case GL_INVALID_VALUE: return "invalid value";
  case GL_INVALID_OPERATION: return "invalid operation";
  case GL_INVALID_FRAMEBUFFER_OPERATION: return "invalid framebuffer operation";
  case GL_OUT_OF_MEMORY: return "out of memory";
  case GL_CONTEXT_LOST: return "that the context is lost";
  default: return "unknown error";
  }
}

}  // namespace stadion
