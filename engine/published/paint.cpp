#include "engine/published/paint.h"

#include "engine/maths/srgb.h"

namespace stadion {
namespace {

bool isShare(double x) {
  return x >= 0 && x <= 1;
}

bool isColour(const Vec3& c) {
  return isShare(c.x()) && isShare(c.y()) && isShare(c.z());
}

}  // namespace

bool Paint::isValid() const {
  return isColour(tint) && isColour(emit) && isShare(opacity);
}

PaintRecord recordOf(const Paint& paint) {
  PaintRecord r;
  for (int k = 0; k < 3; ++k) {
    r.tint[k] = static_cast<float>(linearFromSrgb(paint.tint[k]));
    r.emit[k] = static_cast<float>(linearFromSrgb(paint.emit[k]));
  }
  r.opacity = static_cast<float>(paint.opacity);
  return r;
}

}  // namespace stadion
