#include "bench/looks/open_gl_pictures.h"

namespace stadion::bench {

Result<std::unique_ptr<OpenGlPictures>> OpenGlPictures::create(const MeshStore& meshes, PixelSize size,
                                                               GlProviderKind kind) {
  std::unique_ptr<OpenGlPictures> made(new OpenGlPictures);
  auto provider = openGlProvider(kind);
  if (!provider) return provider.error();
  made->provider_ = std::move(provider.value());
  auto target = made->provider_->create(size.width, size.height);
  if (!target) return target.error();
  if (const auto wrong = target.value()->makeCurrent()) return *wrong;
  made->target_ = std::move(target.value());
  auto renderer =
      GlRenderer::create(made->target_->gl(), made->target_->turns(), meshes, size.width, size.height);
  if (!renderer) return renderer.error();
  made->renderer_ = std::move(renderer.value());
  return Result<std::unique_ptr<OpenGlPictures>>(std::move(made));
}

OpenGlPictures::~OpenGlPictures() {
  renderer_.reset();
  if (target_) target_->release();
}

}  // namespace stadion::bench
