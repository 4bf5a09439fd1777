#include "pipeline/wall/wall_contexts.h"

#include "pipeline/gl_draw/gl_renderer.h"

namespace stadion {

// On a thread of its own, since something else may be current on this one, a window's context for example.
WallContexts::~WallContexts() {
  const auto closeAll = [this] {
    for (std::size_t wall = 0; wall < contexts_.size(); ++wall)
      if (contexts_[wall]->target && !enter(wall)) close(wall);
  };
  if (!contexts_.empty()) std::thread(closeAll).join();
}

void WallContexts::resize(std::size_t walls) {
  while (contexts_.size() < walls) contexts_.push_back(std::make_unique<Context>());
}

Failure WallContexts::open(std::size_t wall, GlProvider& provider, const MeshStore& meshes,
                           const WallPicture& picture, RenderQuality quality) {
  Context& c = *contexts_[wall];
  if (c.target) {
    if (Failure f = enter(wall)) return f;
    if (c.renderer && c.picture == picture && c.quality == quality) return kNoFailure;
    close(wall);
  }
  auto target = provider.createOn(picture.card, picture.width, picture.height);
  if (!target) return Reason(target.error());
  c.target = std::move(target.value());
  if (Failure f = enter(wall)) return f;
  auto renderer =
      GlRenderer::create(c.target->gl(), c.target->turns(), meshes, picture.width, picture.height, quality);
  if (!renderer) return Reason(renderer.error());
  c.renderer = std::move(renderer.value());
  c.picture = picture;
  c.quality = quality;
  return kNoFailure;
}

Failure WallContexts::enter(std::size_t wall) {
  const std::thread::id me = std::this_thread::get_id();
  if (contexts_[wall]->currentOn == me) return kNoFailure;
  for (std::size_t other = 0; other < contexts_.size(); ++other)
    if (contexts_[other]->currentOn == me) leave(other);
  if (const auto why = contexts_[wall]->target->makeCurrent()) return Reason(*why);
  contexts_[wall]->currentOn = me;
  return kNoFailure;
}

void WallContexts::leave(std::size_t wall) {
  Context& c = *contexts_[wall];
  if (c.currentOn != std::this_thread::get_id()) return;
  c.target->release();
  c.currentOn = std::thread::id{};
}

void WallContexts::close(std::size_t wall) {
  Context& c = *contexts_[wall];
  c.renderer.reset();
  if (c.target) leave(wall);
  c.target.reset();
}

}  // namespace stadion
