#include "assets/generator/olympia/earth.h"
#include "assets/generator/olympia/olympia.h"
#include "assets/generator/olympia/stadium_shape.h"

namespace stadion::assets {
namespace {

constexpr double kSillHalf = 14.3, kSillDepth = 0.48, kSillTop = 0.025;  // [m]
constexpr int kPlaces = 20;                                              // of runners on a sill
constexpr double kBasinEvery = 24;                                       // [m]

/// Across the channel: two kerbs and what is hollowed out between them.
const std::vector<Turning> kKerbs{{0.02, -0.05}, {0.02, 0.10}, {0.15, 0.10}, {0.17, 0.0},
                                  {0.43, 0.0},   {0.45, 0.10}, {0.60, 0.10}, {0.60, -0.05}};

/// A row of blocks with two grooves for the runners' toes and sockets for the posts between them.
Part sill(double y) {
  struct Strip {
    double from, to, below;
  };
  constexpr Strip kStrips[] = {{-kSillDepth / 2, -0.12, 0},
                               {-0.12, -0.08, 0.02},
                               {-0.08, 0.08, 0},
                               {0.08, 0.12, 0.02},
                               {0.12, kSillDepth / 2, 0}};
  Part part;
  const double block = 2 * kSillHalf / kPlaces;
  for (int i = 0; i < kPlaces; ++i) {
    const double x = -kSillHalf + i * block;
    for (const Strip& s : kStrips) {
      Part stone = box({x + 0.006, y + s.from, -0.2}, {x + block - 0.006, y + s.to, kSillTop - s.below});
      paint(stone, [&](const Vertex& v) {
        return (s.below > 0 ? 0.62 : 1.0) * stoneColour(v.p + Point{3.7 * i, 0, 0});
      });
      add(part, stone);
    }
    Part socket = box({x - 0.05, y - 0.05, -0.1}, {x + 0.05, y + 0.05, kSillTop + 0.003});
    paint(socket, [](const Vertex&) { return Rgb{0.22, 0.19, 0.15}; });
    if (i > 0) add(part, socket);
  }
  return part;
}

struct Channel {
  Part stone, water;
};

/// Blocks hollowed out, all around the track, and basins to drink from.
Channel channel() {
  Channel made;
  made.stone = ring(kKerbs);
  made.water = ring({{0.16, 0.055}, {0.44, 0.055}});
  for (double y = kTrackLow + 11; y < kTrackHigh - 5; y += kBasinEvery) {
    for (double side : {-1.0, 1.0}) {
      const double x = side * (kTrackSide + 0.62);
      add(made.stone, box({x - 0.42, y - 0.6, -0.05}, {x + 0.42, y - 0.45, 0.22}));
      add(made.stone, box({x - 0.42, y + 0.45, -0.05}, {x + 0.42, y + 0.6, 0.22}));
      add(made.stone, box({x - 0.42, y - 0.45, -0.05}, {x - 0.28, y + 0.45, 0.22}));
      add(made.stone, box({x + 0.28, y - 0.45, -0.05}, {x + 0.42, y + 0.45, 0.22}));
      Part surface = grid({-0.28, -0.45}, {0.28, 0.45}, 1, 1);
      add(made.water, surface, {{x, y, 0.16}, 0, {1, 1, 1}});
    }
  }
  paint(made.stone, [](const Vertex& v) { return stoneColour(v.p); });
  paint(made.water, [](const Vertex& v) {
    return mix(Rgb{0.30, 0.40, 0.40}, Rgb{0.42, 0.52, 0.52}, noise(0.7 * v.p));
  });
  return made;
}

}  // namespace

Rgb stoneColour(Point p) {
  return mix(0.88, 1.06, roughNoise(0.9 * p, 3)) *
         mix(Rgb{0.90, 0.85, 0.74}, Rgb{0.79, 0.75, 0.66}, noise(0.35 * p));
}

Parts track() {
  Parts parts = trackEarth();
  auto [stone, water] = channel();
  add(stone, sill(0)), add(stone, sill(kTrackLength));
  stone.finish = {"limestone", "stone.png", 0.9, 0};
  layPicture(stone, 2);
  water.finish = {"water", "", 0.12, 0};
  parts.push_back(stone), parts.push_back(water);
  return parts;
}

Parts stonework() {
  Part stone = ring(kKerbs);
  for (const double y : {0.0, kTrackLength})
    add(stone, box({-kSillHalf, y - kSillDepth / 2, -0.2}, {kSillHalf, y + kSillDepth / 2, kSillTop}));
  stone.finish = {"limestone", "", 0.9, 0};
  paint(stone, [](const Vertex& v) { return stoneColour(v.p); });
  return {stone};
}

}  // namespace stadion::assets
