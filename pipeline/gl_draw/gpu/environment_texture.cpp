#include "pipeline/gl_draw/gpu/environment_texture.h"

#include <algorithm>

namespace stadion {

void EnvironmentTexture::show(const EnvironmentRecord& record,
                              const std::shared_ptr<const EnvironmentLight>& light) {
  if (light != light_) {
    light_ = light;
    upload();
  }
  EnvironmentBlock block = fillEnvironment(record, *light);
  block.maps = places_.maps;
  block.texel = places_.texel;
  block_.fill(std::span<const EnvironmentBlock>(&block, 1));
  gl_.ActiveTexture(GL_TEXTURE0 + kEnvironmentUnit);
  gl_.BindTexture(GL_TEXTURE_2D, texture_->name());
  gl_.ActiveTexture(GL_TEXTURE0);
}

void EnvironmentTexture::upload() {
  const std::uint32_t picture = light_->pictureSide == 0 ? 0 : light_->pictureSide + 1;
  std::uint32_t row = 0;
  for (const std::uint32_t side : EnvironmentLight::kSides) row += side + 1;
  const std::uint32_t width = std::max(picture, row), height = picture + EnvironmentLight::kSides[0] + 1;
  texture_.emplace(gl_);
  gl_.BindTexture(GL_TEXTURE_2D, texture_->name());
  gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_RGB9_E5, static_cast<GLsizei>(width), static_cast<GLsizei>(height), 0,
                 GL_RGB, GL_UNSIGNED_INT_5_9_9_9_REV, nullptr);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
  for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
    gl_.TexParameteri(GL_TEXTURE_2D, filter, GL_LINEAR);
  for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
    gl_.TexParameteri(GL_TEXTURE_2D, wrap, GL_CLAMP_TO_EDGE);
  gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
  if (picture > 0) uploadMap(0, 0, 0, picture);
  std::uint32_t x = 0;
  for (std::size_t i = 0; i < EnvironmentLight::kMaps; ++i) {
    const std::uint32_t side = EnvironmentLight::kSides[i];
    uploadMap(light_->firstOf(i), x, picture, side + 1);
    places_.maps[i] = {static_cast<float>(x), static_cast<float>(picture), static_cast<float>(side), 0};
    x += side + 1;
  }
  places_.texel = {1 / static_cast<float>(width), 1 / static_cast<float>(height), 0, 0};
  gl_.BindTexture(GL_TEXTURE_2D, 0);
}

/// `side`: in texels.
void EnvironmentTexture::uploadMap(std::size_t first, std::uint32_t x, std::uint32_t y,
                                   std::uint32_t side) const {
  gl_.TexSubImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(x), static_cast<GLint>(y),
                    static_cast<GLsizei>(side), static_cast<GLsizei>(side), GL_RGB,
                    GL_UNSIGNED_INT_5_9_9_9_REV, light_->texels.data() + first);
}

}  // namespace stadion
