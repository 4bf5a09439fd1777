#include "pipeline/output/output_pass.h"

#include "pipeline/output/output_colours.h"
#include "pipeline/shader/uniform_blocks.h"

#include <algorithm>

namespace stadion {
namespace {

constexpr const char* kVertex = R"(#version 330 core
void main() {
  gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
}
)";

constexpr const char* kFragment = R"(#version 330 core
uniform sampler2D left, right;
uniform vec4 place;      // x, y of the lower left corner, width, height [pixels]
uniform mat3 toPicture;  // of shares from the upper left corner
uniform ivec4 mode;      // x: 0 left, 1 right, 2 anaglyph, 3 interlaced; y: height of the content, and 1 if its top row is an odd one of the monitor; z: colours; w: alpha
uniform vec3 gamma, gain;
out vec4 shown;

const vec3 kLuminance = vec3(0.2126, 0.7152, 0.0722);

vec3 linear(vec3 c) { return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), step(0.04045, c)); }
float encoded(float c) { return c <= 0.0031308 ? 12.92 * c : 1.055 * pow(c, 1.0 / 2.4) - 0.055; }

void main() {
  vec2 share = (gl_FragCoord.xy - place.xy) / place.zw;
  vec3 at = toPicture * vec3(share.x, 1.0 - share.y, 1.0);
  vec2 uv = at.xy / at.z;
  if (at.z <= 0.0 || any(lessThan(uv, vec2(0.0))) || any(greaterThan(uv, vec2(1.0)))) {
    shown = vec4(0.0, 0.0, 0.0, 1.0);
    return;
  }
  int row = mode.y - 1 - int(gl_FragCoord.y);  // from the top
  bool second = mode.x == 1 || (mode.x == 3 && row % 2 == 1);
  vec4 c = second ? texture(right, uv) : texture(left, uv);
  if (mode.x == 2) c = vec4(encoded(dot(linear(c.rgb), kLuminance)), texture(right, uv).gb, 1.0);
  if (mode.z == 1) c.rgb = pow(c.rgb, gamma) * gain;
  shown = vec4(c.rgb, mode.w == 1 ? c.a : 1.0);
}
)";

}  // namespace

void PictureTexture::upload(const Picture& picture) {
  const auto w = static_cast<GLsizei>(picture.width), h = static_cast<GLsizei>(picture.height);
  gl_.BindTexture(GL_TEXTURE_2D, texture_.name());
  gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  const void* pixels = picture.rgba.data();
  if (picture.width == width_ && picture.height == height_) {
    gl_.TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, w, h, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
    return;
  }
  width_ = picture.width;
  height_ = picture.height;
  gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, w, h, 0, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

Result<std::unique_ptr<OutputPass>> OutputPass::create(const GlTable& gl) {
  auto program = GlProgram::build(gl, kVertex, kFragment, shaderBindings());
  if (!program) return program.error();
  return std::unique_ptr<OutputPass>(new OutputPass(gl, std::move(program.value())));
}

OutputPass::OutputPass(const GlTable& gl, GlProgram program)
    : gl_(gl), program_(std::move(program)), nothing_(gl) {
  const auto at = [&](const char* name) { return gl_.GetUniformLocation(program_.name(), name); };
  uniforms_ = {at("place"), at("toPicture"), at("mode"), at("gamma"), at("gain")};
  gl_.UseProgram(program_.name());
  gl_.Uniform1i(at("left"), 0);
  gl_.Uniform1i(at("right"), 1);
}

void OutputPass::begin(std::uint32_t width, std::uint32_t height, GLenum buffer) {
  width_ = width;
  height_ = height;
  buffer_ = buffer;
  gl_.BindFramebuffer(GL_FRAMEBUFFER, 0);
  gl_.DrawBuffer(buffer);
  gl_.Viewport(0, 0, static_cast<GLsizei>(width), static_cast<GLsizei>(height));
  gl_.ClearColor(0, 0, 0, 1);
  gl_.Clear(GL_COLOR_BUFFER_BIT);
}

void OutputPass::sample(GLenum unit, const PictureTexture& picture, bool exact) {
  const GLint filter = exact ? GL_NEAREST : GL_LINEAR;
  gl_.ActiveTexture(unit);
  gl_.BindTexture(GL_TEXTURE_2D, picture.name());
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
}

void OutputPass::fill(std::int32_t x, std::int32_t y, std::uint32_t width, std::uint32_t height) {
  const auto bottom = static_cast<std::int32_t>(height_) - y - static_cast<std::int32_t>(height);
  gl_.Viewport(x, bottom, static_cast<GLsizei>(width), static_cast<GLsizei>(height));
  gl_.Uniform4f(uniforms_.place, static_cast<float>(x), static_cast<float>(bottom), static_cast<float>(width),
                static_cast<float>(height));
  gl_.BindVertexArray(nothing_.name());
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
}

void OutputPass::draw(const Pane& pane) {
  if (!pane.left || pane.left->empty() || pane.width == 0 || pane.height == 0) return;
  const PictureTexture* left = pane.left;
  const PictureTexture* right = pane.right && !pane.right->empty() ? pane.right : left;
  if (pane.shape.swapEyes) std::swap(left, right);
  const bool across = pane.shape.rotate % 180 == 90;
  const bool exact = !pane.shape.warp && left->width() == (across ? pane.height : pane.width) &&
                     left->height() == (across ? pane.width : pane.height);
  gl_.UseProgram(program_.name());
  sample(GL_TEXTURE1, *right, exact);
  sample(GL_TEXTURE0, *left, exact);

  const Mat3 toPicture = pictureFromOutput(pane.shape);
  std::array<float, 9> columns{};
  for (std::size_t i = 0; i < 9; ++i)
    columns[i] = static_cast<float>(toPicture(static_cast<int>(i % 3), static_cast<int>(i / 3)));
  gl_.UniformMatrix3fv(uniforms_.toPicture, 1, GL_FALSE, columns.data());
  gl_.Uniform4i(uniforms_.mode, static_cast<GLint>(pane.mix),
                static_cast<GLint>(height_) + (pane.firstRow & 1), pane.shape.turnsColours() ? 1 : 0, 0);
  const auto& g = pane.shape.gamma;
  gl_.Uniform3f(uniforms_.gamma, static_cast<float>(1 / g[0]), static_cast<float>(1 / g[1]),
                static_cast<float>(1 / g[2]));
  const auto gain = [&](std::size_t i) { return static_cast<float>(channelGain(pane.shape.brightness[i])); };
  gl_.Uniform3f(uniforms_.gain, gain(0), gain(1), gain(2));
  fill(pane.x, pane.y, pane.width, pane.height);
}

void OutputPass::clip(std::int32_t x, std::int32_t y, std::uint32_t width, std::uint32_t height) {
  if (width == 0) return gl_.Disable(GL_SCISSOR_TEST);
  gl_.Enable(GL_SCISSOR_TEST);
  gl_.Scissor(x, static_cast<GLint>(height_) - y - static_cast<GLint>(height), static_cast<GLsizei>(width),
              static_cast<GLsizei>(height));
}

void OutputPass::overlay(const PictureTexture& picture, std::int32_t x, std::int32_t y) {
  if (picture.empty()) return;
  gl_.UseProgram(program_.name());
  sample(GL_TEXTURE0, picture, true);
  constexpr std::array<float, 9> kSame{1, 0, 0, 0, 1, 0, 0, 0, 1};
  gl_.UniformMatrix3fv(uniforms_.toPicture, 1, GL_FALSE, kSame.data());
  gl_.Uniform4i(uniforms_.mode, 0, static_cast<GLint>(height_), 0, 1);
  gl_.Enable(GL_BLEND);
  gl_.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
  fill(x, y, picture.width(), picture.height());
  gl_.Disable(GL_BLEND);
}

Picture OutputPass::read() const {
  Picture picture(width_, height_);
  gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, 0);
  gl_.ReadBuffer(buffer_);
  gl_.PixelStorei(GL_PACK_ALIGNMENT, 1);
  gl_.ReadPixels(0, 0, static_cast<GLsizei>(width_), static_cast<GLsizei>(height_), GL_RGBA, GL_UNSIGNED_BYTE,
                 picture.rgba.data());
  for (std::uint32_t top = 0; top < height_ / 2; ++top)
    std::swap_ranges(picture.at(0, top), picture.at(0, top) + std::size_t{width_} * 4,
                     picture.at(0, height_ - 1 - top));
  for (std::size_t i = 3; i < picture.rgba.size(); i += 4) picture.rgba[i] = 255;
  return picture;
}

}  // namespace stadion
