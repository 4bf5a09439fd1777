#include "assets/generator/olympia/olympia.h"
#include "assets/generator/olympia/stadium_shape.h"

namespace stadion::assets {
namespace {

/// A temple with columns at its front, or all around; its front looks -Y.
struct Plan {
  double width, length, column;  ///< [m] of the steps' top; height of the columns
  int front, side;               ///< columns; side 0: none but at the front
};

constexpr Rgb kMarble{0.93, 0.89, 0.80}, kTile{0.74, 0.46, 0.32}, kFrieze{0.25, 0.36, 0.56},
    kBrick{0.62, 0.24, 0.18};

void addPaintedStone(Part& to, const Part& from, Rgb colour) {
  Part part = from;
  paint(part, [&](const Vertex& v) { return mix(0.92, 1.04, noise(0.6 * v.p)) * colour; });
  add(to, part);
}

Part column(double height) {
  const double r = 0.105 * height;
  Part shaft =
      lathe({{r, 0}, {0.97 * r, 0.4 * height}, {0.78 * r, 0.92 * height}, {1.2 * r, 0.97 * height}}, 9);
  add(shaft, box({-1.25 * r, -1.25 * r, 0.965 * height}, {1.25 * r, 1.25 * r, height}));
  return shaft;
}

/// A roof with gables in front and behind.
void addRoof(Part& part, double x, double y, double z, double rise) {
  const double over = 0.04 * y + 0.3;
  const Point ridge0{0, -y, z + rise}, ridge1{0, y, z + rise};
  for (double s : {-1.0, 1.0}) {
    const Point low0{s * (x + over), -y, z}, low1{s * (x + over), y, z};
    std::array<Vertex, 4> slope{Vertex{low0, kTile}, Vertex{low1, kTile}, Vertex{ridge1, kTile},
                                Vertex{ridge0, kTile}};
    if (s < 0) std::swap(slope[1], slope[3]);
    addQuad(part, slope);
    const double end = s * (y - 0.3);
    const Rgb field = mix(kFrieze, kMarble, 0.55);
    const std::array<Vertex, 3> gable{Vertex{{-x, end, z}, field}, Vertex{{x, end, z}, field},
                                      Vertex{{0, end, z + rise - 0.3}, field}};
    const auto first = static_cast<std::uint32_t>(part.vertices.size());
    part.vertices.insert(part.vertices.end(), gable.begin(), gable.end());
    if (s < 0)
      part.triangles.push_back({first, first + 1, first + 2});
    else
      part.triangles.push_back({first + 1, first, first + 2});
  }
}

Part temple(const Plan& plan) {
  Part part;
  const double x = plan.width / 2, y = plan.length / 2, step = 0.045 * plan.column, h = plan.column;
  for (int i = 0; i < 3; ++i) {
    const double out = 0.06 * h * (2 - i);
    addPaintedStone(
        part, box({-x - out, -y - out, i == 0 ? -3 : i * step}, {x + out, y + out, (i + 1) * step}), kMarble);
  }
  const double floor = 3 * step, inset = 0.13 * h;
  const auto stand = [&](double cx, double cy) {
    Part one = column(h);
    paint(one, [](const Vertex&) { return kMarble; });
    add(part, one, {{cx, cy, floor}});
  };
  for (int i = 0; i < plan.front; ++i) {
    const double cx = mix(-x + inset, x - inset, double(i) / (plan.front - 1));
    stand(cx, -y + inset);
    if (plan.side > 0) stand(cx, y - inset);
  }
  for (int i = 1; i + 1 < plan.side; ++i) {
    const double cy = mix(-y + inset, y - inset, double(i) / (plan.side - 1));
    stand(-x + inset, cy), stand(x - inset, cy);
  }
  const double wall = plan.side > 0 ? 0.34 * h : 0.05 * h;
  addPaintedStone(part, box({-x + wall, -y + 0.6 * h, floor}, {x - wall, y - wall, floor + h}),
                  {0.80, 0.74, 0.64});
  addPaintedStone(part, box({-0.12 * h, -y + 0.59 * h, floor}, {0.12 * h, -y + 0.61 * h, floor + 0.7 * h}),
                  {0.20, 0.16, 0.13});
  const double top = floor + h, beam = 0.17 * h;
  addPaintedStone(part, box({-x + 0.03 * h, -y + 0.03 * h, top}, {x - 0.03 * h, y - 0.03 * h, top + beam}),
                  kMarble);
  addPaintedStone(
      part, box({-x + 0.02 * h, -y + 0.02 * h, top + beam}, {x - 0.02 * h, y - 0.02 * h, top + 1.25 * beam}),
      kBrick);
  addPaintedStone(part, box({-x, -y, top + 1.25 * beam}, {x, y, top + 2 * beam}), kFrieze);
  addPaintedStone(
      part,
      box({-x - 0.04 * h, -y - 0.04 * h, top + 2 * beam}, {x + 0.04 * h, y + 0.04 * h, top + 2.25 * beam}),
      kMarble);
  addRoof(part, x, y + 0.04 * h, top + 2.25 * beam, 0.25 * plan.width / 2);
  return part;
}

}  // namespace

Parts temples() {
  Part part;
  part.finish = {"marble", "", 0.9, 0};
  const double plain = groundHeight(kTemple);
  add(part, temple({27.7, 64.1, 10.4, 6, 13}), {{kTemple.x, kTemple.y, plain}, 0.12, {1, 1, 1}});
  // The treasuries stand in a row on a terrace at the foot of the hill and look south.
  for (int i = 0; i < 7; ++i) {
    const Point at{68 + 2.0 * i, 262 + 15.5 * i, 0};
    const double size = 0.85 + 0.1 * ((i * 5) % 4);
    add(part, temple({7.4, 10.5, 4.6, 4, 0}),
        {{at.x, at.y, groundHeight(at) + 0.6}, -kPi / 2 - 0.13, {size, size, size}});
  }
  return {part};
}

}  // namespace stadion::assets
