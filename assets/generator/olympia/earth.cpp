#include "assets/generator/olympia/earth.h"

#include "assets/generator/olympia/stadium_shape.h"

namespace stadion::assets {
namespace {

constexpr double kPicture = 3;  // [m] a width of earth.png
constexpr double kEdge = 0.02;  // [m] so far under the channel's kerb
constexpr double kX = -kTrackSide - kEdge, kY = kTrackLow - kEdge;
constexpr int kColumns = 40, kFineRows = 40, kRows = 92;  // of cells
constexpr double kCell = -2 * kX / kColumns, kFine = 0.6,
                 kCoarse = (kTrackHigh + kEdge - kY - kFineRows * kFine) / kRows;
constexpr double kGames[] = {-7, 0, 7};             // x of the places from which is thrown
constexpr double kToSunX = -0.78, kToSunY = -0.62;  // on the ground

Rgb earthColour(Point p) {
  const double large = roughNoise(0.12 * p, 3), small = roughNoise(1.1 * p, 2);
  const Rgb light{0.96, 0.84, 0.63}, dark{0.80, 0.65, 0.44};
  // Trodden along the middle, and most where people stand before they throw.
  double trodden = 0.25 * smoothstep(15, 9, std::fabs(p.x));
  for (double x : kGames) trodden += 0.5 * smoothstep(2.6, 0.8, length({p.x - x, 0.7 * (p.y + 2.6), 0}));
  return mix(0.91, 1.05, small) *
         mix(dark, light, std::clamp(trodden + smoothstep(0.3, 0.7, large), 0.0, 1.0));
}

/// The colour of the ground's triangles there, in the fine part: what lies on it can end without an edge.
Rgb groundAt(Point p) {
  const double x = std::clamp((p.x - kX) / kCell, 0.0, kColumns - 1e-9);
  const double y = std::clamp((p.y - kY) / kFine, 0.0, kFineRows - 1e-9);
  const double i = std::floor(x), j = std::floor(y), u = x - i, v = y - j;
  const auto node = [&](double a, double b) {
    return earthColour({kX + (i + a) * kCell, kY + (j + b) * kFine, 0});
  };
  const Rgb a = node(0, 0), c = node(1, 1);
  if (u >= v) return a + u * (node(1, 0) - a) + v * (c - node(1, 0));
  return a + v * (node(0, 1) - a) + u * (c - node(0, 1));
}

Vertex onGround(Point p, double height, double shade) {
  return {{p.x, p.y, height}, shade * groundAt(p), {p.x / kPicture, p.y / kPicture}, {0, 0, 1}};
}

Part ground() {
  Part earth = grid({0, 0}, {1, 1}, kColumns, kFineRows + kRows);
  for (std::size_t i = 0; i < earth.vertices.size(); ++i) {
    const auto column = static_cast<double>(i % (kColumns + 1)),
               row = static_cast<double>(i / (kColumns + 1));
    const double coarse = std::max(row - kFineRows, 0.0);
    const Point p{kX + column * kCell, kY + (row - coarse) * kFine + coarse * kCoarse, 0};
    earth.vertices[i] = {p, earthColour(p), {p.x / kPicture, p.y / kPicture}, {0, 0, 1}};
  }
  return earth;
}

/// A dent: dark in the middle and on the side towards the sun, light on the other, and at its rim as the
/// ground.
void addDent(Part& to, Point at, double yaw, double rx, double ry) {
  constexpr int kSides = 7;
  constexpr double kHeight = 0.004;
  const auto first = static_cast<std::uint32_t>(to.vertices.size());
  to.vertices.push_back(onGround(at, kHeight, 0.85));
  for (const double ring : {0.74, 1.15})
    for (int i = 0; i < kSides; ++i) {
      const auto [s, c] = det::sincos(2 * kPi * i / kSides);
      const Point out = turned({ring * rx * c, ring * ry * s, 0}, yaw);
      const Point way = normalized(turned({c, s, 0}, yaw));
      const double sun = way.x * kToSunX + way.y * kToSunY;
      to.vertices.push_back(onGround(at + out, kHeight, ring < 1 ? 0.90 - 0.12 * sun : 1));
    }
  for (std::uint32_t i = 0; i < kSides; ++i) {
    const std::uint32_t j = (i + 1) % kSides;
    to.triangles.push_back({first, first + 1 + i, first + 1 + j});
    const std::uint32_t in = first + 1, out = in + kSides;
    to.triangles.push_back({in + i, out + i, out + j}), to.triangles.push_back({in + i, out + j, in + j});
  }
}

/// A bare foot's print: heel, the outer edge, and ball.
void addPrint(Part& to, Point at, double yaw, double side) {
  addDent(to, at + turned({0.006 * side, -0.085, 0}, yaw), yaw, 0.034, 0.042);
  addDent(to, at + turned({0.022 * side, -0.01, 0}, yaw), yaw, 0.022, 0.055);
  addDent(to, at + turned({0, 0.065, 0}, yaw), yaw, 0.046, 0.044);
}

void addWalk(Part& to, Point from, Point end, Dice& dice) {
  const Point way = normalized(end - from);
  const double far = length(end - from), yaw = det::atan2(-way.x, way.y), sway = dice.between(-0.5, 0.5);
  double side = 1;
  for (double s = dice.between(0, 0.5); s < far; s += dice.between(0.60, 0.72)) {
    const double off = 0.085 * side + sway * det::sin(kPi * s / far);
    addPrint(to, from + s * way + turned({off, 0, 0}, yaw), yaw - 0.12 * side + dice.between(-0.08, 0.08),
             side);
    side = -side;
  }
}

/// Earlier visitors went from the entrance to a game, from game to game, and after the objects that they had
/// thrown.
void addWalks(Part& to) {
  Dice dice(51);
  for (int i = 0; i < 3; ++i)
    for (const double x : kGames)
      addWalk(to, {0.5 * x + dice.between(-2, 2), kTrackLow + 0.6, 0}, {x + dice.between(-0.9, 0.9), -2.4, 0},
              dice);
  for (int i = 0; i < 2; ++i)
    for (const double x : {-7.0, 0.0}) {
      const double y = dice.between(-3.6, -2.6);
      addWalk(to, {x + 0.8, y, 0}, {x + 6.4, y + dice.between(-0.5, 0.5), 0}, dice);
    }
  for (const double x : kGames)
    for (int i = 0; i < 2; ++i)
      addWalk(to, {x + dice.between(-1, 1), 0.5, 0}, {x + dice.between(-2, 2), 9, 0}, dice);
  for (const double x : kGames)  // a waiting visitor steps from foot to foot
    for (int i = 0; i < 12; ++i)
      addPrint(to, {x + dice.between(-1, 1), dice.between(-3.9, -1.8), 0}, dice.between(-0.6, 0.6),
               i % 2 ? 1 : -1);
}

/// A line of lime, worn off in places.
void addLine(Part& to, Point from, Point end, double width) {
  const Point way = normalized(end - from), across = 0.5 * width * Point{-way.y, way.x, 0};
  const int steps = std::max(2, static_cast<int>(length(end - from) / 0.22));
  const auto first = static_cast<std::uint32_t>(to.vertices.size());
  for (int i = 0; i <= steps; ++i) {
    const Point p = mix(from, end, double(i) / steps);
    const double ends = std::min({1.0, double(i), double(steps - i)});
    const double left = ends * smoothstep(0.30, 0.55, roughNoise(1.7 * p + Point{0, 0, 9}, 3));
    for (const double k : {-1.4, -0.7, 0.7, 1.4}) {
      Vertex v = onGround(p + k * across, 0.005, 1);
      if (std::fabs(k) < 1) v.colour = mix(v.colour, Rgb{1.25, 1.22, 1.14}, 0.9 * left);
      to.vertices.push_back(v);
    }
  }
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(steps); ++i)
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t a = first + 4 * i + k, b = a + 4;
      to.triangles.push_back({a, b + 1, a + 1}), to.triangles.push_back({a, b, b + 1});
    }
}

/// Runners' lanes before the sill, and a field for every game in which the thrower stays.
void addLines(Part& to) {
  constexpr double kLane = 1.43, kField = 1.2, kBack = -4.3, kFront = -0.38;
  for (int i = -10; i <= 10; ++i) addLine(to, {i * kLane, 0.34, 0}, {i * kLane, 11, 0}, 0.06);
  for (const double x : kGames) {
    const Point a{x - kField, kBack, 0}, b{x + kField, kBack, 0}, c{x + kField, kFront, 0},
        d{x - kField, kFront, 0};
    addLine(to, a, b, 0.07), addLine(to, b, c, 0.07), addLine(to, d, a, 0.07);
  }
}

Part pebbles() {
  Dice dice(52);
  Part all;
  all.finish = {"pebbles", "", 0.95, 0};
  for (int i = 0; i < 260; ++i) {
    const Point at{dice.between(-14, 14), dice.between(kTrackLow + 0.3, 4), 0};
    const double r = 0.006 + 0.022 * dice.even() * dice.even(), flat = dice.between(0.4, 0.7);
    Part stone = sphere(0);
    const Rgb colour = mix(Rgb{0.52, 0.46, 0.38}, Rgb{0.80, 0.74, 0.63}, dice.even());
    paint(stone, [&](const Vertex& v) { return mix(0.75, 1.05, 0.5 + 0.5 * v.p.z) * colour; });
    add(all, stone, {{at.x, at.y, 0.25 * r}, dice.between(0, 6), {r, r * dice.between(0.6, 1.0), r * flat}});
  }
  return all;
}

/// Blades that spread from a root, seen from both sides.
void addTuft(Part& to, Point at, double height, Dice& dice) {
  for (int i = 0; i < 9; ++i) {
    const auto [s, c] = det::sincos(dice.between(0, 2 * kPi));
    const double tall = height * dice.between(0.6, 1.0), lean = tall * dice.between(0.25, 0.8);
    const Point foot = at + 0.03 * Point{c, s, 0}, across = 0.006 * Point{-s, c, 0};
    const Rgb tip = mix(Rgb{0.78, 0.68, 0.36}, Rgb{0.50, 0.54, 0.24}, dice.even()), root{0.36, 0.36, 0.18};
    const Point top = foot + Point{lean * c, lean * s, tall};
    const auto first = static_cast<std::uint32_t>(to.vertices.size());
    for (const Vertex& v : {Vertex{foot - across, root, {}, {0, 0, 1}},
                            Vertex{foot + across, root, {}, {0, 0, 1}}, Vertex{top, tip, {}, {0, 0, 1}}})
      to.vertices.push_back(v);
    to.triangles.push_back({first, first + 1, first + 2}),
        to.triangles.push_back({first, first + 2, first + 1});
  }
}

/// Places without footsteps: along the kerb, at the feet of stands and boards, and here and there.
Part tufts() {
  Dice dice(53);
  Part all;
  all.finish = {"grass", "", 0.95, 0};
  for (int i = 0; i < 90; ++i) {
    const double side = i % 2 == 0 ? -1 : 1;
    addTuft(all, {side * (kTrackSide - dice.between(0.03, 0.5)), dice.between(kTrackLow, 12), 0},
            dice.between(0.06, 0.2), dice);
    if (i % 3 == 0)
      addTuft(all, {dice.between(-14, 14), kTrackLow + dice.between(0.05, 0.6), 0}, dice.between(0.08, 0.2),
              dice);
    if (i % 3 == 1)
      addTuft(all, {dice.between(-13, 13), dice.between(-10, -4.6), 0}, dice.between(0.04, 0.10), dice);
  }
  for (const double x : kGames)
    for (int i = 0; i < 9; ++i) {
      const auto [s, c] = det::sincos(dice.between(0, 2 * kPi));
      addTuft(all, {x + 0.6 + 0.33 * c, -2.3 + 0.33 * s, 0}, dice.between(0.05, 0.13), dice);
    }
  return all;
}

}  // namespace

Parts trackEarth() {
  Part earth = ground();
  earth.finish = {"earth", "earth.png", 1, 0};
  addLines(earth), addWalks(earth);
  return {earth, pebbles(), tufts()};
}

}  // namespace stadion::assets
