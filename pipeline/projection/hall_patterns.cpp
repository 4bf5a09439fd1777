#include "pipeline/projection/hall_patterns.h"

#include "engine/maths/angles.h"
#include "engine/maths/functions.h"
#include "pipeline/picture/lettering.h"
#include "pipeline/picture/output_pattern.h"
#include "pipeline/picture/sketch.h"
#include "pipeline/picture/test_pattern.h"

#include <algorithm>
#include <fmt/format.h>

namespace stadion {
namespace {

constexpr Sketch::Colour kSpace{24, 26, 30}, kThin{90, 98, 108}, kHeavy{200, 205, 210},
    kHorizon{90, 230, 120}, kEdges{255, 215, 60};
constexpr double kFar = 20;                            ///< of the lines, from the usual place [m]
constexpr double kLeastDepth = 1e-3;                   ///< of w: nearer parts are not drawn [m]
constexpr int kFineDegrees = 10, kCoarseDegrees = 30;  ///< between lines [degrees]

/// Draws lines of the room into a view.
class RoomSketch {
public:
  RoomSketch(const PaintedView& view, const VisitorPlace& visitor, std::uint32_t width, std::uint32_t height)
      : view_(view), from_(visitor.eye), sketch_(width, height, kSpace) {}

  Picture run() {
    for (int angle = 0; angle < 360; angle += kFineDegrees) meridian(angle);
    for (int elevation = -80; elevation <= 80; elevation += kFineDegrees) parallel(elevation);
    cube();
    for (int azimuth = -180; azimuth < 180; azimuth += kCoarseDegrees)
      for (int elevation = -60; elevation <= 60; elevation += kCoarseDegrees) label(azimuth, elevation);
    return sketch_.take();
  }

private:
  Vec3 at(double azimuth, double elevation) const {
    const auto [sinA, cosA] = det::sincos(azimuth * kDegree);
    const auto [sinE, cosE] = det::sincos(elevation * kDegree);
    return from_ + kFar * Vec3(cosE * sinA, cosE * cosA, sinE);
  }

  Vec2 onPicture(const Vec4& clip) const {
    return {0.5 * sketch_.width() * (1 + clip.x() / clip.w()),
            0.5 * sketch_.height() * (1 - clip.y() / clip.w())};
  }

  void line(const Vec3& from, const Vec3& to, const Sketch::Colour& colour, int thick) {
    Vec4 a = view_.clipFromRig * Vec4(from.x(), from.y(), from.z(), 1),
         b = view_.clipFromRig * Vec4(to.x(), to.y(), to.z(), 1);
    if (a.w() < b.w()) std::swap(a, b);
    if (!(a.w() > kLeastDepth)) return;
    if (b.w() < kLeastDepth) b = a + (b - a) * ((a.w() - kLeastDepth) / (a.w() - b.w()));
    sketch_.line(onPicture(a), onPicture(b), colour, thick);
  }

  void meridian(int azimuth) {
    const bool heavy = azimuth % kCoarseDegrees == 0;
    for (int e = -80; e < 80; e += 2)
      line(at(azimuth, e), at(azimuth, e + 2), heavy ? kHeavy : kThin, heavy ? 3 : 1);
  }

  void parallel(int elevation) {
    const bool heavy = elevation % kCoarseDegrees == 0;
    const Sketch::Colour& colour = elevation == 0 ? kHorizon : heavy ? kHeavy : kThin;
    for (int a = 0; a < 360; a += 2) line(at(a, elevation), at(a + 2, elevation), colour, heavy ? 3 : 1);
  }

  void cube() {
    const Vec3 corner = from_ + Vec3(-0.5, -0.5, -1.2);
    for (int i = 0; i < 8; ++i)
      for (int axis = 0; axis < 3; ++axis) {
        if (i >> axis & 1) continue;
        const Vec3 a = corner + Vec3(i & 1, i >> 1 & 1, i >> 2 & 1);
        line(a, a + Vec3::Unit(axis), kEdges, 2);
      }
  }

  void label(int azimuth, int elevation) {
    const Vec3 p = at(azimuth, elevation);
    const Vec4 clip = view_.clipFromRig * Vec4(p.x(), p.y(), p.z(), 1);
    if (!(clip.w() > kLeastDepth)) return;
    const Vec2 place = onPicture(clip);
    if (!(place.minCoeff() >= 0) || place.x() >= sketch_.width() || place.y() >= sketch_.height()) return;
    const auto scale = static_cast<std::uint32_t>(std::max(1.0, sketch_.height() / 400));
    letter(sketch_.picture(), static_cast<std::uint32_t>(place.x()) + 4,
           static_cast<std::uint32_t>(place.y()) + 4, fmt::format("{} {}", azimuth, elevation), kHeavy,
           scale);
  }

  const PaintedView& view_;
  const Vec3 from_;
  Sketch sketch_;
};

}  // namespace

HallPatterns::HallPatterns(const WallFile& hall, bool stereo) : hall_(hall), stereo_(stereo) {
  if (!stereo) hall_.eyeSeparation = 0;
}

Result<std::unique_ptr<HallPatterns>> HallPatterns::create(const WallFile& hall, bool stereo) {
  std::unique_ptr<HallPatterns> patterns(new HallPatterns(hall, stereo));
  if (std::ranges::all_of(hall.walls, &WallEntry::isFlat)) return patterns;
  auto views = HallPictures::create(patterns->hall_);
  if (!views) return views.error();
  patterns->views_ = std::move(views.value());
  return patterns;
}

void HallPatterns::change(const WallFile& hall, std::size_t entry) {
  const double separation = hall_.eyeSeparation;
  hall_ = hall;
  hall_.eyeSeparation = separation;
  if (views_) views_->change(hall_, entry);
}

std::vector<Picture> HallPatterns::projected(std::size_t entry, HallPattern pattern) {
  const auto paint = [&](const PaintedView& view, Picture& picture) {
    picture = pattern == HallPattern::Blend
                  ? Picture(picture.width, picture.height, 255)
                  : RoomSketch(view, hall_.visitor, picture.width, picture.height).run();
  };
  std::vector<Picture> shown = views_->draw(entry, {hall_.visitor.eye, Quat::Identity()}, paint);
  if (!stereo_ && shown.size() > 1) shown.resize(1);
  return shown;
}

Picture HallPatterns::ofOutput(std::size_t entry, HallPattern pattern, std::optional<Eye> eye,
                               std::uint32_t width, std::uint32_t height) const {
  switch (pattern) {
  case HallPattern::Room: return testPattern(hall_, entry, eye, width, height);
  case HallPattern::Pixels: return pixelPattern(hall_.walls[entry].wall.name, eye, width, height);
  case HallPattern::Blend: return Picture(width, height, 255);
  case HallPattern::Gamma: return gammaPattern(width, height);
  case HallPattern::Bars: return barPattern(width, height);
  }
  return {};
}

std::vector<Picture> HallPatterns::pictures(std::size_t entry, HallPattern pattern, std::uint32_t width,
                                            std::uint32_t height) {
  const WallEntry& e = hall_.walls[entry];
  if (!e.isFlat()) {
    if (pattern == HallPattern::Room || pattern == HallPattern::Blend) return projected(entry, pattern);
    const PixelSize size = e.outputSize();
    width = size.width;
    height = size.height;
  }
  std::vector<Picture> shown;
  for (const Eye eye : kEyes) {
    if (e.projector && e.projector->eye && *e.projector->eye != eye) continue;
    if ((!stereo_ || e.panorama) && !shown.empty()) break;
    shown.push_back(
        ofOutput(entry, pattern, stereo_ && !e.panorama ? std::optional(eye) : std::nullopt, width, height));
  }
  return shown;
}

}  // namespace stadion
