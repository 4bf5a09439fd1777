#include "assets/generator/olympia/olympia.h"
#include "assets/generator/olympia/stadium_shape.h"

// Rings around the track, one outside the other, joined by bands.

namespace stadion::assets {
namespace {

constexpr double kBankRings[] = {0.55, 1.5,  2.6, 4,  5.5, 7.5, 9.5, 12, 14.5, 17, 19.5,
                                 22,   24.5, 27,  30, 33,  36,  40,  44, 48,   54};
constexpr double kLandRings[] = {54,  62,  72,  84,  97,   111,  126,  142,  159,  177,
                                 196, 216, 237, 259, 282,  308,  338,  374,  418,  474,
                                 548, 640, 770, 930, 1130, 1380, 1690, 2060, 2500, 3000};

Rgb grassColour(Point p) {
  const double dry = roughNoise(0.09 * p, 4), patch = roughNoise(0.55 * p + Point{40, 0, 0}, 3);
  const Rgb straw{0.90, 0.80, 0.47}, green{0.58, 0.66, 0.30}, dark{0.42, 0.52, 0.23};
  return mix(mix(green, straw, smoothstep(0.36, 0.62, dry)), dark, 0.8 * smoothstep(0.5, 0.72, patch));
}

Rgb bankColour(const Vertex& v) {
  const double d = outside({v.p.x, v.p.y, 0});
  const Rgb earth = mix(0.9, 1.06, roughNoise(0.8 * v.p, 2)) * Rgb{0.84, 0.72, 0.52};
  const double worn = roughNoise(0.25 * v.p + Point{0, 90, 0}, 3);
  const double bare = std::max(1 - smoothstep(1.5, 4.5, d), 0.8 * smoothstep(0.56, 0.68, worn));
  return mix(grassColour({v.p.x, v.p.y, 0}), earth,
             std::max(bare, 0.6 * (1 - smoothstep(1, 4, std::fabs(d - kCrest)))));
}

Rgb landColour(const Vertex& v) {
  const Point p{v.p.x, v.p.y, 0};
  const Rgb field{0.80, 0.72, 0.45}, olive{0.50, 0.54, 0.31}, scrub{0.38, 0.44, 0.24}, rock{0.68, 0.62, 0.52};
  const double patch = roughNoise(0.011 * p + Point{7, 3, 0}, 3), wood = roughNoise(0.02 * p, 4);
  Rgb c = mix(mix(field, olive, smoothstep(0.4, 0.58, patch)), scrub, smoothstep(0.48, 0.6, wood));
  // Under the wood of the hill.
  const double rocky = smoothstep(0.5, 0.62, roughNoise(0.035 * p + Point{0, 0, 4}, 3));
  c = mix(c, mix(Rgb{0.44, 0.48, 0.27}, Rgb{0.72, 0.64, 0.44}, rocky),
          smoothstep(215, 150, length(p - kKronos)));
  c = mix(c, mix(scrub, rock, smoothstep(0.5, 0.75, wood)), smoothstep(70, 160, v.p.z));
  return mix(grassColour(p), c, smoothstep(60, 130, outside(p)));
}

template <std::size_t N>
Part terrain(const double (&distances)[N], double picture) {
  std::vector<Turning> outline;
  for (double d : distances) outline.push_back({d, 0});
  Part part = ring(outline);
  for (Vertex& v : part.vertices) {
    v.p.z = groundHeight(v.p);
    v.uv = {v.p.x / picture, v.p.y / picture};
  }
  return part;
}

}  // namespace

Parts embankments() {
  Part part = terrain(kBankRings, 4);
  part.finish = {"dry grass", "meadow.png", 1, 0};
  paint(part, bankColour);
  // The passage goes through the western one.
  std::erase_if(part.triangles, [&](const auto& t) {
    Point middle{0, 0, 0};
    for (std::uint32_t c : t) middle = middle + 1.0 / 3 * part.vertices[c].p;
    return std::fabs(middle.x - kTunnel.x) < 4.4 && middle.y > kTunnel.y - 0.6 && middle.y < kTunnel.y + 15;
  });
  return {part};
}

Parts groundPlane() {
  Part part = grid({-70, -66}, {70, 260}, 1, 1);
  part.finish = {"earth", "", 1, 0};
  paint(part, [](const Vertex&) { return Rgb{0.9, 0.78, 0.56}; });
  return {part};
}

Parts countryside() {
  Part part = terrain(kLandRings, 12);
  part.finish = {"land", "meadow.png", 1, 0};
  paint(part, landColour);
  return {part};
}

}  // namespace stadion::assets
