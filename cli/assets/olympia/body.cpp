#include "cli/assets/olympia/body.h"

#include "cli/assets/sculpt.h"

namespace stadion::assets {
namespace {

constexpr Rgb kSkin{0.80, 0.58, 0.44}, kSkinDeep{0.64, 0.42, 0.31}, kLinen{0.93, 0.90, 0.83};
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

}  // namespace

Parts pelvis() {
  Clay clay;
  clay.ball({0, -0.005, 0.0}, {0.168, 0.114, 0.115}).ball({0, 0.02, 0.06}, {0.140, 0.096, 0.10}, 0.05);
  clay.ball({0, -0.004, 0.11}, {0.142, 0.110, 0.06}, 0.05);
  clay.balls({0.075, -0.065, -0.045}, {0.085, 0.078, 0.09}, 0.03)
      .ball({0, 0.075, -0.075}, {0.055, 0.052, 0.07}, 0.04);
  clay.rods({0.0, 0.10, 0.085}, {0.125, 0.02, 0.095}, 0.014, 0.014, 0.012)
      .rods({0.125, 0.02, 0.095}, {0.0, -0.10, 0.09}, 0.014, 0.014, 0.012);
  // The loincloth lies in folds that run together in front.
  clay.relief([](Point p) {
    const double folds = det::sin(70 * p.z + 40 * std::fabs(p.x));
    return 0.0025 * folds * smoothstep(0.09, 0.05, p.z);
  });
  Part part = clay.cast(kStep, [](Point p, Point n) {
    const double fold = det::sin(70 * p.z + 40 * std::fabs(p.x));
    const double rim = 0.082 + 0.004 * det::sin(30 * p.x);
    if (p.z > rim + 0.022) return skinAt(p, n);
    return p.z > rim - 0.012 ? 0.93 * kLinen : mix(0.91, 1.0, 0.5 + 0.5 * fold) * kLinen;
  });
  part.finish = {"skin and linen", "", 0.75, 0};
  return {part};
}

Parts chest() {
  Clay clay;
  clay.ball({0, -0.005, 0.20}, {0.150, 0.112, 0.20}).ball({0, 0, 0.02}, {0.126, 0.094, 0.15}, 0.08);
  clay.balls({0.120, -0.035, 0.215}, {0.050, 0.066, 0.14}, 0.05);         // back of the flanks
  clay.balls({0.160, -0.01, 0.335}, {0.064, 0.060, 0.058}, 0.05);         // shoulders
  clay.rods({0, -0.035, 0.43}, {0.15, -0.02, 0.37}, 0.052, 0.036, 0.05);  // neck to shoulders
  clay.rod({0, -0.015, 0.34}, {0, -0.005, 0.45}, 0.064, 0.056, 0.03);
  clay.balls({0.080, 0.072, 0.268}, {0.086, 0.044, 0.062}, 0.022);  // breast
  for (double z : {-0.05, 0.015, 0.08}) clay.balls({0.036, 0.077, z}, {0.036, 0.021, 0.036}, 0.022);
  clay.balls({0.098, 0.02, -0.03}, {0.040, 0.062, 0.085}, 0.045);  // flanks
  for (int i = 0; i < 3; ++i)
    clay.balls({0.118 - 0.006 * i, 0.054, 0.17 - 0.04 * i}, {0.028, 0.03, 0.018}, 0.03);
  clay.rods({0.034, -0.072, -0.08}, {0.04, -0.085, 0.24}, 0.032, 0.030, 0.045);  // along the spine
  clay.balls({0.085, -0.078, 0.285}, {0.068, 0.036, 0.08}, 0.045);               // shoulder blades
  clay.rods({0.02, 0.045, 0.405}, {0.16, 0.02, 0.385}, 0.013, 0.012, 0.035);     // collar bones
  Part part = clay.cast(kStep, [](Point p, Point n) {
    const double nipple = length(p - Point{p.x < 0 ? -0.092 : 0.092, 0.118, 0.245});
    return mix(Rgb{0.55, 0.32, 0.24}, skinAt(p, n), smoothstep(0.01, 0.02, nipple));
  });
  part.finish = {"skin", "", 0.55, 0};
  return {part};
}

Parts upperArm() {
  Clay clay;
  clay.ball({0.012, 0, -0.025}, {0.060, 0.066, 0.082}).ball({0.022, 0, -0.12}, {0.034, 0.04, 0.085}, 0.04);
  clay.rod({0, 0, -0.02}, {0, 0, -0.28}, 0.046, 0.036, 0.04);
  clay.ball({0, 0.026, -0.175}, {0.035, 0.033, 0.085}, 0.015)
      .ball({0.004, -0.026, -0.16}, {0.037, 0.034, 0.10}, 0.015);
  clay.ball({0, -0.003, -0.30}, {0.036, 0.037, 0.036}, 0.03);
  return ofSkin(clay, 0.018);
}

Parts forearm() {
  Clay clay;
  clay.ball({0, -0.003, 0}, {0.036, 0.037, 0.036}).rod({0, 0, -0.02}, {0, 0, -0.25}, 0.036, 0.023, 0.03);
  clay.ball({0.018, 0.014, -0.075}, {0.027, 0.030, 0.09}, 0.015)
      .ball({-0.015, -0.006, -0.085}, {0.027, 0.031, 0.085}, 0.015);
  clay.ball({0, 0, -0.255}, {0.021, 0.029, 0.026}, 0.02);
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

Parts thigh() {
  Clay clay;
  clay.rod({0, 0, -0.05}, {0, 0, -0.42}, 0.080, 0.052)
      .ball({-0.01, -0.015, -0.01}, {0.074, 0.082, 0.08}, 0.04);
  clay.ball({0.012, 0.036, -0.20}, {0.058, 0.055, 0.20}, 0.02)
      .ball({0.046, 0.012, -0.24}, {0.036, 0.048, 0.15}, 0.02);
  clay.ball({-0.030, 0.028, -0.365}, {0.031, 0.034, 0.06}, 0.015)
      .ball({-0.040, 0, -0.11}, {0.05, 0.062, 0.13}, 0.03);
  clay.ball({-0.018, -0.036, -0.24}, {0.034, 0.045, 0.17}, 0.015)
      .ball({0.024, -0.034, -0.24}, {0.034, 0.045, 0.17}, 0.015);
  clay.ball({0, 0.003, -0.44}, {0.051, 0.053, 0.052}, 0.03);
  return ofSkin(clay, kStep);
}

Parts shin() {
  Clay clay;
  clay.ball({0, 0, 0}, {0.050, 0.052, 0.052}).ball({0, 0.042, -0.002}, {0.028, 0.018, 0.032}, 0.02);
  clay.rod({0, 0.010, -0.02}, {0, 0, -0.37}, 0.044, 0.029, 0.03);
  clay.ball({-0.022, -0.036, -0.13}, {0.034, 0.042, 0.10}, 0.012)
      .ball({0.026, -0.032, -0.12}, {0.032, 0.038, 0.095}, 0.012);
  clay.ball({0.018, 0.02, -0.15}, {0.025, 0.026, 0.13}, 0.02)
      .rod({0, -0.024, -0.22}, {0, -0.036, -0.38}, 0.022, 0.014, 0.03);
  clay.ball({0, -0.004, -0.385}, {0.034, 0.038, 0.036}, 0.02)
      .balls({0.031, -0.002, -0.385}, {0.012, 0.014, 0.015}, 0.012);
  return ofSkin(clay, 0.018);
}

Parts foot() {
  Clay clay;
  clay.ball({0, -0.004, 0}, {0.034, 0.038, 0.036}).ball({0, -0.035, -0.044}, {0.032, 0.036, 0.036}, 0.03);
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
  // It ends above the ground, and nobody looks under it.
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
