#include "assets/generator/olympia/spectators.h"

#include "assets/generator/craft/sculpt.h"

// Each is of clay on seven bones of their own. All sit or stand in their place at rest, hands in the lap.

namespace stadion::assets {
namespace {

constexpr double kWaitLength = 12, kCheerLength = 4, kEvery = 0.1;  // [s]

enum Piece { Seat, Trunk, Skull, RightUpper, RightLower, LeftUpper, LeftLower, kPieces };
constexpr const char* kPieceNames[] = {"seat",          "chest",    "head",        "right_arm",
                                       "right_forearm", "left_arm", "left_forearm"};
constexpr int kPieceParents[] = {-1, Seat, Trunk, Trunk, RightUpper, Trunk, LeftUpper};

/// Joints in the person's own place; bones have no turn at rest.
std::array<Vec3, kPieces> jointsOf(const Person& person) {
  const double hip = person.standing ? 0.88 : 0.12;
  return {Vec3(0, 0, 0),
          Vec3(0, 0, hip + 0.08),
          Vec3(0, -0.005, hip + 0.525),
          Vec3(0.18, 0, hip + 0.5),
          Vec3(0.245, 0.04, hip + 0.24),
          Vec3(-0.18, 0, hip + 0.5),
          Vec3(-0.245, 0.04, hip + 0.24)};
}

Point pointOf(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

void addCloth(Clay& clay, const Person& person) {
  const auto on = [&](Piece piece) { clay.on(piece, {}); };
  const double hip = person.standing ? 0.88 : 0.12;
  on(Seat);
  if (person.standing) {
    clay.rod({0, 0, 0.1}, {0, 0, hip}, 0.19, 0.155);
  } else {
    clay.ball({0, 0.02, 0.11}, {0.20, 0.19, 0.15}, 0.06);
    clay.rods({0.09, 0.02, 0.12}, {0.105, 0.37, 0.36}, 0.105, 0.078, 0.06);
    clay.rods({0.105, 0.38, 0.35}, {0.10, 0.44, 0.05}, 0.072, 0.060, 0.05);
    clay.rod({0, 0.10, 0.13}, {0, 0.38, 0.20}, 0.09, 0.085, 0.10);
  }
  on(Trunk);
  clay.ball({0, 0, hip + 0.24}, {0.175, 0.125, 0.27}, 0.08)
      .ball({0, -0.01, hip + 0.45}, {0.135, 0.09, 0.10}, 0.06);
  clay.rods({0.03, -0.02, hip + 0.535}, {0.15, -0.01, hip + 0.475}, 0.052, 0.056, 0.05);
  for (const double side : {1.0, -1.0}) {
    on(side > 0 ? RightUpper : LeftUpper);
    clay.ball({side * 0.17, 0, hip + 0.47}, {0.062, 0.062, 0.058}, 0.06)
        .rod({side * 0.185, 0, hip + 0.45}, {side * 0.222, 0.025, hip + 0.33}, 0.052, 0.058, 0.05);
  }
}

void addBare(Clay& clay, const Person& person, const std::array<Vec3, kPieces>& joints) {
  const double hip = person.standing ? 0.88 : 0.12;
  for (const double side : {1.0, -1.0}) {
    const Point elbow = pointOf(joints[side > 0 ? RightLower : LeftLower]);
    const Point hand{side * 0.13, 0.27, hip + (person.standing ? 0.14 : 0.26)};
    clay.on(side > 0 ? RightUpper : LeftUpper, {})
        .rod({side * 0.215, 0.02, hip + 0.36}, elbow, 0.046, 0.040, 0.03);
    clay.on(side > 0 ? RightLower : LeftLower, {}).rod(elbow, hand, 0.040, 0.028, 0.03);
    clay.ball(hand + Point{-side * 0.02, 0.04, 0}, {0.032, 0.050, 0.024}, 0.03);
  }
  const Point neck = pointOf(joints[Skull]);
  clay.on(Skull, {});
  clay.rod(neck - Point{0, 0, 0.06}, neck + Point{0, 0.005, 0.07}, 0.055, 0.052, 0.03);
  clay.ball(neck + Point{0, -0.004, 0.165}, {0.084, 0.102, 0.094}, 0.03)
      .ball(neck + Point{0, 0.036, 0.11}, {0.066, 0.066, 0.086}, 0.03);
  clay.rod(neck + Point{0, 0.092, 0.145}, neck + Point{0, 0.112, 0.108}, 0.010, 0.014, 0.012);
  if (person.beard) clay.ball(neck + Point{0, 0.062, 0.05}, {0.050, 0.046, 0.052}, 0.02);
  if (person.hat)
    clay.ball(neck + Point{0, 0, 0.215}, {0.17, 0.18, 0.022}, 0.02)
        .ball(neck + Point{0, -0.005, 0.25}, {0.085, 0.095, 0.06}, 0.03);
  else
    clay.ball(neck + Point{0, -0.022, 0.185}, {0.092, 0.102, 0.094}, 0.01);
}

Rgb faceColour(const Person& person, Point p) {  // p: from the neck
  if (person.hat && p.z > 0.195) return {0.80, 0.68, 0.42};
  const double eye = std::min(length(p - Point{0.03, 0.088, 0.14}), length(p - Point{-0.03, 0.088, 0.14}));
  if (eye < 0.020) return 0.40 * person.skin;
  if (person.beard && p.z < 0.085 && p.z > 0.01 && p.y > 0.01) return person.hair;
  const bool hair = p.z > 0.205 - 0.4 * std::max(p.y - 0.03, 0.0) || (p.y < 0.015 && p.z > 0.085);
  return hair ? person.hair : person.skin;
}

/// Appends one person, whose bones begin at `first`.
void addPerson(FigureModel& model, SkinnedPart& people, const Spectator& s, int first, double step) {
  const auto joints = jointsOf(s.person);
  const Pose place{{s.at.x, s.at.y, s.at.z}, det::expRotation({0, 0, s.yaw})};
  for (int k = 0; k < kPieces; ++k) {
    const int parent = kPieceParents[k];
    const Vec3 at = s.size * (joints[static_cast<std::size_t>(k)] -
                              (parent < 0 ? Vec3(0, 0, 0) : joints[static_cast<std::size_t>(parent)]));
    const std::string name = std::string(kPieceNames[k]) + "_" + std::to_string(1 + (first - 1) / kPieces);
    model.bones.push_back(
        {name, parent < 0 ? 0 : first + parent, parent < 0 ? place : Pose{at, Quat::Identity()}});
  }
  Clay clay;
  addCloth(clay, s.person);
  const auto fold = [&](Point p) {
    return det::sin(17 * det::atan2(p.x, p.y + 0.03) + 9 * p.z +
                    3 * noise(5 * p + Point{s.person.turn, 0, 0}));
  };
  clay.relief([&](Point p) { return 0.006 + 0.010 * fold(p); });
  const auto cloth = [&](Point p, Point n) {
    const double shade = mix(0.72, 1.03, 0.5 + 0.5 * fold(p)) * mix(0.78, 1.0, smoothstep(0, 0.5, p.z)) *
                         mix(0.62, 1.0, smoothstep(0, 0.8, clay.open(p, n, 0.04)));
    return shade * s.person.cloth;
  };
  Clay bare;
  addBare(bare, s.person, joints);
  const Point neck = pointOf(joints[Skull]);
  const auto skin = [&](Point p, Point n) {
    const Rgb colour =
        p.z > neck.z - 0.02 && std::fabs(p.x) < 0.19 ? faceColour(s.person, p - neck) : s.person.skin;
    return mix(0.82, 1.0, smoothstep(-0.5, 0.3, n.z)) *
           mix(0.7, 1.0, smoothstep(0, 0.8, bare.open(p, n, 0.03))) * colour;
  };
  const auto append = [&](const Clay& from, double size, const std::function<Rgb(Point, Point)>& colour) {
    Part part = from.cast(size, colour);
    dropFlat(part);
    std::erase_if(part.triangles, [&](const auto& t) {  // what the ground hides
      return std::all_of(t.begin(), t.end(), [&](std::uint32_t c) { return part.vertices[c].p.z < 0.02; });
    });
    for (const Vertex& v : part.vertices) {
      std::vector<double> pulls = from.pulls(v.p, kPieces, 0.03);
      std::array<std::pair<double, int>, kPieces> order;
      for (int k = 0; k < kPieces; ++k)
        order[static_cast<std::size_t>(k)] = {-pulls[static_cast<std::size_t>(k)], k};
      std::sort(order.begin(), order.end());
      Carriers c;
      double sum = 0;
      for (std::size_t k = 0; k < 4; ++k) {
        c.weight[k] = -order[k].first < 0.03 ? 0 : -order[k].first;
        c.bone[k] = first + order[k].second;
        sum += c.weight[k];
      }
      for (double& w : c.weight) w /= sum;
      people.carriers.push_back(c);
    }
    add(people.part, part, {s.at, s.yaw, {s.size, s.size, s.size}});
  };
  append(clay, step, cloth);
  append(bare, 0.50 * step, skin);
}

/// A smooth motion that repeats, from -1 to 1.
class Wander {
public:
  Wander(Dice& dice)
      : a_(1 + dice.roll(2)), b_(3 + dice.roll(3)), phaseA_(dice.between(0, 2 * kPi)),
        phaseB_(dice.between(0, 2 * kPi)) {}
  double at(double turn) const {
    return 0.65 * det::sin(2 * kPi * a_ * turn + phaseA_) + 0.35 * det::sin(2 * kPi * b_ * turn + phaseB_);
  }

private:
  double a_, b_, phaseA_, phaseB_;
};

class Moves {
public:
  Moves(const Person& person, Dice& dice)
      : lean_(dice), twist_(dice), look_(dice), nod_(dice), arms_(dice), late_(dice.between(0, 0.5)),
        beat_(dice.between(1.6, 2.3)), up_(person.raised > 0 ? 2 : static_cast<int>(dice.roll(3))) {}

  /// The turns of the bones: lean, twist, ... as degrees about X, Y and Z.
  std::array<Vec3, kPieces> at(double time, bool cheering) const {
    const double t = time / kWaitLength;
    // A cheer ends as it begins, which is as the wait does.
    const double e = cheering ? smoothstep(late_, late_ + 0.5, time) *
                                    smoothstep(kCheerLength - 0.1, kCheerLength - 1.1, time)
                              : 0;
    const double still = cheering ? 0 : t;
    const double wave = det::sin(2 * kPi * beat_ * (time - late_));
    std::array<Vec3, kPieces> turn;
    turn.fill(Vec3::Zero());
    turn[Trunk] =
        Vec3(3.5 * lean_.at(still) + e * (7 + 3 * wave), 1.5 * twist_.at(still), 7 * twist_.at(still));
    turn[Skull] = Vec3(-5 * nod_.at(still) + e * (8 - 3 * wave), 0, 24 * look_.at(still));
    for (const double side : {1.0, -1.0}) {
      const bool raises = up_ == 2 || (up_ == 1 && side > 0);
      Vec3 &upper = turn[side > 0 ? RightUpper : LeftUpper], &lower = turn[side > 0 ? RightLower : LeftLower];
      upper = Vec3(3 * arms_.at(still), 0, 0);
      if (raises) {
        upper += e * Vec3(118 + 8 * wave, -side * 22, 0);
        lower += e * Vec3(38 - 14 * wave, 0, -side * 26);
      } else {  // claps
        upper += e * Vec3(24, 0, 0);
        lower += e * Vec3(26, 0, side * (14 + 14 * wave));
      }
    }
    return turn;
  }
  double rise(double time) const {
    const double e =
        smoothstep(late_, late_ + 0.5, time) * smoothstep(kCheerLength - 0.1, kCheerLength - 1.1, time);
    return up_ == 2 ? 0.05 * e * (1 + det::sin(2 * kPi * beat_ * (time - late_))) : 0;
  }

private:
  Wander lean_, twist_, look_, nod_, arms_;
  double late_, beat_;
  int up_;
};

ClipModel clipOfAll(const std::string& name, double length, const FigureModel& model,
                    const std::vector<Moves>& moves) {
  ClipModel clip{name, {}, {}};
  const bool cheering = name == "cheer";
  for (int i = 0; i <= static_cast<int>(length / kEvery + 0.5); ++i) {
    const double time = i * kEvery;
    std::vector<Pose> poses;
    for (const BoneModel& bone : model.bones) poses.push_back(bone.rest);
    for (std::size_t m = 0; m < moves.size(); ++m) {
      const auto turns = moves[m].at(time, cheering);
      for (std::size_t k = 0; k < kPieces; ++k)
        poses[1 + m * kPieces + k].q =
            (poses[1 + m * kPieces + k].q * det::expRotation(kPi / 180 * turns[k])).normalized();
      if (cheering) poses[1 + m * kPieces + Trunk].p.z() += moves[m].rise(time);
    }
    clip.times.push_back(time);
    clip.poses.push_back(std::move(poses));
  }
  return clip;
}

}  // namespace

FigureModel nearSpectators(double side) {
  FigureModel model{{{"root", -1, {}}}, {}, {}};
  SkinnedPart people;
  people.part.finish = {"people", "", 0.95, 0};
  const std::vector<Spectator> all = spectatorsOn(side);
  Dice dice(side > 0 ? 21 : 22);
  std::vector<Moves> moves;
  for (std::size_t i = 0; i < std::min(all.size(), kNearSpectators); ++i) {
    addPerson(model, people, all[i], static_cast<int>(1 + i * kPieces), all[i].near < 8.5 ? 0.062 : 0.100);
    moves.emplace_back(all[i].person, dice);
  }
  model.parts.push_back(std::move(people));
  model.clips = {clipOfAll("wait", kWaitLength, model, moves),
                 clipOfAll("cheer", kCheerLength, model, moves)};
  return model;
}

}  // namespace stadion::assets
