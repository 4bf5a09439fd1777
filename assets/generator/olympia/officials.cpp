#include "assets/generator/olympia/officials.h"

#include "assets/generator/olympia/anatomy.h"
#include "assets/generator/olympia/athletes.h"
#include "assets/generator/olympia/joints.h"

// They stand in robes, of which head, right arm and feet look out. The left hand holds the mantle.

namespace stadion::assets {
namespace {

constexpr double kRobeStep = 0.039, kBareStep = 0.0225, kNearStep = 0.0150;  // [m]
constexpr double kHip = joints::kHipHeight;

struct Official {
  Look look;
  Rgb border;
  Point wrist, elbow, gaze;
  double twist;
};

Performance stance(const Official& o) {
  const auto always = [](Point p) { return Track({{0, p}}); };
  return {.duration = 1,
          .release = 1,
          .pelvis = always({0, 0, 0.925}),
          .pelvisTurn = always({0, 0, 0}),
          .chestTurn = always({0, 0, 0}),
          .gaze = always(o.gaze),
          .rightWrist = always(o.wrist),
          .leftWrist = always({-0.16, 0.2, 0.05}),
          .rightElbow = always(o.elbow),
          .leftElbow = always({-1, -0.2, -0.5}),
          .rightTwist = always({o.twist, 0, 0}),
          .rightFoot = {{0.12, 0.02, 0}, -18, {}},
          .leftFoot = {{-0.11, 0.06, 0}, 14, {}},
          .aim = always({0, 0, 0})};
}

/// Folds: a tunic to the feet, and a mantle from the left shoulder around the right hip.
double foldAt(Point p) {
  const double angle = det::atan2(p.x, p.y + 0.02), low = smoothstep(0.25, -0.6, p.z);
  const double hang = det::sin(15 * angle + 2.2 * det::sin(3 * p.z) + 3 * noise({2 * p.z, 0.5, 0.5}));
  const double sling = det::sin(46 * (p.z - 0.75 * p.x) + 4 * p.y + 1.5 * noise(4 * p));
  return mix(0.45 * sling, 1.3 * hang, low);
}

Clay robeClay() {
  Clay clay;
  const Pose hip{{0, 0, kHip}, Quat::Identity()};
  const auto rest = personAtRest();
  clay.on(boneOf(Joint::Pelvis), hip);
  clay.rod({0, 0, -0.84}, {0, 0, 0.05}, 0.205, 0.155);
  clay.rod({-0.20, 0.08, 0.12}, {-0.21, 0.05, -0.45}, 0.05, 0.075, 0.10);
  clay.on(boneOf(Joint::Chest), hip);
  clay.ball({0, 0, 0.33}, {0.180, 0.132, 0.25}, 0.12).ball({0, -0.012, 0.520}, {0.140, 0.088, 0.066}, 0.06);
  clay.rods({0.045, -0.022, 0.552}, {0.185, -0.012, 0.490}, 0.044, 0.066, 0.05);
  clay.rod({-0.185, -0.01, 0.47}, {-0.235, 0.0, 0.20}, 0.080, 0.090, 0.05);
  clay.rod({-0.235, 0.0, 0.20}, {-0.10, 0.14, 0.16}, 0.078, 0.062,
           0.05);  // the bent left arm under the mantle
  clay.rod({-0.17, 0, 0.50}, {0.12, 0.11, 0.05}, 0.06, 0.06, 0.06)
      .rod({0.12, 0.11, 0.05}, {-0.12, 0.13, 0.12}, 0.05, 0.065, 0.06);
  clay.rod({-0.12, 0.155, 0.14}, {-0.14, 0.16, -0.30}, 0.040, 0.065, 0.05);  // its end falls from the hand
  clay.on(boneOf(Joint::RightArm), rest[static_cast<std::size_t>(boneOf(Joint::RightArm))]);
  clay.ball({0, 0, -0.01}, {0.068, 0.070, 0.068}, 0.05)
      .rod({0, 0, -0.03}, {0.004, 0, -0.17}, 0.060, 0.080, 0.05);
  clay.relief([](Point p) { return 0.012 * foldAt(p - Point{0, 0, kHip}); });
  return clay;
}

/// The robe, its hem a little above the ground.
void addRobe(FigureModel& model, const Official& o) {
  const Clay clay = robeClay();
  Part part = clay.cast(kRobeStep, [&](Point world, Point n) {
    const Point p = world - Point{0, 0, kHip};
    if (p.z < -0.85 && p.z > -0.91) return o.border;
    const double sling =
        world.x > 0.185 && p.z > 0.2
            ? 1
            : std::fabs(p.z - 0.05 - 0.8 * (0.12 - p.x) * (p.y > 0 ? 1 : 0) - (p.y > 0 ? 0 : 0.4));
    const Rgb colour = mix(o.border, o.look.cloth, smoothstep(0.012, 0.05, sling));
    const Rgb folded = mix(0.74, 1.03, 0.5 + 0.5 * std::clamp(foldAt(p), -1.0, 1.0)) * colour;
    return mix(0.62, 1.0, smoothstep(0.0, 0.8, clay.open(world, n, 0.03))) * folded;
  });
  part.finish = {"wool", "", 0.95, 0};
  constexpr double hem = kHip - 0.90;
  for (Vertex& v : part.vertices) v.p.z = std::max(v.p.z, hem);
  addSurface(
      model, part,
      [&](Point p) {
        std::vector<double> shares =
            clay.pulls(p, static_cast<std::size_t>(boneOf(Joint::RightArm)) + 1, 0.03);
        shares[0] = 0;
        double sum = 0;
        for (const double s : shares) sum += s;
        const double stays = smoothstep(0.6, 0.1, p.z);
        for (double& s : shares) s *= (1 - stays) / sum;
        shares[0] = stays;  // the hem does not sway
        return carriersOf(std::move(shares));
      },
      [](Point p) { return p.z < hem + 1e-6; });
}

/// What is bare: head, right arm and feet.
void addBare(FigureModel& model, const Official& o) {
  Clay clay;
  const auto rest = personAtRest();
  addTrunk(clay, 0.95, true), addArm(clay, 1, 0.9), addLeg(clay, 1, 0.9), addLeg(clay, -1, 0.9);
  const HeadClay head(o.look);
  const Pose& X_head = rest[static_cast<std::size_t>(boneOf(Joint::Head))];
  head.addTo(clay, boneOf(Joint::Head), X_head);
  const Point neck{X_head.p.x(), X_head.p.y(), X_head.p.z()};
  clay.relief([&](Point p) { return p.z > neck.z + 0.05 ? head.band(p - neck) : 0.0; });
  const auto colour = [&](Point p, Point n) {
    const Rgb skin = skinColour(o.look, p, n, clay.open(p, n, p.z > neck.z + 0.06 ? 0.006 : 0.022));
    return p.z > neck.z + 0.02 ? head.colour(p - neck, skin) : skin;
  };
  const auto carriers = [&](Point p) { return carriersAt(clay, p); };
  const auto place = [&](Joint joint, const Vec3& local) {
    const Vec3 p = rest[static_cast<std::size_t>(boneOf(joint))] * local;
    return Point{p.x(), p.y(), p.z()};
  };
  Part part;
  part.finish = {"skin", "", 0.6, 0};
  const Point elbow = place(Joint::RightForearm, {0, 0, 0}),
              hand = place(Joint::RightHand, {0, 0.01, -0.075});
  add(part, clay.cast(kBareStep, elbow - Point{0.13, 0.12, 0.22}, elbow + Point{0.25, 0.26, 0.20}, colour));
  add(part,
      clay.cast(kNearStep, hand - Point{0.095, 0.085, 0.095}, hand + Point{0.095, 0.085, 0.095}, colour));
  Part face = clay.cast(kNearStep, neck - Point{0.105, 0.13, 0.055}, neck + Point{0.105, 0.15, 0.31}, colour);
  head.straighten(face, neck);
  for (Vertex& v : face.vertices) v.colour = colour(v.p, v.n);
  add(part, face);
  for (const Joint joint : {Joint::RightFoot, Joint::LeftFoot}) {
    const Point foot = place(joint, {0, 0.06, -0.04});
    add(part, clay.cast(kBareStep, foot - Point{0.09, 0.17, 0.065}, foot + Point{0.09, 0.17, 0.065}, colour));
  }
  addSurface(model, part, carriers);
  // The left hand, on the mantle.
  Clay fist;
  fist.on(boneOf(Joint::Chest), {{0, 0, kHip}, Quat::Identity()});
  fist.ball({-0.078, 0.178, 0.165}, {0.036, 0.030, 0.040}, 0.02);
  for (int i = 0; i < 4; ++i)
    fist.rod({-0.090, 0.206, 0.195 - 0.019 * i}, {-0.058, 0.204, 0.197 - 0.019 * i}, 0.0105, 0.0095, 0.006);
  Part left =
      fist.cast(kNearStep, [&](Point p, Point n) { return skinColour(o.look, p, n, fist.open(p, n, 0.02)); });
  left.finish = part.finish;
  addSurface(model, left, [&](Point p) { return carriersAt(fist, p); });
}

FigureModel official(const Official& o) {
  FigureModel model{personBones(), {}, {}};
  addRobe(model, o), addBare(model, o);
  return model;
}

/// The right hand goes to another place and back.
Performance gesture(const Performance& still, double duration, const std::vector<Track::Key>& wrist,
                    const std::vector<Track::Key>& gaze) {
  Performance p = standing(still, 0);
  p.duration = duration;
  p.rightWrist = wrist;
  p.gaze = gaze;
  return p;
}

FigureModel judgeModel(const Official& o) {
  FigureModel model = official(o);
  const Performance still = stance(o);
  const auto upright = [](Figure& f, double) { f.grip.q = Quat::Identity(); };
  const Point w = o.wrist, up = o.wrist + Point{0.02, 0.10, 0.22}, g = o.gaze;
  model.clips = {
      clipOf("wait", standing(still, 0), upright),
      clipOf("approve",
             gesture(still, 3.6,
                     {{0, w}, {0.6, up}, {1.0, up - Point{0, 0, 0.05}}, {1.4, up}, {2.2, up}, {3.4, w}},
                     {{0, g},
                      {0.5, g + Point{0, -4, 0}},
                      {0.9, g + Point{0, 10, 0}},
                      {1.3, g},
                      {1.8, g + Point{0, 9, 0}},
                      {2.6, g}}),
             upright)};
  return model;
}

}  // namespace

FigureModel herald() {
  const Official o{{Hair::Fair, Dress::Chiton, 1, {0.80, 0.58, 0.44}, {0.92, 0.89, 0.82}, {}},
                   {0.62, 0.22, 0.18},
                   {0.17, 0.32, 0.44},
                   {1, 0.1, -0.5},
                   {0, -8, 0},
                   -40};
  FigureModel model = official(o);
  Performance call = stance(o);
  const Point down{0.30, 0.16, -0.13};
  // The trumpet is at his mouth while he calls, and then stays as it is in his hand.
  const Figure calling = figureAt(call, 0);
  Pose X_head = calling.joint[0] * calling.joint[1] * calling.joint[2];
  const Pose atMouth = X_head * Pose{{0, 0.105, 0.078}, det::expRotation({10 * kPi / 180, 0, 0})};
  const Pose inHand = calling.hand.inverse() * atMouth;
  const auto carried = [inHand](Figure& f, double) { f.grip = f.hand * inHand; };
  Performance waiting = call;
  waiting.rightWrist = {{{0, down}}}, waiting.rightElbow = {{{0, {0.6, -0.7, -0.4}}}},
  waiting.gaze = {{{0, {0, 0, 0}}}};
  call = standing(call, 0);
  call.duration = 4.6;
  call.rightWrist = {{{0, o.wrist}, {3.1, o.wrist}, {3.9, {0.26, 0.32, 0.16}}, {4.6, down}}};
  call.rightElbow = {{{0, o.elbow}, {3.1, o.elbow}, {4.6, {0.6, -0.7, -0.4}}}};
  call.gaze = {{{0, o.gaze}, {3.2, o.gaze}, {4.4, {0, 0, 0}}}};
  model.clips = {clipOf("call", call, carried), clipOf("wait", standing(waiting, 0), carried)};
  return model;
}

FigureModel judge() {
  return judgeModel({{Hair::Bearded, Dress::Chiton, 1, {0.78, 0.56, 0.42}, {0.50, 0.18, 0.28}, {}},
                     {0.86, 0.74, 0.46},
                     {0.27, 0.27, 0.06},
                     {0.6, -0.8, -0.3},
                     {4, 0, 0},
                     0});
}

Parts staff() {
  Part part = limb({0, 0, -1.10}, {0, 0, 0.42}, 0.012, 0.010, 7);
  for (const double side : {1.0, -1.0})
    add(part, limb({0, 0, 0.40}, {side * 0.055, 0, 0.62}, 0.009, 0.006, 6));
  part.finish = {"wood", "", 0.8, 0};
  paint(part, [](const Vertex& v) {
    return mix(0.85, 1.1, noise({40 * v.p.x, 0, 9 * v.p.z})) * Rgb{0.46, 0.33, 0.20};
  });
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
