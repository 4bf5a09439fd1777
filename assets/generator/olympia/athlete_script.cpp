#include "assets/generator/olympia/athletes.h"
#include "assets/generator/olympia/script_text.h"

// Poses are taken thirty times a second; those that a path finds by itself between its neighbours are left
// out.

namespace stadion::assets {
namespace {

constexpr double kSample = 1.0 / 30;            // [s]
constexpr double kPlaceError = 0.002;           // [m]
constexpr double kTurnError = 0.5 * kPi / 180;  // [rad]
constexpr double kBreath = 3.6, kIdle = 115.2;  // [s] one breath; one pass of the idle paths

// Messages act so long after their events, the same at every frame rate from 50 Hz on.
constexpr double kLatency = 0.02;  // [s]
constexpr double kStart = 0.05;    // [s] from `go, enable` to the first movement

struct JointName {
  const char *name, *parent, *model;
};
// In the order of Joint.
constexpr JointName kNames[kJoints] = {{"pelvis", "", "pelvis"},
                                       {"chest", "pelvis", "chest"},
                                       {"head", "breath", ""},
                                       {"right_arm", "breath", "right_upper_arm"},
                                       {"right_forearm", "right_arm", "right_forearm"},
                                       {"right_hand", "right_forearm", "right_hand"},
                                       {"left_arm", "breath", "left_upper_arm"},
                                       {"left_forearm", "left_arm", "left_forearm"},
                                       {"left_hand", "left_forearm", "left_hand"},
                                       {"right_thigh", "pelvis", "right_thigh"},
                                       {"right_shin", "right_thigh", "right_shin"},
                                       {"right_foot", "right_shin", "right_foot"},
                                       {"left_thigh", "pelvis", "left_thigh"},
                                       {"left_shin", "left_thigh", "left_shin"},
                                       {"left_foot", "left_shin", "left_foot"}};

/// The same turn, written so that it goes on from `before`.
Vec3 goingOn(const Vec3& a, const Vec3& before) {
  Vec3 best = a;
  double least = 1e9;
  for (const Vec3& form : {a, Vec3(a.x() + 180, 180 - a.y(), a.z() + 180)}) {
    Vec3 near = form;
    for (int k = 0; k < 3; ++k) near[k] -= 360 * std::floor((near[k] - before[k]) / 360 + 0.5);
    if ((near - before).norm() < least) best = near, least = (near - before).norm();
  }
  return best;
}

struct Sample {
  double time;
  Pose pose;
};
using Samples = std::vector<Sample>;

bool between(const Samples& all, std::size_t a, std::size_t b) {
  for (std::size_t i = a + 1; i < b; ++i) {
    const Pose guess =
        det::interpolate(all[a].pose, all[b].pose, (all[i].time - all[a].time) / (all[b].time - all[a].time));
    const Quat off = guess.q.conjugate() * all[i].pose.q;
    if ((guess.p - all[i].pose.p).norm() > kPlaceError || det::logRotation(off).norm() > kTurnError)
      return false;
  }
  return true;
}

Samples thinned(const Samples& all) {
  Samples kept{all.front()};
  for (std::size_t at = 0; at + 1 < all.size();) {
    std::size_t next = at + 1;
    while (next + 1 < all.size() && between(all, at, next + 1)) ++next;
    kept.push_back(all[at = next]);
  }
  return kept;
}

std::string path(const std::string& target, Samples samples, const std::string& more) {
  std::string out = "path( name=move_" + target + ", target=" + target + ", initstate=off" + more;
  int column = 0;
  Vec3 turn = angles(samples.front().pose.q);
  for (const Sample& s : thinned(samples)) {
    turn = goingOn(angles(s.pose.q), turn);
    out += (column++ % 3 == 0 ? ",\n      key=\"" : ", key=\"") + number(s.time, 3) + ", " +
           list(s.pose.p, 3) + ", " + list(turn, 1) + "\"";
  }
  return out + " )\n";
}

/// Chest and head of a waiting athlete: he breathes and looks about. Passes are long, so that few ends are
/// reported.
std::string idle() {
  std::string out = "# He breathes, and his head is never quite still.\n"
                    "group( name=breath, parent=chest )\npath( target=breath, loop=on, smooth=on";
  const int breaths = static_cast<int>(kIdle / kBreath + 0.5);
  for (int i = 0; i <= 2 * breaths; ++i)
    out += (i % 6 == 0 ? ",\n      key=\"" : ", key=\"") + number(0.5 * kBreath * i, 2) +
           (i % 2 == 0 ? ", 0,0,0\"" : ", 0,0.003,0.004\"");
  out += " )\ngroup( name=look, parent=head )\npath( target=look, loop=on";
  Dice dice(7);
  int column = 0;
  Vec3 to = Vec3::Zero();
  for (double t = 0; t < kIdle - 3; t += dice.between(2, 5)) {
    const Vec3 from = to;
    if (t > 0) to = Vec3(dice.between(-3, 3), 0, dice.between(-9, 9));
    out += (column++ % 4 == 0 ? ",\n      key=\"" : ", key=\"") + number(t, 2) + ", 0,0,0, " + list(from, 1) +
           "\"";
    out += ", key=\"" + number(t + 0.9, 2) + ", 0,0,0, " + list(to, 1) + "\"";
  }
  return out + ", key=\"" + number(kIdle, 2) + ", 0,0,0, 0,0,0\" )\n";
}

struct Role {
  std::string title, head, held;  ///< held: the object's declaration, named `held`
  Performance performance;
  enum { InHand, Aimed, OnGround } keeps = InHand;  ///< how what is held goes
};

/// Where what was held is when he lets it go.
Vec3 leaving(const Role& role) {
  const Figure figure = figureAt(role.performance, role.performance.release);
  if (role.keeps == Role::OnGround) return {0, 0, 0.11};
  return role.keeps == Role::Aimed ? figure.grip.p : figure.hand * Vec3(-0.032, 0, -0.125);
}

std::string script(const Role& role) {
  const Performance& p = role.performance;
  std::vector<std::string> targets;
  std::vector<Samples> joints(kJoints);
  Samples held;
  const int count = static_cast<int>(p.duration / kSample + 0.5);
  for (int i = 0; i <= count; ++i) {
    const double time = std::min(i * kSample, p.duration);
    const Figure figure = figureAt(p, time);
    for (std::size_t k = 0; k < kJoints; ++k) joints[k].push_back({time, figure.joint[k]});
    if (time <= p.release + kSample) held.push_back({time, figure.grip});
  }
  std::string out =
      "# " + role.title +
      "\n# Written by stadion-assets. His place is the origin; he looks and throws along +Y.\n#\n" +
      "#   go, enable      he begins; " + number(kStart + p.duration, 2) +
      " s later he stands still again, and move_pelvis has finished\n" +
      "#   again, enable   he is back at the start at once\n#\n" + "# " + number(kStart + p.release, 2) +
      " s after `go, enable` `held` leaves him and is hidden. " + "It is then at (" + list(leaving(role), 2) +
      ").\n" + "\n";
  for (std::size_t k = 0; k < kJoints; ++k) {
    const JointName& joint = kNames[k];
    const std::string parent = joint.parent;
    out += std::string("group( name=") + joint.name + (parent.empty() ? "" : ", parent=" + parent) + ", " +
           placed(joints[k].front().pose) + " )\n";
    const bool isHead = k == static_cast<std::size_t>(Joint::Head),
               isChest = k == static_cast<std::size_t>(Joint::Chest);
    out += "object( file=athlete_" + (isHead ? "head_" + role.head : std::string(joint.model)) +
           ".glb, parent=" +
           (isHead    ? "look"
            : isChest ? "breath"
                      : joint.name) +
           " )\n";
    targets.push_back(joint.name);
  }
  out += role.held + "\n";
  if (role.keeps == Role::Aimed) {
    joints.push_back(held);
    out += "group( name=aim, " + placed(held.front().pose) + " )\n";
    targets.push_back("aim");
  }
  out += idle();
  // Only the pelvis tells the end; it stops the others just before theirs.
  std::string paths, stops;
  for (std::size_t k = 1; k < targets.size(); ++k) {
    stops += ",\n      eventmessage=\"finished, move_" + targets[k] + ", disable\"";
    joints[k].push_back({p.duration + 0.2, joints[k].back().pose});
    paths += path(targets[k], joints[k], "");
  }
  paths = path(targets[0], joints[0], stops) + paths;
  const auto timer = [](const std::string& name, double period) {
    return "timer( name=" + name + ", period=" + number(period, 3) + ", initstate=off";
  };
  out += "\n" + timer("go", kStart - kLatency);
  const auto message = [](const std::string& to, const std::string& command) {
    return ",\n       eventmessage=\"timesup, " + to + ", " + command + ", latency=" + number(kLatency, 3) +
           "\"";
  };
  std::string starts, resets = message("held", "show");
  for (const std::string& target : targets) {
    resets += message("move_" + target, "reset");
    starts += message("move_" + target, "enable");
  }
  out += resets + starts + message("release", "enable") + " )\n";
  out += timer("release", p.release - kLatency) + message("held", "hide") + " )\n";
  out += timer("again", 0.001) + resets + message("release", "reset") + " )\n\n";
  return out + paths;
}

}  // namespace

std::string discusScript() {
  return script({"The discus thrower.", "dark",
                 "object( name=held, file=discus.glb, parent=right_hand, position=\"-0.032, 0, -0.125\", "
                 "orientation=\"0, 90, 0\" )",
                 discusThrow()});
}

std::string javelinScript() {
  return script({"The javelin thrower: four metres of run-up.", "fair",
                 "object( name=held, file=javelin.glb, parent=aim )", javelinThrow(), Role::Aimed});
}

std::string ballScript() {
  return script({"The ball player: three steps and a kick.", "beard",
                 "object( name=held, file=leather_ball.glb, position=\"0, 0, 0.11\" )", ballKick(),
                 Role::OnGround});
}

}  // namespace stadion::assets
