#include "assets/generator/olympia/athletes.h"
#include "assets/generator/olympia/script_text.h"

// They stand in robes, of which a head, a bare right arm and the feet look out.

namespace stadion::assets {
namespace {

struct Official {
  const char *name, *robe, *head;
  Point at;
  double yaw;
  Point wrist, elbow, gaze;
  double twist;
};

Performance still(const Official& o) {
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

std::string figure(const Official& o) {
  const Figure figure = figureAt(still(o), 0);
  const auto pose = [&](Joint joint) { return figure.joint[static_cast<std::size_t>(joint)]; };
  const std::string name = o.name;
  std::string out = "group( name=" + name + ", position=\"" + list(Vec3(o.at.x, o.at.y, o.at.z), 2) +
                    "\", orientation=\"0,0," + number(o.yaw, 0) + "\" )\n";
  const auto part = [&](const std::string& joint, const std::string& parent, const Pose& at,
                        const std::string& model) {
    out += "group( name=" + name + "_" + joint + ", parent=" + name + parent + ", " + placed(at) + " )\n";
    if (!model.empty()) out += "object( file=" + model + ".glb, parent=" + name + "_" + joint + " )\n";
  };
  part("pelvis", "", pose(Joint::Pelvis), o.robe);
  part("chest", "_pelvis", pose(Joint::Chest), "");
  part("head", "_chest", pose(Joint::Head), o.head);
  part("arm", "_chest", pose(Joint::RightArm), "athlete_right_upper_arm");
  part("forearm", "_arm", pose(Joint::RightForearm), "athlete_right_forearm");
  part("hand", "_forearm", pose(Joint::RightHand), "athlete_right_hand");
  for (const bool right : {true, false}) {
    Pose X = pose(Joint::Pelvis);
    for (int k = 0; k < 3; ++k)
      X = X * figure.joint[static_cast<std::size_t>(right ? Joint::RightThigh : Joint::LeftThigh) +
                           static_cast<std::size_t>(k)];
    part(right ? "right_foot" : "left_foot", "", X, right ? "athlete_right_foot" : "athlete_left_foot");
  }
  return out;
}

}  // namespace

std::string officialsScript() {
  const Official herald{"herald",       "herald_robe", "herald_head",
                        {-3.6, 5.2, 0}, -35,           {0.17, 0.32, 0.44},
                        {1, 0.1, -0.5}, {0, -8, 0},    -40};
  const Official first{"judge",           "judge_robe", "judge_head",
                       {6.6, 8.5, 0},     125,          {0.24, 0.22, 0.02},
                       {0.6, -0.8, -0.3}, {4, 0, 0},    0};
  const Official second{"second_judge",    "judge_robe", "judge_head",
                        {7.6, 7.9, 0},     105,          {0.28, 0.05, -0.19},
                        {0.5, -0.8, -0.3}, {-14, 2, 0},  0};
  return "# Two judges and a herald beside the start, in the coordinates of the stadium. Written by "
         "stadion-assets.\n\n" +
         figure(herald) +
         "object( file=trumpet.glb, parent=herald_head, position=\"0, 0.105, 0.078\", orientation=\"10, 0, "
         "0\" )\n\n" +
         figure(first) + "\n" + figure(second);
}

}  // namespace stadion::assets
