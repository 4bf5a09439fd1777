#pragma once
/// A drawing without errors of its own but 8-bit values: for each pixel of an output it paints exactly the
/// direction that the pixel shows.

#include "engine/maths/srgb.h"
#include "show/simulation/simulated_hall.h"

#include <algorithm>

namespace stadion::test {

class IdealPictures : public PictureSource {
public:
  /// `blends` lets projectors that light the same point share its light evenly.
  explicit IdealPictures(const WallFile& hall, bool blends = true) : hall_(hall, 1 << 20), blends_(blends) {}

  std::vector<Picture> draw(std::size_t entry, const Pose& X_RH, const Painter& paint) override {
    std::vector<Picture> all;
    for (const Eye eye : kEyes)
      if (hall_.serves(entry, eye)) all.push_back(drawFor(entry, X_RH, eye, paint));
    return all;
  }

private:
  Picture drawFor(std::size_t entry, const Pose& X_RH, Eye eye, const Painter& paint) const {
    const SimulatedProjector& p = hall_.projector(entry);
    Picture picture(p.width(), p.height(), 0);
    const Vec3 from = eyePosition(X_RH, eye, hall_.file().eyeSeparation);
    for (std::uint32_t y = 0; y < p.height(); ++y)
      for (std::uint32_t x = 0; x < p.width(); ++x) {
        const auto point = p.pointAt(x + 0.5, y + 0.5);
        if (!point) continue;
        Picture one(1, 1);
        paint({through(from, *point), from}, one);
        const auto screen = hall_.file().walls[entry].projector->screen;
        const double share =
            blends_ ? 1.0 / static_cast<double>(hall_.lightAt(screen, *point, eye).size()) : 1;
        for (std::size_t c = 0; c < 3; ++c)
          picture.at(x, y)[c] = valueFor(
              p, c, share * linearFromSrgb(one.rgba[c] / 255.0) * hall_.white()[static_cast<int>(c)]);
      }
    return picture;
  }

  /// A view whose one pixel looks at the point.
  static Mat4 through(const Vec3& eye, const Vec3& point) {
    const Vec3 w = (point - eye).normalized(), x = w.unitOrthogonal(), y = w.cross(x);
    Mat4 m = Mat4::Zero();
    m.row(0) << x.transpose(), -x.dot(eye);
    m.row(1) << y.transpose(), -y.dot(eye);
    m.row(3) << w.transpose(), -w.dot(eye);
    return m;
  }

  static std::uint8_t valueFor(const SimulatedProjector& p, std::size_t channel, double light) {
    int best = 0, above = 255;  // light grows with values
    while (above - best > 1) {
      const int middle = (best + above) / 2;
      (p.light(static_cast<std::uint8_t>(middle), channel) <= light ? best : above) = middle;
    }
    if (p.light(static_cast<std::uint8_t>(above), channel) - light <
        light - p.light(static_cast<std::uint8_t>(best), channel))
      best = above;
    return static_cast<std::uint8_t>(best);
  }

  SimulatedHall hall_;
  bool blends_;
};

}  // namespace stadion::test
