#include "assets/generator/olympia/person.h"

namespace stadion::assets {
namespace {

constexpr Rgb kCloths[] = {{0.93, 0.90, 0.83}, {0.90, 0.86, 0.76}, {0.94, 0.92, 0.88}, {0.88, 0.82, 0.70},
                           {0.86, 0.84, 0.80}, {0.80, 0.62, 0.36}, {0.70, 0.36, 0.24}, {0.62, 0.26, 0.24},
                           {0.36, 0.42, 0.56}, {0.50, 0.52, 0.34}, {0.76, 0.54, 0.40}, {0.46, 0.34, 0.42}};
constexpr Rgb kSkins[] = {{0.84, 0.62, 0.46}, {0.76, 0.54, 0.38}, {0.68, 0.46, 0.32}, {0.80, 0.58, 0.44}};
constexpr Rgb kHairs[] = {{0.20, 0.14, 0.10}, {0.28, 0.19, 0.12}, {0.14, 0.11, 0.09}, {0.62, 0.58, 0.54}};

template <std::size_t N>
Rgb oneOf(const Rgb (&colours)[N], Dice& dice) {
  return colours[dice.roll(N)];
}

/// Folds: every other side of the cloth is in shade, and so is what lies low.
void drape(Part& part, Rgb cloth, double top) {
  for (std::size_t i = 0; i < part.vertices.size(); ++i) {
    Vertex& v = part.vertices[i];
    v.colour = (i % 2 == 0 ? 0.84 : 1.04) * mix(0.78, 1.0, smoothstep(0, top, v.p.z)) * cloth;
  }
}

void addHead(Part& body, const Person& person, Point at, Detail detail) {
  Part head = detail == Detail::Far ? lathe({{0, -0.9}, {0.9, 0.05}, {0, 1}}, 4)
              : detail == Detail::Middle
                  ? lathe({{0, -1}, {0.8, -0.45}, {0.9, 0.35}, {0, 1}}, 6)
                  : lathe({{0, -1}, {0.72, -0.6}, {0.95, 0.1}, {0.8, 0.62}, {0, 1}}, 7);
  for (Vertex& v : head.vertices) {
    v.n = {0, 0, 0};
    const bool face = v.p.y > 0.15 && v.p.z < 0.45;
    const bool beard = person.beard && v.p.z < -0.35 && v.p.y > -0.2;
    v.colour = (face && !beard) || (v.p.z < -0.6 && !beard) || (detail == Detail::Far && v.p.z < 0.5)
                   ? person.skin
                   : person.hair;
  }
  add(body, head, {at, 0, {0.085, 0.105, 0.13}});
  if (person.hat && detail != Detail::Far) {
    Part hat = lathe({{0.19, -0.01}, {0.1, 0.035}, {0.07, 0.09}, {0, 0.10}}, detail == Detail::Near ? 10 : 6);
    paint(hat, [](const Vertex&) { return Rgb{0.80, 0.68, 0.42}; });
    add(body, hat, {at + Point{0, 0, 0.05}});
  }
}

void addArms(Part& body, const Person& person, double shoulder, Detail detail) {
  constexpr int sides = 3;
  for (int k = 0; k < 2; ++k) {
    const double side = k == 0 ? 1 : -1;
    const Point from{side * 0.2, 0, shoulder - 0.04};
    const bool up = k < person.raised;
    const Point elbow = from + (up ? Point{side * 0.14, 0.1, 0.2} : Point{side * 0.08, 0.06, -0.25});
    const Point hand = elbow + (up ? Point{side * 0.02, 0.08, 0.26} : Point{-side * 0.12, 0.24, -0.02});
    if (detail == Detail::Middle && !up && k == 1) continue;
    Part arm = limb(from, elbow, 0.055, 0.042, sides);
    add(arm, limb(elbow, hand, 0.042, 0.034, sides));
    paint(arm, [&](const Vertex&) { return person.skin; });
    add(body, arm);
  }
}

}  // namespace

Person somebody(Dice& dice, bool standing) {
  Person person;
  person.standing = standing;
  person.cloth = mix(0.9, 1.04, dice.even()) * oneOf(kCloths, dice);
  person.skin = oneOf(kSkins, dice), person.hair = oneOf(kHairs, dice);
  person.hat = dice.roll(6) == 0, person.beard = dice.roll(2) == 0;
  const unsigned mood = dice.roll(10);
  person.raised = mood == 0 ? 2 : mood < 3 ? 1 : 0;
  person.turn = dice.even();
  return person;
}

Part figure(const Person& person, Detail detail) {
  const int sides = detail == Detail::Near ? 8 : detail == Detail::Middle ? 6 : 4;
  Part body;
  const double hip = person.standing ? 0.88 : 0.1, shoulder = hip + 0.56;
  if (person.standing) {
    Part robe = detail == Detail::Far ? loft({{{0, 0, 0}, 0.19, 0.16},
                                              {{0, 0, shoulder - 0.06}, 0.22, 0.14},
                                              {{0, 0, shoulder + 0.07}, 0.06, 0.05}},
                                             sides)
                                      : loft({{{0, 0, 0.02}, 0.22, 0.19},
                                              {{0, 0, hip}, 0.17, 0.13},
                                              {{0, 0.02, hip + 0.34}, 0.21, 0.145},
                                              {{0, 0, shoulder - 0.03}, 0.225, 0.12},
                                              {{0, 0, shoulder + 0.05}, 0.08, 0.07}},
                                             sides);
    drape(robe, person.cloth, 1.2);
    add(body, robe);
  } else {
    Part lap =
        detail == Detail::Far
            ? loft({{{0, 0.2, 0}, 0.24, 0.38}, {{0, 0.36, 0.42}, 0.16, 0.1}}, sides)
            : loft({{{0, 0.2, 0}, 0.24, 0.38}, {{0, 0.3, 0.3}, 0.2, 0.24}, {{0, 0.38, 0.42}, 0.15, 0.09}},
                   sides);
    Part chest = detail == Detail::Far ? loft({{{0, -0.02, 0.02}, 0.18, 0.16},
                                               {{0, 0, shoulder - 0.06}, 0.21, 0.13},
                                               {{0, 0, shoulder + 0.07}, 0.06, 0.05}},
                                              sides)
                                       : loft({{{0, -0.02, 0.02}, 0.2, 0.18},
                                               {{0, 0, hip + 0.34}, 0.19, 0.14},
                                               {{0, 0, shoulder - 0.03}, 0.22, 0.12},
                                               {{0, 0, shoulder + 0.05}, 0.08, 0.07}},
                                              sides);
    drape(lap, 0.95 * person.cloth, 0.4), drape(chest, person.cloth, 0.6);
    add(body, lap), add(body, chest);
  }
  // Removes the undersides, which are never seen.
  std::erase_if(body.triangles, [&](const auto& t) {
    return std::all_of(t.begin(), t.end(), [&](std::uint32_t c) { return body.vertices[c].p.z < 0.03; });
  });
  addHead(body, person, {0, 0.02, shoulder + 0.19}, detail);
  if (detail != Detail::Far) addArms(body, person, shoulder, detail);
  return body;
}

}  // namespace stadion::assets
