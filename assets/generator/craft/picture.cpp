#include "assets/generator/craft/picture.h"

#include "assets/generator/craft/geometry.h"

// Lumps of several sizes, and on them strokes and spots.

namespace stadion::assets {
namespace {

constexpr int kSide = 256;  // pixels

class Grey {
public:
  explicit Grey(double level) : level_(kSide * kSide, level) {}
  double& at(int x, int y) {
    return level_[static_cast<std::size_t>((y & (kSide - 1)) * kSide + (x & (kSide - 1)))];
  }

  /// Adds lumps of kSide / cells pixels, up to `strength` up and down.
  void lumps(int cells, double strength, Dice& dice) {
    std::vector<double> corner(static_cast<std::size_t>(cells * cells));
    for (double& c : corner) c = dice.between(-strength, strength);
    const auto of = [&](int i, int j) {
      return corner[static_cast<std::size_t>(j % cells * cells + i % cells)];
    };
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        const double u = double(x) * cells / kSide, v = double(y) * cells / kSide;
        const int i = static_cast<int>(u), j = static_cast<int>(v);
        const double s = smoothstep(0, 1, u - i), t = smoothstep(0, 1, v - j);
        at(x, y) += mix(mix(of(i, j), of(i + 1, j), s), mix(of(i, j + 1), of(i + 1, j + 1), s), t);
      }
    }
  }

  /// A round spot, lit from the upper left.
  void spot(int x, int y, double radius, double strength, double relief) {
    const int reach = static_cast<int>(radius) + 1;
    for (int j = -reach; j <= reach; ++j)
      for (int i = -reach; i <= reach; ++i)
        if (i * i + j * j <= radius * radius) at(x + i, y + j) += strength - relief * (i + j) / radius;
  }

  /// A stroke of `steps` pixels from a dark root to a light tip, replacing what was there.
  void blade(int x, int y, int steps, int dx, int dy, double root, double tip, Dice& dice) {
    for (int k = 0; k < steps; ++k) {
      at(x, y) = mix(root, tip, double(k) / steps);
      if (dy == 0 || dice.roll(3) == 0) x += dx;
      y += dy;
    }
  }

  std::string file() const {
    std::string rows;
    for (int y = 0; y < kSide; ++y) {
      rows.push_back(0);
      for (int x = 0; x < kSide; ++x) {
        const double v = std::clamp(level_[static_cast<std::size_t>(y * kSide + x)], 0.0, 1.0);
        rows.push_back(static_cast<char>(static_cast<int>(v * 255 + 0.5)));
      }
    }
    return png(kSide, kSide, {8, PngColour::Grey}, "", rows);
  }

private:
  std::vector<double> level_;
};

int pixel(Dice& dice) {
  return static_cast<int>(dice.roll(kSide));
}

}  // namespace

std::string earthPicture() {
  Dice dice(1);
  Grey grey(0.87);
  grey.lumps(4, 0.03, dice), grey.lumps(16, 0.03, dice), grey.lumps(64, 0.04, dice),
      grey.lumps(256, 0.06, dice);
  for (int i = 0; i < 900; ++i)
    grey.spot(pixel(dice), pixel(dice), dice.between(0.7, 2.0), dice.between(-0.1, 0.05), 0.05);
  for (int i = 0; i < 60; ++i)
    grey.spot(pixel(dice), pixel(dice), dice.between(2.0, 3.6), dice.between(-0.05, 0.06), 0.1);
  return grey.file();
}

std::string meadowPicture() {
  Dice dice(2);
  Grey grey(0.62);
  grey.lumps(32, 0.1, dice);
  for (int i = 0; i < 13000; ++i) {
    const double light = dice.between(0.6, 1.02);
    const int lean = static_cast<int>(dice.roll(3)) - 1, x = pixel(dice), y = pixel(dice);
    grey.blade(x, y, 4 + static_cast<int>(dice.roll(8)), lean, -1, light - 0.28, light, dice);
  }
  grey.lumps(4, 0.05, dice), grey.lumps(8, 0.05, dice);
  return grey.file();
}

std::string stonePicture() {
  Dice dice(3);
  Grey grey(0.88);
  grey.lumps(4, 0.05, dice), grey.lumps(8, 0.05, dice), grey.lumps(32, 0.04, dice),
      grey.lumps(128, 0.05, dice);
  for (int i = 0; i < 500; ++i)
    grey.spot(pixel(dice), pixel(dice), dice.between(0.7, 2.2), dice.between(-0.22, -0.04), -0.05);
  return grey.file();
}

std::string leavesPicture() {
  Dice dice(4);
  Grey grey(0.45);
  grey.lumps(16, 0.1, dice);
  for (int i = 0; i < 5200; ++i) {
    const double light = dice.between(0.5, 1.0);
    const int dx = dice.roll(2) == 0 ? -1 : 1, dy = static_cast<int>(dice.roll(3)) - 1;
    const int x = pixel(dice), y = pixel(dice), steps = 3 + static_cast<int>(dice.roll(6));
    grey.blade(x, y, steps, dx, dy, light - 0.2, light, dice);
    grey.blade(x, y + 1, steps - 1, dx, dy, light - 0.25, light - 0.1, dice);
  }
  grey.lumps(8, 0.1, dice);
  return grey.file();
}

}  // namespace stadion::assets
