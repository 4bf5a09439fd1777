#include "assets/generator/olympia/anatomy.h"

#include "assets/generator/olympia/joints.h"

// Limbs hang from their joints along -Z, trunk and head rise from theirs.

namespace stadion::assets {
namespace {

const Pose& restOf(Joint joint) {
  static const std::vector<Pose> rest = personAtRest();
  return rest[static_cast<std::size_t>(boneOf(joint))];
}

Clay& onJoint(Clay& clay, Joint joint) {
  return clay.on(boneOf(joint), restOf(joint));
}

void addHand(Clay& clay, double side) {
  onJoint(clay, side > 0 ? Joint::RightHand : Joint::LeftHand);
  const auto at = [side](double x, double y, double z) { return Point{side * x, y, z}; };
  clay.ball({0, 0, -0.005}, {0.020, 0.028, 0.026}).ball({0, 0.002, -0.05}, {0.017, 0.041, 0.048}, 0.03);
  for (int i = 0; i < 4; ++i) {
    const double y = -0.03 + 0.021 * i, reach = i == 0 ? 0.8 : i == 3 ? 0.95 : 1.0;
    const Point knuckle = at(-0.004, y, -0.085), middle = at(-0.016, y, -0.085 - 0.042 * reach),
                tip = at(-0.042, y, -0.085 - 0.065 * reach);
    clay.rod(knuckle, middle, 0.0115, 0.0100, 0.010).rod(middle, tip, 0.0100, 0.0085, 0.006);
  }
  clay.rod(at(-0.008, 0.026, -0.03), at(-0.022, 0.052, -0.065), 0.015, 0.012, 0.02)
      .rod(at(-0.022, 0.052, -0.065), at(-0.036, 0.054, -0.095), 0.012, 0.009, 0.008);
}

void addFoot(Clay& clay, double side) {
  onJoint(clay, side > 0 ? Joint::RightFoot : Joint::LeftFoot);
  clay.ball({0, -0.004, 0}, {0.034, 0.037, 0.036}).ball({0, -0.030, -0.044}, {0.032, 0.036, 0.036}, 0.04);
  clay.rod({0, 0.0, -0.022}, {0, 0.115, -0.056}, 0.034, 0.024, 0.03)
      .ball({side * 0.002, 0.12, -0.059}, {0.045, 0.045, 0.021}, 0.03);
  clay.rod({side * -0.026, 0.145, -0.064}, {side * -0.026, 0.185, -0.066}, 0.015, 0.013, 0.012);
  for (int i = 0; i < 4; ++i) {
    const double x = side * (-0.004 + 0.0155 * i);
    clay.rod({x, 0.145 - 0.006 * i, -0.067}, {x + side * 0.002, 0.180 - 0.011 * i, -0.070}, 0.011, 0.0095,
             0.008);
  }
}

/// The muscles of the belly, and those that grip the ribs.
void addBelly(Clay& clay, double g) {
  for (int row = 0; row < 4; ++row) {
    const double z = 0.165 - 0.068 * row;
    clay.balls({0.033, mix(0.087, 0.079, row / 3.0) * g, z}, {0.032, 0.019, row == 3 ? 0.048 : 0.033}, 0.024);
  }
  for (int rib = 0; rib < 3; ++rib)  // where the flank's muscle grips the ribs
    clay.balls({0.112 - 0.006 * rib, 0.058 - 0.008 * rib, 0.205 - 0.036 * rib}, {0.024, 0.022, 0.014}, 0.02);
}

}  // namespace

Rgb skinColour(const Look& look, Point p, Point n, double open) {
  const double lively = roughNoise(14 * p, 2);
  const Rgb deep = times(look.skin, {0.80, 0.72, 0.70});
  const Rgb lit = mix(0.97, 1.03, lively) *
                  mix(deep, look.skin, std::clamp(0.75 + 0.35 * n.z + 0.3 * (lively - 0.5), 0.0, 1.0));
  return mix(times({0.70, 0.60, 0.56}, lit), lit, smoothstep(0.0, 0.8, open));
}

double pleatAt(Point p, double count) {
  return det::sin(count * det::atan2(p.x, p.y + 1e-9) + 1.5 * noise({3 * p.z, 4 * p.x, 0.5}));
}

void addTrunk(Clay& clay, double girth, bool covered) {
  const double g = girth, m = 0.5 + 0.5 * girth;  // m: less than in proportion
  onJoint(clay, Joint::Pelvis);
  clay.ball({0, -0.005, 0.01}, {0.152 * m, 0.102 * m, 0.12})
      .ball({0, 0.004, 0.10}, {0.130 * m, 0.094 * g, 0.085}, 0.06);
  clay.balls({0.070, -0.056, -0.045}, {0.086, 0.080, 0.090}, 0.04);    // seat
  clay.balls({0.108, 0.010, 0.075}, {0.036 * m, 0.060, 0.042}, 0.04);  // crest of the hip
  onJoint(clay, Joint::Chest);
  clay.ball({0, -0.010, 0.205}, {0.148 * m, 0.110 * m, 0.19}, 0.05)
      .ball({0, 0.002, 0.0}, {0.128 * m, 0.092 * g, 0.11}, 0.06);
  clay.balls({0.118, -0.035, 0.235}, {0.050 * m, 0.066, 0.125}, 0.05);           // back of the flanks
  clay.balls({0.150, -0.012, 0.335}, {0.062, 0.060, 0.052}, 0.05);               // shoulders
  clay.rods({0.015, -0.030, 0.425}, {0.15, -0.02, 0.370}, 0.046, 0.040, 0.05);   // neck to shoulders
  clay.balls({0.078, 0.070 * m, 0.278}, {0.082, 0.042 * g, 0.056}, 0.022);       // breast
  clay.balls({0.085, -0.078, 0.285}, {0.066, 0.036, 0.080}, 0.04);               // shoulder blades
  clay.balls({0.110, 0.020, 0.055}, {0.036 * m, 0.062 * m, 0.080}, 0.04);        // beside the belly
  clay.rods({0.030, -0.092, 0.26}, {0.034, -0.078, -0.04}, 0.034, 0.036, 0.03);  // along the spine
  clay.rod({0, -0.015, 0.34}, {0, -0.005, 0.47}, 0.060, 0.055, 0.03);
  clay.rods({0.018, 0.044, 0.400}, {0.135, 0.024, 0.396}, 0.012, 0.010, 0.035);  // collar bones
  clay.rods({0.050, 0.008, 0.50}, {0.012, 0.046, 0.408}, 0.014, 0.012, 0.02);    // from the ears to them
  if (!covered) addBelly(clay, girth);
}

void addArm(Clay& clay, double side, double girth) {
  const double g = girth;
  onJoint(clay, side > 0 ? Joint::RightArm : Joint::LeftArm);
  clay.ball({side * 0.004, 0, -0.015}, {0.048, 0.052, 0.056}, 0.05)
      .ball({side * 0.014, 0, -0.095}, {0.037 * g, 0.043 * g, 0.082}, 0.04);
  clay.rod({0, 0, -0.02}, {0, -0.003, -0.30}, 0.043 * g, 0.036, 0.04);
  clay.ball({0, 0.020 * g, -0.180}, {0.033 * g, 0.033 * g, 0.080}, 0.025)
      .ball({side * 0.004, -0.022 * g, -0.155}, {0.036 * g, 0.034 * g, 0.095}, 0.025);
  onJoint(clay, side > 0 ? Joint::RightForearm : Joint::LeftForearm);
  clay.rod({0, -0.003, 0}, {0, 0, -0.255}, 0.036, 0.024);
  clay.ball({0, -0.026, 0}, {0.018, 0.016, 0.022}, 0.02);  // the elbow's tip
  clay.ball({side * 0.015, 0.012, -0.080}, {0.027 * g, 0.030 * g, 0.088}, 0.025)
      .ball({side * -0.013, -0.006, -0.092}, {0.027 * g, 0.031 * g, 0.085}, 0.025);
  clay.ball({0, 0, -0.255}, {0.020, 0.028, 0.026}, 0.03);
  addHand(clay, side);
}

void addLeg(Clay& clay, double side, double girth) {
  const double g = girth;
  onJoint(clay, side > 0 ? Joint::RightThigh : Joint::LeftThigh);
  clay.rod({0, 0, -0.03}, {0, 0, -0.44}, 0.080 * g, 0.050, 0.04);
  clay.ball({side * 0.012, 0.028 * g, -0.23}, {0.054 * g, 0.052 * g, 0.18}, 0.03)
      .ball({side * 0.038, 0.010, -0.22}, {0.038 * g, 0.048 * g, 0.16}, 0.03);
  clay.ball({side * -0.026, 0.026, -0.335}, {0.030 * g, 0.032 * g, 0.072}, 0.02)  // above the knee, inside
      .ball({side * 0.034, 0.022, -0.315}, {0.028 * g, 0.030 * g, 0.075}, 0.02);
  clay.ball({side * -0.020, -0.028 * g, -0.22}, {0.036 * g, 0.046 * g, 0.17}, 0.03)
      .ball({side * 0.022, -0.026 * g, -0.24}, {0.036 * g, 0.046 * g, 0.17}, 0.03);
  onJoint(clay, side > 0 ? Joint::RightShin : Joint::LeftShin);
  clay.rod({0, 0, 0}, {0, -0.002, -0.39}, 0.049, 0.033).ball({0, 0.032, 0.002}, {0.026, 0.024, 0.034}, 0.02);
  clay.rod({side * -0.006, 0.024, -0.05}, {side * -0.006, 0.018, -0.33}, 0.020, 0.014, 0.02);  // shin bone
  clay.ball({side * -0.020, -0.028 * g, -0.14}, {0.034 * g, 0.042 * g, 0.105}, 0.022)
      .ball({side * 0.021, -0.025 * g, -0.125}, {0.033 * g, 0.040 * g, 0.098}, 0.022);
  clay.rod({0, -0.02, -0.22}, {0, -0.024, -0.39}, 0.022, 0.017, 0.03);
  clay.balls({0.026, -0.002, -0.388}, {0.012, 0.014, 0.015}, 0.02);
  addFoot(clay, side);
}

void addSurface(FigureModel& to, Part part, const std::function<Carriers(Point)>& carriers,
                const std::function<bool(Point)>& leave) {
  dropFlat(part);
  if (leave)
    std::erase_if(part.triangles, [&](const auto& t) {
      const auto& v = part.vertices;
      return leave(1.0 / 3 * (v[t[0]].p + v[t[1]].p + v[t[2]].p));
    });
  // Removes the vertices that no triangle has left.
  std::vector<std::uint32_t> number(part.vertices.size(), 0xffffffff);
  std::vector<Vertex> kept;
  SkinnedPart skinned;
  for (auto& t : part.triangles)
    for (std::uint32_t& c : t) {
      if (number[c] == 0xffffffff) {
        number[c] = static_cast<std::uint32_t>(kept.size());
        kept.push_back(part.vertices[c]);
        skinned.carriers.push_back(carriers(part.vertices[c].p));
      }
      c = number[c];
    }
  part.vertices = std::move(kept);
  skinned.part = std::move(part);
  to.parts.push_back(std::move(skinned));
}

}  // namespace stadion::assets
