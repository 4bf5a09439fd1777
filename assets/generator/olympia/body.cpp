#include "assets/generator/olympia/body.h"

#include "assets/generator/craft/sculpt.h"

namespace stadion::assets {
namespace {

constexpr Rgb kSkin{0.80, 0.58, 0.44}, kSkinDeep{0.64, 0.42, 0.31}, kLinen{0.92, 0.89, 0.81},
    kBorder{0.56, 0.20, 0.15};
constexpr double kStep = 0.021;  // of the surface [m]

/// Tanned by the sun from above, oiled; redder where the skin is thick.
Rgb skinAt(Point p, Point n) {
  const double lively = roughNoise(14 * p, 2);
  return mix(0.97, 1.03, lively) *
         mix(kSkinDeep, kSkin, std::clamp(0.75 + 0.35 * n.z + 0.3 * (lively - 0.5), 0.0, 1.0));
}

Parts ofSkin(const Clay& clay, double step) {
  Part part = clay.cast(step, skinAt);
  part.finish = {"skin", "", 0.55, 0};
  return {part};
}

/// Pleats that hang from a belt or a shoulder, deeper the lower: from -1 to 1.
double pleats(Point p, double count) {
  return det::sin(count * det::atan2(p.x, p.y + 1e-9) + 1.5 * noise({3 * p.z, 4 * p.x, 0.5}));
}

/// Draws what lies near the level z onto it, so that a coloured edge there is straight.
void level(Part& part, double z, double near) {
  for (Vertex& v : part.vertices)
    if (std::fabs(v.p.z - z) < near) v.p.z = z;
}

/// A piece of the short chiton: linen in pleats down to `hem`, where it is cut off, with a border of that
/// colour.
Part ofLinen(Clay clay, double count, double hem, double step, Rgb border) {
  const auto deep = [=](Point p) { return smoothstep(hem + 0.22, hem, p.z); };
  clay.relief([=](Point p) { return 0.0075 * deep(p) * pleats(p, count); });
  Part part = clay.cast(step, [=](Point p, Point n) {
    const double fold = mix(0.4 * (noise(30 * p) - 0.5), pleats(p, count), deep(p));
    return mix(0.80, 1.0, 0.5 + 0.5 * fold) * mix(0.86, 1.0, smoothstep(-0.6, 0.2, n.z)) * kLinen;
  });
  part.finish = {"linen", "", 0.9, 0};
  level(part, hem + step, 0.5 * step);
  for (Vertex& v : part.vertices)
    if (v.p.z < hem + 0.5 * step) {
      v.p.z = hem;
      v.colour = border;
    }
  return part;
}

}  // namespace

Parts pelvis() {
  Clay clay;
  clay.ball({0, -0.005, 0.02}, {0.160, 0.118, 0.12}).ball({0, -0.004, 0.11}, {0.138, 0.106, 0.07}, 0.05);
  clay.balls({0.07, -0.055, -0.045}, {0.09, 0.085, 0.09}, 0.05);
  clay.rod({0, 0, -0.02}, {0, 0, -0.30}, 0.165, 0.195, 0.06);
  Part skirt = ofLinen(clay, 22, -0.175, kStep, 0.92 * kLinen);
  level(skirt, 0.075, 0.5 * kStep);
  // Flatter from front to back than a rod, and a cord about the waist.
  for (Vertex& v : skirt.vertices) {
    const double flat = mix(1.0, 0.80, smoothstep(0.05, -0.06, v.p.z));
    v.p.y *= flat;
    if (v.p.z == 0.075) v.colour = kBorder;
  }
  return {skirt};
}

Parts chest() {
  Clay cloth;
  cloth.ball({0, -0.005, 0.20}, {0.156, 0.118, 0.20}).ball({0, 0, -0.01}, {0.150, 0.118, 0.075}, 0.09);
  cloth.balls({0.120, -0.03, 0.215}, {0.056, 0.070, 0.14}, 0.05);           // back of the flanks
  cloth.balls({0.165, -0.01, 0.335}, {0.070, 0.068, 0.064}, 0.05);          // shoulders
  cloth.rods({0, -0.032, 0.42}, {0.16, -0.02, 0.365}, 0.052, 0.042, 0.05);  // neck to shoulders
  cloth.balls({0.080, 0.068, 0.268}, {0.088, 0.046, 0.066}, 0.04);          // breast
  cloth.balls({0.085, -0.076, 0.285}, {0.070, 0.038, 0.085}, 0.05);         // shoulder blades
  Clay clay = cloth;
  clay.rod({0, -0.015, 0.34}, {0, -0.005, 0.45}, 0.062, 0.056, 0.03);
  clay.rods({0.02, 0.047, 0.405}, {0.13, 0.03, 0.395}, 0.012, 0.010, 0.03);  // collar bones
  // The cloth is pinned on both shoulders and falls over the belt.
  const auto bare = [](Point p) { return p.z > 0.352 + 1.1 * std::max(std::fabs(p.x) - 0.06, 0.0); };
  const auto hang = [](Point p) {
    return det::sin(85 * (p.x * (1.15 - 1.2 * p.z)) + 2.5 * noise({5 * p.x, 0.5, 4 * p.z})) *
           smoothstep(0.36, 0.1, p.z);
  };
  clay.relief([=](Point p) { return bare(p) ? 0.0 : 0.004 + 0.0045 * hang(p); });
  Part part = clay.cast(0.018, [=](Point p, Point n) {
    const double rim = 0.352 + 1.1 * std::max(std::fabs(p.x) - 0.06, 0.0) - p.z;
    if (bare(p)) return mix(kBorder, skinAt(p, n), smoothstep(0, 0.012, -rim));
    const Rgb linen =
        mix(0.80, 1.0, 0.5 + 0.5 * hang(p)) * mix(0.74, 1.0, smoothstep(-0.6, 0.2, n.z)) * kLinen;
    return mix(kBorder, linen, smoothstep(0.006, 0.028, rim));
  });
  part.finish = {"linen", "", 0.9, 0};
  return {part};
}

Parts upperArm() {
  Clay clay;
  clay.ball({0.004, 0, -0.015}, {0.050, 0.054, 0.058}).ball({0.014, 0, -0.11}, {0.036, 0.042, 0.085}, 0.05);
  clay.rod({0, 0, -0.02}, {0, -0.003, -0.30}, 0.047, 0.037, 0.04);
  clay.ball({0, 0.018, -0.175}, {0.035, 0.033, 0.085}, 0.03)
      .ball({0.004, -0.020, -0.16}, {0.037, 0.034, 0.10}, 0.03);
  Clay sleeve;
  sleeve.ball({0, 0, -0.006}, {0.066, 0.067, 0.066})
      .rod({0.002, 0, -0.02}, {0.008, 0, -0.20}, 0.062, 0.076, 0.05);
  Parts parts = ofSkin(clay, 0.018);
  parts.push_back(ofLinen(sleeve, 11, -0.130, 0.017, kBorder));
  return parts;
}

Parts forearm() {
  Clay clay;
  clay.rod({0, -0.003, 0}, {0, 0, -0.255}, 0.037, 0.025);
  clay.ball({0.014, 0.011, -0.085}, {0.027, 0.030, 0.09}, 0.03)
      .ball({-0.012, -0.006, -0.095}, {0.027, 0.031, 0.085}, 0.03);
  clay.ball({0, 0, -0.255}, {0.021, 0.028, 0.026}, 0.03);
  return ofSkin(clay, 0.016);
}

Parts hand() {
  Clay clay;
  clay.ball({0, 0, -0.005}, {0.020, 0.028, 0.026}).ball({0, 0.002, -0.05}, {0.017, 0.041, 0.048}, 0.03);
  for (int i = 0; i < 4; ++i) {
    const double y = -0.03 + 0.021 * i, reach = i == 0 ? 0.8 : i == 3 ? 0.95 : 1.0;
    const Point knuckle{-0.004, y, -0.085}, middle{-0.016, y, -0.085 - 0.042 * reach},
        tip{-0.042, y, -0.085 - 0.065 * reach};
    clay.rod(knuckle, middle, 0.0115, 0.0100, 0.010).rod(middle, tip, 0.0100, 0.0085, 0.006);
  }
  clay.rod({-0.008, 0.026, -0.03}, {-0.022, 0.052, -0.065}, 0.015, 0.012, 0.02)
      .rod({-0.022, 0.052, -0.065}, {-0.036, 0.054, -0.095}, 0.012, 0.009, 0.008);
  return ofSkin(clay, 0.0085);
}

// Where two parts meet, both end in the same ball, and the limbs run into it without a step.

Parts thigh() {
  Clay clay;
  clay.rod({0, 0, -0.05}, {0, 0, -0.44}, 0.080, 0.051);
  clay.ball({0.010, 0.026, -0.22}, {0.058, 0.055, 0.20}, 0.04)
      .ball({0.036, 0.010, -0.24}, {0.040, 0.050, 0.15}, 0.04);
  clay.ball({-0.014, -0.026, -0.24}, {0.038, 0.047, 0.17}, 0.04)
      .ball({0.020, -0.024, -0.24}, {0.038, 0.047, 0.17}, 0.04);
  Clay skirt;
  skirt.ball({0.004, -0.004, -0.02}, {0.098, 0.100, 0.09})
      .rod({0.004, 0, -0.04}, {0.012, 0.004, -0.34}, 0.094, 0.112, 0.05);
  Parts parts = ofSkin(clay, kStep);
  parts.push_back(ofLinen(skirt, 13, -0.265, 0.019, kBorder));
  return parts;
}

Parts shin() {
  Clay clay;
  clay.rod({0, 0, 0}, {0, -0.002, -0.39}, 0.051, 0.034).ball({0, 0.030, 0.0}, {0.028, 0.026, 0.036}, 0.03);
  clay.ball({-0.018, -0.026, -0.14}, {0.036, 0.042, 0.11}, 0.03)
      .ball({0.020, -0.024, -0.13}, {0.034, 0.040, 0.105}, 0.03);
  clay.rod({0, -0.02, -0.22}, {0, -0.022, -0.39}, 0.024, 0.020, 0.04);
  clay.balls({0.026, -0.002, -0.388}, {0.012, 0.014, 0.015}, 0.02);
  return ofSkin(clay, 0.018);
}

Parts foot() {
  Clay clay;
  clay.ball({0, -0.004, 0}, {0.034, 0.037, 0.036}).ball({0, -0.030, -0.044}, {0.032, 0.036, 0.036}, 0.04);
  clay.rod({0, 0.0, -0.022}, {0, 0.115, -0.056}, 0.034, 0.024, 0.03)
      .ball({0.002, 0.12, -0.059}, {0.045, 0.045, 0.021}, 0.03);
  clay.rod({-0.026, 0.145, -0.064}, {-0.026, 0.185, -0.066}, 0.015, 0.013, 0.012);
  for (int i = 0; i < 4; ++i) {
    const double x = -0.004 + 0.0155 * i;
    clay.rod({x, 0.145 - 0.006 * i, -0.067}, {x + 0.002, 0.180 - 0.011 * i, -0.070}, 0.011, 0.0095, 0.008);
  }
  return ofSkin(clay, 0.0105);
}

Parts leftOf(const Parts& parts) {
  Parts left;
  for (const Part& part : parts) left.push_back(mirrored(part));
  return left;
}

Parts robe(Rgb cloth, Rgb border) {
  // A tunic to the feet and a mantle from the left shoulder around the right hip.
  const auto folds = [](Point p) {
    const double angle = det::atan2(p.x, p.y + 0.02);
    const double low = smoothstep(0.25, -0.6, p.z);
    const double hang = det::sin(13 * angle + 2.2 * det::sin(3 * p.z) + 3 * noise({2 * p.z, 0.5, 0.5}));
    const double sling = det::sin(38 * (p.z - 0.75 * p.x) + 4 * p.y);
    return mix(0.35 * sling, 1.3 * hang, low);
  };
  Clay clay;
  clay.rod({0, 0, -0.84}, {0, 0, 0.05}, 0.215, 0.165).ball({0, 0, 0.33}, {0.185, 0.135, 0.25}, 0.12);
  clay.rods({0.19, -0.01, 0.47}, {0.23, 0.02, 0.20}, 0.082, 0.10, 0.05)
      .ball({0, -0.01, 0.52}, {0.14, 0.085, 0.06}, 0.06);
  clay.rod({-0.19, 0, 0.50}, {0.12, 0.11, 0.05}, 0.06, 0.06, 0.06)
      .rod({0.12, 0.11, 0.05}, {-0.2, 0.10, 0.10}, 0.05, 0.07, 0.06);
  clay.rod({-0.21, 0.08, 0.12}, {-0.22, 0.05, -0.45}, 0.05, 0.08, 0.10);
  clay.relief([folds](Point p) { return 0.011 * folds(p); });
  Part part = clay.cast(0.034, [=](Point p, Point) {
    if (p.z < -0.86 && p.z > -0.92) return border;
    const double sling = std::fabs(p.z - 0.05 - 0.8 * (0.12 - p.x) * (p.y > 0 ? 1 : 0) - (p.y > 0 ? 0 : 0.4));
    const Rgb colour = mix(border, cloth, smoothstep(0.012, 0.05, sling));
    return mix(0.74, 1.03, 0.5 + 0.5 * std::clamp(folds(p), -1.0, 1.0)) * colour;
  });
  part.finish = {"wool", "", 0.95, 0};
  // The robe ends above the ground, so its underside is never seen.
  for (Vertex& v : part.vertices) v.p.z = std::max(v.p.z, -0.90);
  return {part};
}

Parts trumpet() {
  Part part = lathe({{0, 0},
                     {0.014, 0.002},
                     {0.010, 0.02},
                     {0.008, 0.04},
                     {0.009, 0.5},
                     {0.012, 0.85},
                     {0.022, 1.0},
                     {0.045, 1.08},
                     {0.062, 1.10},
                     {0.050, 1.085},
                     {0.0, 1.0}},
                    14);
  part.finish = {"bronze", "", 0.35, 0.75};
  for (Vertex& v : part.vertices) {
    v.p = {v.p.x, v.p.z, -v.p.y};
    v.colour = {0.80, 0.60, 0.32};
  }
  return {part};
}

}  // namespace stadion::assets
