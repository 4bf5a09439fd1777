#include "pipeline/gl_draw/passes/shadow_pass.h"

namespace stadion {

bool ShadowPass::draw(const DrawShadows& shadows) {
  if (!maps_ && !failed_) {
    auto made = ShadowMaps::create(with_.gl, clip_, with_.scene.uploads(), with_.scene.drawsIndirectly());
    if (made)
      maps_ = std::move(made.value());
    else
      problems_.report(made.error().message);
    failed_ = !made;
  }
  if (failed_) return false;
  maps_->update(shadows, with_.scene, [this] { with_.stop.check(); });
  maps_->bind();
  return true;
}

}  // namespace stadion
