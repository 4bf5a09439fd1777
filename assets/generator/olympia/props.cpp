#include "assets/generator/olympia/olympia.h"
#include "assets/generator/olympia/stadium_shape.h"

namespace stadion::assets {
namespace {

// Radius and half thickness [m] from the middle to the rim, which has a round edge.
constexpr Turning kLens[] = {{0, 0.0165},      {0.012, 0.0164},  {0.030, 0.0155},  {0.050, 0.0139},
                             {0.068, 0.0119},  {0.082, 0.0101},  {0.0925, 0.0086}, {0.0950, 0.0092},
                             {0.0985, 0.0094}, {0.1030, 0.0085}, {0.1070, 0.0062}, {0.1093, 0.0032},
                             {0.1100, 0.0}};

// Distance from the tip and diameter [m].
constexpr Turning kShaft[] = {{0.003, 0},     {0.011, 0.07},  {0.017, 0.12},  {0.020, 0.15},
                              {0.0235, 0.26}, {0.0205, 0.27}, {0.024, 0.525}, {0.0262, 0.90}};
constexpr Turning kTail[] = {{0.0270, 1.16}, {0.0270, 1.30}, {0.0245, 1.85},
                             {0.0180, 2.17}, {0.0110, 2.50}, {0.0035, 2.65}};
constexpr double kGravity = 1.05;

/// Turned outlines run along +Z; the javelin's nose looks along +X.
Part alongX(const std::vector<Turning>& fromTip, int sides, Finish finish,
            const std::function<Rgb(double)>& colour) {
  std::vector<Turning> outline;
  for (auto at = fromTip.rbegin(); at != fromTip.rend(); ++at)
    outline.push_back({at->r / 2, kGravity - at->z});
  Part part = lathe(outline, sides);
  part.finish = std::move(finish);
  for (Vertex& v : part.vertices) {
    v.colour = colour(kGravity - v.p.z);
    v.p = {v.p.z, v.p.x, v.p.y};
  }
  return part;
}

}  // namespace

Parts discus() {
  std::vector<Turning> outline;
  for (const Turning& t : kLens) outline.push_back({t.r, -t.z});
  for (std::size_t i = std::size(kLens) - 1; i-- > 0;) outline.push_back({kLens[i].r, kLens[i].z});
  Part part = lathe(outline, 64);
  part.finish = {"bronze", "", 0.38, 0.75};
  paint(part, [](const Vertex& v) {
    const double r = length({v.p.x, v.p.y, 0});
    const double patina = roughNoise(40 * v.p, 3), worn = smoothstep(0.075, 0.105, r);
    return mix(mix(Rgb{0.62, 0.42, 0.22}, Rgb{0.45, 0.40, 0.27}, smoothstep(0.45, 0.7, patina)),
               Rgb{0.80, 0.58, 0.32}, 0.7 * worn);
  });
  return {part};
}

Parts javelin() {
  std::vector<Turning> all{{0, 0}};
  all.insert(all.end(), std::begin(kShaft), std::end(kShaft));
  // Where the thong is wound: ridges of leather.
  for (int i = 0; i <= 20; ++i) all.push_back({i % 2 == 0 ? 0.0272 : 0.0300, 0.94 + 0.2 * i / 20});
  all.insert(all.end(), std::begin(kTail), std::end(kTail));
  all.push_back({0, 2.65});
  Part part = alongX(all, 14, {"cornel wood", "", 0.55, 0}, [](double fromTip) {
    if (fromTip < 0.262) return Rgb{0.60, 0.43, 0.24};                     // the bronze head
    if (fromTip > 0.935 && fromTip < 1.145) return Rgb{0.36, 0.20, 0.11};  // leather
    return mix(Rgb{0.66, 0.47, 0.28}, Rgb{0.56, 0.37, 0.20}, noise({fromTip * 9, 0.5, 0.5}));
  });
  return {part};
}

Parts leatherBall() {
  Part part = sphere(4);
  part.finish = {"leather", "", 0.6, 0};
  // Three great circles of seams divide it into eight panels that are sewn of two leathers by turns.
  for (Vertex& v : part.vertices) {
    const Point d = v.p;
    const double seam = std::min({std::fabs(d.x), std::fabs(d.y), std::fabs(d.z)});
    const bool other = (d.x > 0) ^ (d.y > 0) ^ (d.z > 0);
    const Rgb leather = other ? Rgb{0.70, 0.42, 0.20} : Rgb{0.82, 0.62, 0.38};
    const Rgb worn = mix(0.88, 1.06, roughNoise(6 * d, 3)) * leather;
    v.colour = mix(Rgb{0.25, 0.14, 0.08}, worn, smoothstep(0.02, 0.05, seam));
    v.p = 0.11 * d;
  }
  return {part};
}

Parts plinth() {
  Part part;
  part.finish = {"limestone", "stone.png", 0.9, 0};
  const auto block = [&](double half, double low, double high) {
    Part stone = box({-half, -half, low}, {half, half, high});
    paint(stone, [&](const Vertex& v) { return stoneColour(v.p + Point{0, 0, 7 * low}); });
    add(part, stone);
  };
  block(0.24, 0, 0.12), block(0.20, 0.12, 0.17), block(0.17, 0.17, 0.83), block(0.20, 0.83, 0.87),
      block(0.23, 0.87, 0.95);
  layPicture(part, 1.3);
  return {part};
}

Parts javelinRack() {
  Part part;
  part.finish = {"wood", "", 0.8, 0};
  for (double x : {-0.55, 0.55}) {
    add(part, limb({x, 0, 0}, {x, 0, 0.98}, 0.032, 0.026, 8));
    for (double s : {-1.0, 1.0}) {
      add(part, limb({x, 0, 0.96}, {x, 0.06 * s, 1.08}, 0.02, 0.013, 6));
      add(part, limb({x, 0, 0.25}, {x, 0.24 * s, 0.0}, 0.02, 0.022, 6));
    }
  }
  add(part, limb({-0.55, 0, 0.3}, {0.55, 0, 0.3}, 0.018, 0.018, 6));
  paint(part, [](const Vertex& v) {
    return mix(0.8, 1.1, noise({25 * v.p.x, 25 * v.p.y, 4 * v.p.z})) * Rgb{0.56, 0.40, 0.25};
  });
  return {part};
}

}  // namespace stadion::assets
