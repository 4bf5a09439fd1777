#include "pipeline/gl/gl_program.h"

#include <algorithm>

namespace stadion {
namespace {

template <class GetLength, class GetLog>
std::string readLog(GLuint name, GetLength getLength, GetLog getLog) {
  GLint length = 0;
  getLength(name, GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
  getLog(name, length, nullptr, log.data());
  log.resize(log.find('\0') == std::string::npos ? log.size() : log.find('\0'));
  return log;
}

/// A shader that is deleted at the end of its scope; the program keeps its compiled form.
class Shader {
public:
  Shader(const GlTable& gl, GLenum kind, const std::string& source) : gl_(gl), name_(gl.CreateShader(kind)) {
    const char* text = source.c_str();
    gl_.ShaderSource(name_, 1, &text, nullptr);
    gl_.CompileShader(name_);
  }
  ~Shader() { gl_.DeleteShader(name_); }
  Shader(const Shader&) = delete;
  Shader& operator=(const Shader&) = delete;

  GLuint name() const { return name_; }
  bool compiled() const {
    GLint ok = 0;
    gl_.GetShaderiv(name_, GL_COMPILE_STATUS, &ok);
    return ok;
  }
  std::string log() const { return readLog(name_, gl_.GetShaderiv, gl_.GetShaderInfoLog); }

private:
  const GlTable& gl_;
  GLuint name_;
};

void bindBlock(const GlTable& gl, GLuint program, const char* name, GLuint binding) {
  const GLuint index = gl.GetUniformBlockIndex(program, name);
  if (index != GL_INVALID_INDEX) gl.UniformBlockBinding(program, index, binding);
}

}  // namespace

Result<GlProgram> GlProgram::build(const GlTable& gl, const std::string& vertex, const std::string& fragment,
                                   const GlBindings& bindings) {
  const Shader first(gl, GL_VERTEX_SHADER, vertex);
  if (!first.compiled()) return Result<GlProgram>::failure("vertex shader: " + first.log());
  const Shader second(gl, GL_FRAGMENT_SHADER, fragment);
  if (!second.compiled()) return Result<GlProgram>::failure("fragment shader: " + second.log());

  GlProgram program(gl, gl.CreateProgram());
  gl.AttachShader(program.name(), first.name());
  gl.AttachShader(program.name(), second.name());
  gl.LinkProgram(program.name());
  GLint linked = 0;
  gl.GetProgramiv(program.name(), GL_LINK_STATUS, &linked);
  if (!linked)
    return Result<GlProgram>::failure("shaders: " +
                                      readLog(program.name(), gl.GetProgramiv, gl.GetProgramInfoLog));

  for (const GlBinding& block : bindings.blocks) bindBlock(gl, program.name(), block.name, block.point);
  gl.UseProgram(program.name());
  for (const GlBinding& texture : bindings.textures)
    gl.Uniform1i(gl.GetUniformLocation(program.name(), texture.name), static_cast<GLint>(texture.point));
  program.layers_ = gl.GetUniformLocation(program.name(), "layers");
  program.area_ = gl.GetUniformLocation(program.name(), "area");
  program.firstDraw_ = gl.GetUniformLocation(program.name(), "firstDraw");
  return program;
}

}  // namespace stadion
