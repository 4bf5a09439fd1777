#include "assets/generator/olympia/olympia.h"
#include "assets/generator/olympia/stadium_shape.h"

// Crowns are lumps with normals that point away from the middle of the tree, so that the light goes around
// the whole crown.

namespace stadion::assets {
namespace {

struct Foliage {
  Rgb dark, light;
};
constexpr Foliage kPine{{0.36, 0.46, 0.22}, {0.74, 0.82, 0.42}},
    kCypress{{0.28, 0.38, 0.22}, {0.60, 0.70, 0.38}}, kOlive{{0.52, 0.57, 0.42}, {0.96, 0.98, 0.80}};

struct Tree {
  Part crown, trunk;
};

void addLump(Part& crown, Point at, Point size, const Foliage& foliage, Point middle, int divisions,
             Dice& dice) {
  Part lump = sphere(divisions);
  const Point seed{dice.between(0, 90), dice.between(0, 90), 0};
  for (Vertex& v : lump.vertices) {
    const double swell = mix(0.72, 1.25, roughNoise(1.7 * v.p + seed, 2));
    v.colour = mix(foliage.dark, foliage.light,
                   std::clamp(0.45 + 0.4 * v.p.z + 0.5 * (noise(2.5 * v.p + seed) - 0.5), 0.0, 1.0));
    v.p = at + swell * times(size, v.p);
    v.n = normalized(mix(v.n, normalized(v.p - middle), 0.6));
    v.uv = {(v.p.x + 0.6 * v.p.y) / 1.6, (v.p.z + 0.5 * v.p.y) / 1.6};
  }
  add(crown, lump);
}

void addTrunk(Part& trunk, Point from, Point to, double r, int sides) {
  Part stem = limb(from, to, r, 0.6 * r, sides);
  paint(stem, [&](const Vertex& v) { return mix(0.8, 1.1, noise(3 * v.p)) * Rgb{0.48, 0.38, 0.28}; });
  add(trunk, stem);
}

Tree pine(Dice& dice) {
  Tree tree;
  const double height = dice.between(8, 12);
  const Point top{dice.between(-1, 1), dice.between(-1, 1), height}, middle = {top.x, top.y, 0.7 * height};
  addTrunk(tree.trunk, {0, 0, -0.5}, {top.x, top.y, 0.85 * height}, 0.28, 6);
  constexpr int kLumps = 5;
  for (int i = 0; i < kLumps; ++i) {
    const auto [s, c] = det::sincos(2 * kPi * (i + dice.even()) / (kLumps - 1));
    const double r = i == 0 ? 0 : dice.between(1.3, 2.0);
    const Point at =
        middle + Point{r * c, r * s, i == 0 ? 0.16 * height : dice.between(-0.16, 0.08) * height};
    addLump(tree.crown, at, {dice.between(1.6, 2.3), dice.between(1.6, 2.3), dice.between(1.3, 1.9)}, kPine,
            middle, 1, dice);
  }
  return tree;
}

/// A tree far away: two lumps on a stem.
Tree distantPine(Dice& dice) {
  Tree tree;
  const double height = dice.between(7, 11);
  const Point middle{0, 0, 0.6 * height};
  addTrunk(tree.trunk, {0, 0, -0.8}, {0, 0, 0.5 * height}, 0.3, 3);
  addLump(tree.crown, middle, {dice.between(2.4, 3.2), dice.between(2.4, 3.2), dice.between(2.0, 2.8)}, kPine,
          middle, 0, dice);
  addLump(tree.crown, middle + Point{dice.between(-1, 1), dice.between(-1, 1), 1.9}, {1.9, 1.9, 1.7}, kPine,
          middle, 0, dice);
  return tree;
}

Tree cypress(Dice& dice) {
  Tree tree;
  const double height = dice.between(9, 14), r = 0.1 * height;
  const Point seed{dice.between(0, 90), 0, 0};
  Part crown = lathe({{0, 0.05},
                      {0.55, 0.09},
                      {0.85, 0.2},
                      {1.0, 0.36},
                      {0.95, 0.52},
                      {0.78, 0.68},
                      {0.5, 0.83},
                      {0.22, 0.94},
                      {0, 1}},
                     9);
  for (Vertex& v : crown.vertices) {
    const double swell = r * mix(0.75, 1.2, noise(Point{2 * v.p.x, 2 * v.p.y, 9 * v.p.z} + seed));
    const Point out = normalized({v.p.x, v.p.y, 0.3 * (v.p.z - 0.4)});
    v.colour = mix(kCypress.dark, kCypress.light,
                   std::clamp(0.2 + 0.5 * v.p.z + 0.6 * (noise(6 * v.p + seed) - 0.5), 0.0, 1.0));
    v.p = {swell * v.p.x, swell * v.p.y, height * v.p.z};
    v.n = out;
    v.uv = {(v.p.x + 0.6 * v.p.y) / 1.6, (v.p.z + 0.5 * v.p.y) / 1.6};
  }
  tree.crown = crown;
  addTrunk(tree.trunk, {0, 0, -0.5}, {0, 0, 0.12 * height}, 0.2, 5);
  return tree;
}

Tree olive(Dice& dice) {
  Tree tree;
  const double height = dice.between(4, 6);
  const Point middle{0, 0, 0.62 * height};
  const Point fork{dice.between(-0.3, 0.3), dice.between(-0.3, 0.3), 0.3 * height};
  addTrunk(tree.trunk, {0, 0, -0.4}, fork, 0.32, 6);
  for (int i = 0; i < 5; ++i) {
    const auto [s, c] = det::sincos(2 * kPi * (i + 0.6 * dice.even()) / 5);
    const Point at = middle + Point{1.25 * c, 1.25 * s, dice.between(-0.1, 0.16) * height};
    addTrunk(tree.trunk, fork, mix(fork, at, 0.8), 0.15, 4);
    addLump(tree.crown, at, {dice.between(1.0, 1.5), dice.between(1.0, 1.5), dice.between(0.8, 1.2)}, kOlive,
            middle, 1, dice);
  }
  return tree;
}

struct Wood {
  Part crowns, trunks;
  Wood() {
    crowns.finish = {"leaves", "leaves.png", 1, 0};
    trunks.finish = {"bark", "", 1, 0};
  }
  void plant(const Tree& tree, Point at, Dice& dice) {
    const double size = dice.between(0.85, 1.2);
    const Placement place{{at.x, at.y, groundHeight(at)}, dice.between(0, 2 * kPi), {size, size, size}};
    add(crowns, tree.crown, place), add(trunks, tree.trunk, place);
  }
};

Point atAround(double share, double d) {  // a place `d` outside the track
  const std::vector<Point> line = around(d);
  return line[static_cast<std::size_t>(share * kAround) % kAround];
}

}  // namespace

Parts trees() {
  Dice dice(21);
  Wood wood;
  for (int i = 0; i < 54; ++i) {
    const double share = (i + 0.8 * dice.even()) / 54, d = dice.between(36, 58);
    const unsigned kind = dice.roll(6);
    const Point at = atAround(share, d);
    const bool view = std::fabs(at.x - kTunnel.x) < 22 &&
                      at.y > kTrackHigh;  // the way to the passage, and the temple beyond
    const Tree tree = kind < 3 ? olive(dice) : kind < 5 ? cypress(dice) : pine(dice);
    if (!view) wood.plant(tree, at, dice);
  }
  // A few together are more than the same number apart.
  for (const auto& [share, d] : {std::pair(0.04, 37.0),
                                 {0.13, 40.0},
                                 {0.27, 38.0},
                                 {0.47, 39.0},
                                 {0.60, 37.0},
                                 {0.72, 41.0},
                                 {0.83, 38.0}})
    for (int i = 0; i < 3; ++i) {
      const Point at = atAround(share, d) + Point{dice.between(-4, 4), dice.between(-5, 5), 0};
      wood.plant(i == 2 && share < 0.5 ? pine(dice) : cypress(dice), at, dice);
    }
  // Shrubs on the slopes.
  for (int i = 0; i < 200; ++i) {
    const Point at = atAround(dice.even(), dice.between(6, 40)) +
                     Point{dice.between(-1.5, 1.5), dice.between(-1.5, 1.5), 0};
    const double size = dice.between(0.25, 0.6) * (outside(at) > 24 ? 1.6 : 1);
    Tree shrub;
    addLump(shrub.crown, {0, 0, 0.4 * size}, {size, size, 0.7 * size}, dice.roll(3) == 0 ? kPine : kOlive,
            {0, 0, 0}, 0, dice);
    wood.plant(shrub, at, dice);
  }
  return {wood.crowns, wood.trunks};
}

Parts kronosWood() {
  Dice dice(22);
  Wood wood;
  for (int i = 0; i < 480; ++i) {
    const double r = 175 * std::sqrt(dice.even());
    const auto [s, c] = det::sincos(dice.between(0, 2 * kPi));
    const Point at{kKronos.x + r * c, kKronos.y + r * s, 0};
    const Tree tree = distantPine(dice);
    if (outside(at) > 62 && roughNoise(0.02 * at, 2) > mix(0.5, 0.36, r / 175)) wood.plant(tree, at, dice);
  }
  for (int i = 0; i < 90; ++i) {  // groves on the plain
    const auto [s, c] = det::sincos(dice.between(0, 2 * kPi));
    const double r = dice.between(190, 520);
    const Point at{r * c, 96 + 1.1 * r * s, 0};
    const Tree tree = dice.roll(3) == 0 ? cypress(dice) : distantPine(dice);
    if (outside(at) > 60 && length(at - kTemple) > 75) wood.plant(tree, at, dice);
  }
  return {wood.crowns, wood.trunks};
}

}  // namespace stadion::assets
