#include "assets/generator/olympia/olympia.h"
#include "assets/generator/olympia/person.h"
#include "assets/generator/olympia/stadium_shape.h"

namespace stadion::assets {
namespace {

constexpr double kLength = 13, kDepth = 5, kFloor = 0.9;  // [m] of the judges' stand
constexpr int kChairs = 10;

void addStone(Part& to, Point low, Point high, double yaw = 0, Point at = {0, 0, 0}) {
  Part stone = box(low, high);
  for (Vertex& v : stone.vertices) v.colour = stoneColour(v.p + 3.0 * low + at);
  add(to, stone, {at, yaw, {1, 1, 1}});
}

void addWood(Part& to, Part from, Rgb colour) {
  paint(from, [&](const Vertex& v) { return mix(0.9, 1.05, noise(2 * v.p)) * colour; });
  add(to, from);
}

/// The stand in its own frame: the front is x = 0, it looks along +X.
struct Stand {
  Part stone, wood, people;
};

Stand judgesStand() {
  Stand made;
  const double y = kLength / 2;
  addStone(made.stone, {-kDepth, -y, -0.3}, {0, y, kFloor});
  addStone(made.stone, {0, -y + 2, -0.3}, {0.5, y - 2, 0.6});
  addStone(made.stone, {0.5, -y + 2, -0.3}, {1.0, y - 2, 0.3});
  addStone(made.stone, {-kDepth, -y, kFloor}, {-kDepth + 0.4, y, kFloor + 1.0});
  for (double s : {-1.0, 1.0})
    addStone(made.stone, {-kDepth, std::min(s * y, s * (y - 0.4)), kFloor},
             {-0.3, std::max(s * y, s * (y - 0.4)), kFloor + 0.7});
  Dice dice(31);
  for (int i = 0; i < kChairs; ++i) {
    const double cy = mix(-y + 1.4, y - 1.4, double(i) / (kChairs - 1));
    addStone(made.stone, {-2.5, cy - 0.35, kFloor}, {-1.9, cy + 0.35, kFloor + 0.42});
    addStone(made.stone, {-2.65, cy - 0.35, kFloor}, {-2.5, cy + 0.35, kFloor + 1.0});
    Person judge = somebody(dice, false);
    judge.cloth = {0.48, 0.16, 0.26}, judge.hat = false, judge.beard = true, judge.raised = 0;  // in purple
    add(made.people, figure(judge, Detail::Near),
        {{-2.2, cy, kFloor + 0.36}, -kPi / 2 + dice.between(-0.3, 0.3), {1, 1, 1}});
  }
  // An awning against the sun.
  for (double s : {-1.0, 0.0, 1.0}) {
    addWood(made.wood,
            limb({-0.6, s * (y - 0.6), kFloor}, {-0.6, s * (y - 0.6), kFloor + 2.7}, 0.06, 0.05, 6),
            {0.50, 0.36, 0.24});
    addWood(made.wood,
            limb({-kDepth + 0.7, s * (y - 0.6), kFloor}, {-kDepth + 0.7, s * (y - 0.6), kFloor + 3.3}, 0.06,
                 0.05, 6),
            {0.50, 0.36, 0.24});
  }
  constexpr int kStripes = 16;
  for (int i = 0; i < kStripes; ++i) {
    const double a = mix(-y, y, double(i) / kStripes), b = mix(-y, y, double(i + 1) / kStripes);
    const Rgb colour = i % 2 == 0 ? Rgb{0.90, 0.84, 0.72} : Rgb{0.66, 0.24, 0.18};
    // Cloth of some thickness, so that it is seen from below too; it sags between front and back.
    const double x[] = {-0.1, -1.9, -3.5, -kDepth + 0.3}, z[] = {2.55, 2.66, 2.90, 3.35};
    for (int k = 0; k < 3; ++k) {
      const Point p{x[k], a, kFloor + z[k]}, q{x[k], b, kFloor + z[k]}, r{x[k + 1], b, kFloor + z[k + 1]},
          t{x[k + 1], a, kFloor + z[k + 1]};
      const Point down{0, 0, -0.02};
      addQuad(made.wood, {Vertex{p, colour}, Vertex{q, colour}, Vertex{r, colour}, Vertex{t, colour}});
      addQuad(made.wood, {Vertex{t + down, 0.8 * colour}, Vertex{r + down, 0.8 * colour},
                          Vertex{q + down, 0.8 * colour}, Vertex{p + down, 0.8 * colour}});
      if (k == 0)
        addQuad(made.wood, {Vertex{p + 15 * down, colour}, Vertex{q + 15 * down, colour}, Vertex{q, colour},
                            Vertex{p, colour}});
    }
  }
  return made;
}

/// A block with a base and a cornice, and steps before it.
void addAltar(Part& stone) {
  addStone(stone, {-1.5, -1.9, -0.3}, {1.5, 1.9, 0.25}, 0, kAltar);
  addStone(stone, {-1.1, -1.5, 0.25}, {1.1, 1.5, 0.45}, 0, kAltar);
  addStone(stone, {-0.9, -1.3, 0.45}, {0.9, 1.3, 1.35}, 0, kAltar);
  addStone(stone, {-1.0, -1.4, 1.35}, {1.0, 1.4, 1.55}, 0, kAltar);
}

/// A ridge of cloth over two poles, open in front.
void addTent(Part& cloth, Point at, double yaw, Dice& dice) {
  const double w = dice.between(1.3, 1.9), l = dice.between(1.6, 2.4), h = dice.between(1.9, 2.5);
  const Rgb light{0.88, 0.82, 0.70},
      other = dice.roll(2) == 0 ? Rgb{0.72, 0.42, 0.28} : Rgb{0.80, 0.70, 0.50};
  Part tent;
  constexpr int kBreadths = 6;
  for (int i = 0; i < kBreadths; ++i) {
    const double a = mix(-l, l, double(i) / kBreadths), b = mix(-l, l, double(i + 1) / kBreadths);
    const Rgb c = i % 2 == 0 ? light : other;
    for (double s : {-1.0, 1.0}) {
      std::array<Vertex, 4> side{Vertex{{s * w, a, -0.3}, c}, Vertex{{s * w, b, -0.3}, c},
                                 Vertex{{0, b, h}, c}, Vertex{{0, a, h}, c}};
      if (s < 0) std::swap(side[1], side[3]);
      addQuad(tent, side);
      std::array<Vertex, 4> lining = side;
      std::swap(lining[1], lining[3]);
      for (Vertex& v : lining) v.colour = 0.55 * v.colour, v.p.x *= 0.985;
      addQuad(tent, lining);
    }
  }
  const Rgb inside{0.34, 0.28, 0.22};
  const auto first = static_cast<std::uint32_t>(tent.vertices.size());
  for (const Point p : {Point{-w, 0.8 * l, -0.3}, Point{0, 0.8 * l, h}, Point{w, 0.8 * l, -0.3}})
    tent.vertices.push_back({p, inside});
  tent.triangles.push_back({first, first + 1, first + 2}),
      tent.triangles.push_back({first, first + 2, first + 1});
  add(cloth, tent, {at, yaw, {1, 1, 1}});
}

}  // namespace

Parts stands() {
  Stand stand = judgesStand();
  Part stone, wood, people;
  stone.finish = {"limestone", "stone.png", 0.9, 0};
  wood.finish = {"wood and cloth", "", 0.95, 0};
  people.finish = {"people", "", 0.95, 0};
  add(stone, stand.stone, {kStand}), add(wood, stand.wood, {kStand}), add(people, stand.people, {kStand});
  addAltar(stone);
  Person priestess;  // of Demeter, the only married woman allowed to watch
  priestess.standing = true, priestess.cloth = {0.95, 0.93, 0.88}, priestess.skin = {0.86, 0.66, 0.52},
  priestess.hair = {0.24, 0.16, 0.10};
  add(people, figure(priestess, Detail::Near),
      {kAltar + Point{0.2, -2.6, 0}, kPi / 2 + 0.5, {0.95, 0.95, 0.95}});
  Dice dice(32);
  for (int i = 0; i < 12; ++i) {
    const double side = i % 2 == 0 ? -1 : 1;
    Point at{side * (kTrackSide + dice.between(30, 34)), dice.between(5, 195), 0};
    at.z = groundHeight(at);
    addTent(wood, at, side * kPi / 2 + dice.between(-0.4, 0.4), dice);
  }
  layPicture(stone, 2);
  return {stone, wood, people};
}

Parts passage() {
  // The mouth of the vault: a wall with an arch, and behind it the dark.
  constexpr double kHalf = 1.85, kSpring = 2.0, kWall = 5.2, kTop = 4.9, kDeep = 12;
  constexpr int kSteps = 10;
  Part stone, shade;
  stone.finish = {"limestone", "stone.png", 0.9, 0}, shade.finish = {"shade", "", 1, 0};
  std::vector<Point> arch{{kHalf, 0, 0}};
  for (int i = 0; i <= kSteps; ++i) {
    const auto [s, c] = det::sincos(kPi * i / kSteps);
    arch.push_back({kHalf * c, 0, kSpring + kHalf * s});
  }
  arch.push_back({-kHalf, 0, 0});
  for (std::size_t i = 0; i + 1 < arch.size(); ++i) {
    const Point a = arch[i], b = arch[i + 1], in{0, kDeep, 0};
    // The lining gets darker inwards; the wall reaches from the arch up to its top, or to its ends.
    const auto wall = [&](Point p) {
      return Point{i == 0                 ? kWall
                   : i + 2 == arch.size() ? -kWall
                                          : p.x * kWall / kHalf,
                   0, i == 0 || i + 2 == arch.size() ? p.z : kTop};
    };
    addQuad(stone, {Vertex{a, 0.75 * stoneColour(a)}, Vertex{b, 0.75 * stoneColour(b)},
                    Vertex{b + in, {0.12, 0.11, 0.10}}, Vertex{a + in, {0.12, 0.11, 0.10}}});
    addQuad(stone, {Vertex{wall(a), stoneColour(wall(a))}, Vertex{wall(b), stoneColour(wall(b))},
                    Vertex{b, stoneColour(b)}, Vertex{a, stoneColour(a)}});
  }
  for (double s : {-1.0, 1.0}) {  // between the springing and the top at the ends
    std::array<Point, 3> corner{{{s * kHalf, 0, kSpring}, {s * kWall, 0, kSpring}, {s * kWall, 0, kTop}}};
    if (s < 0) std::swap(corner[1], corner[2]);
    const auto first = static_cast<std::uint32_t>(stone.vertices.size());
    for (const Point& p : corner) stone.vertices.push_back({p, stoneColour(p)});
    stone.triangles.push_back({first, first + 1, first + 2});
  }
  addStone(stone, {-kWall - 0.3, -0.2, kTop}, {kWall + 0.3, kDeep + 4, kTop + 0.35});
  for (double s : {-1.0, 1.0})
    addStone(stone, {std::min(s * kWall, s * (kWall + 0.6)), -2.2, -0.3},
             {std::max(s * kWall, s * (kWall + 0.6)), kDeep + 4, kTop});
  Part end = box({-kHalf - 0.5, kDeep - 0.3, 0}, {kHalf + 0.5, kDeep, kTop - 0.5});
  paint(end, [](const Vertex&) { return Rgb{0.10, 0.09, 0.08}; });
  add(shade, end, {kTunnel});
  Part floor = grid({-kHalf - 0.1, -3}, {kHalf + 0.1, kDeep}, 1, 4);
  paint(floor, [](const Vertex& v) {
    return mix(1.0, 0.25, smoothstep(-1, 8, v.p.y)) * Rgb{0.84, 0.72, 0.52};
  });
  add(shade, floor, {kTunnel + Point{0, 0, 0.07}});
  Part placed;
  placed.finish = stone.finish;
  add(placed, stone, {kTunnel});
  layPicture(placed, 2);
  return {placed, shade};
}

}  // namespace stadion::assets
