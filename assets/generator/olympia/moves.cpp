#include "assets/generator/olympia/athletes.h"

// What athletes do beside their performances.

namespace stadion::assets {
namespace {

constexpr double kWait = 14.4;  // [s] four breaths

Track shifted(const Track& track, double time, std::vector<Track::Key> by) {
  for (Track::Key& key : by) key.value = track.at(time) + key.value;
  return {std::move(by)};
}

Track held(const Track& track, double time) {
  return {{{0, track.at(time)}}};
}

/// Where a foot stands at a time between its steps.
Foot stood(const Foot& foot, double time) {
  Foot now{foot.start, foot.yaw, {}};
  for (const Step& step : foot.steps)
    if (time >= step.land) now.start = step.to, now.yaw = step.yaw;
  return now;
}

/// All as at this time of another performance, and so it stays.
Performance stayed(const Performance& p, double time, double duration) {
  return {.duration = duration,
          .release = duration,
          .pelvis = held(p.pelvis, time),
          .pelvisTurn = held(p.pelvisTurn, time),
          .chestTurn = held(p.chestTurn, time),
          .gaze = held(p.gaze, time),
          .rightWrist = held(p.rightWrist, time),
          .leftWrist = held(p.leftWrist, time),
          .rightElbow = held(p.rightElbow, time),
          .leftElbow = held(p.leftElbow, time),
          .rightTwist = held(p.rightTwist, time),
          .rightFoot = stood(p.rightFoot, time),
          .leftFoot = stood(p.leftFoot, time),
          .aim = held(p.aim, time)};
}

}  // namespace

Performance standing(const Performance& as, double time) {
  Performance p = stayed(as, time, kWait);
  std::vector<Track::Key> breath, wrist, sway;
  for (int i = 0; i <= 8; ++i) {
    const double t = kWait / 8 * i, in = i % 2;
    breath.push_back({t, {0, -1.4 * in, 0}});
    wrist.push_back({t, {0, 0.002 * in, 0.007 * in}});
  }
  for (const auto& [t, x] :
       {std::pair{0.0, 0.0}, {3.0, 0.018}, {6.5, 0.014}, {9.5, -0.020}, {12.0, -0.012}, {14.4, 0.0}})
    sway.push_back({t, {x, 0, -0.15 * std::fabs(x)}});
  p.chestTurn = shifted(as.chestTurn, time, breath);
  p.rightWrist = shifted(as.rightWrist, time, wrist), p.leftWrist = shifted(as.leftWrist, time, wrist);
  p.pelvis = shifted(as.pelvis, time, sway);
  p.gaze = shifted(as.gaze, time,
                   {{0, {0, 0, 0}},
                    {2.2, {0, 0, 0}},
                    {3.0, {14, 3, 0}},
                    {5.4, {12, 2, 0}},
                    {6.3, {-4, -3, 0}},
                    {8.6, {-6, -2, 0}},
                    {9.5, {-22, 4, 0}},
                    {11.8, {-20, 3, 0}},
                    {12.9, {0, 0, 0}},
                    {14.4, {0, 0, 0}}});
  return p;
}

Performance cheering(const Performance& after) {
  const double end = after.duration;
  Performance p = stayed(after, end, 2.6);
  const Point right = after.rightWrist.at(end), left = after.leftWrist.at(end);
  p.rightWrist = {{{0, right},
                   {0.45, {0.36, 0.20, 0.74}},
                   {0.8, {0.34, 0.24, 0.60}},
                   {1.15, {0.38, 0.16, 0.80}},
                   {1.7, {0.36, 0.18, 0.76}},
                   {2.55, right}}};
  p.leftWrist = {{{0, left},
                  {0.5, {-0.36, 0.18, 0.72}},
                  {0.8, {-0.34, 0.24, 0.58}},
                  {1.2, {-0.38, 0.14, 0.80}},
                  {1.65, {-0.36, 0.18, 0.74}},
                  {2.55, left}}};
  p.rightElbow = {{{0, after.rightElbow.at(end)},
                   {0.45, {0.9, 0.3, -0.1}},
                   {1.7, {0.9, 0.3, -0.1}},
                   {2.55, after.rightElbow.at(end)}}};
  p.leftElbow = {{{0, after.leftElbow.at(end)},
                  {0.45, {-0.9, 0.3, -0.1}},
                  {1.7, {-0.9, 0.3, -0.1}},
                  {2.55, after.leftElbow.at(end)}}};
  p.chestTurn = shifted(after.chestTurn, end,
                        {{0, {0, 0, 0}}, {0.5, {0, -9, 0}}, {1.7, {0, -8, 0}}, {2.55, {0, 0, 0}}});
  p.gaze =
      shifted(after.gaze, end, {{0, {0, 0, 0}}, {0.5, {0, -14, 0}}, {1.6, {24, -8, 0}}, {2.55, {0, 0, 0}}});
  p.pelvis = shifted(after.pelvis, end,
                     {{0, {0, 0, 0}},
                      {0.25, {0, 0, -0.05}},
                      {0.5, {0, 0, 0.01}},
                      {0.8, {0, 0, -0.03}},
                      {1.1, {0, 0, 0.01}},
                      {2.55, {0, 0, 0}}});
  return p;
}

namespace {

constexpr double kTurn = 1.0, kStride = 0.46;  // [s]

/// Feet and pelvis of a person who turns, walks and turns.
class Walk {
public:
  Walk(const Performance& after, Point from, Point to)
      : right_(stood(after.rightFoot, after.duration)), left_(stood(after.leftFoot, after.duration)),
        endRight_(after.rightFoot), endLeft_(after.leftFoot) {
    const Point way = to - from;
    heading_ = 180 / kPi * det::atan2(-way.x, way.y);
    if (heading_ < 0) heading_ += 360;
    strides_ = std::max(static_cast<int>(length({way.x, way.y, 0}) / 0.62 + 0.5), 1);
    end_ = kTurn + strides_ * kStride;
    turnAt(0, from, 0, heading_);
    for (int i = 0; i < strides_; ++i) {
      const double lift = kTurn + i * kStride - 0.04, share = std::min((i + 1.0) / strides_, 1.0);
      step(i % 2 == 0, {lift, lift + kStride + 0.02, mix(from, to, share), heading_, 0.11}, 0.085);
    }
    turnAt(end_, to, heading_, 360);
    right_.steps.push_back({end_ + 0.72, end_ + 1.02, endRight_.start, 360 + endRight_.yaw, 0.07});
    left_.steps.push_back({end_ + 1.0, end_ + 1.26, endLeft_.start, 360 + endLeft_.yaw, 0.06});
  }

  double end() const { return end_ + 1.4; }
  double heading() const { return heading_; }
  double turned() const { return kTurn; }
  double arrived() const { return end_; }
  int strides() const { return strides_; }
  Foot right() const { return right_; }
  Foot left() const { return left_; }

private:
  /// A foot comes down beside the way.
  void step(bool right, Step s, double beside) {
    const double yaw = s.yaw * kPi / 180;
    const Point aside = turned({right ? beside : -beside, 0, 0}, yaw);
    s.to = {s.to.x + aside.x, s.to.y + aside.y, 0};
    (right ? right_ : left_).steps.push_back(s);
  }
  static Point turned(Point p, double yaw) { return assets::turned(p, yaw); }

  void turnAt(double t, Point at, double a, double b) {
    step(false, {t + 0.05, t + 0.33, at, mix(a, b, 0.45), 0.08}, 0.10);
    step(true, {t + 0.30, t + 0.60, at, mix(a, b, 0.62), 0.08}, 0.10);
    step(false, {t + 0.58, t + 0.84, at, b, 0.07}, 0.10);
  }

  Foot right_, left_, endRight_, endLeft_;
  double heading_ = 0, end_ = 0;
  int strides_ = 0;
};

}  // namespace

Performance walkingBack(const Performance& after) {
  const Point from = after.pelvis.at(after.duration), to = after.pelvis.at(0);
  const Walk walk(after, {from.x, from.y, 0}, {to.x, to.y, 0});
  Performance p = stayed(after, after.duration, walk.end());
  std::vector<Track::Key> pelvis{{0, from}, {0.5, from + Point{0, 0, -0.02}}};
  std::vector<Track::Key> right{{0, after.rightWrist.at(after.duration)}},
      left{{0, after.leftWrist.at(after.duration)}};
  std::vector<Track::Key> chest{{0, after.chestTurn.at(after.duration)}};
  for (int i = 0; i <= 2 * walk.strides(); ++i) {
    const double t = walk.turned() - 0.1 + i * kStride / 2, share = i / (2.0 * walk.strides());
    const Point at = mix(from, to, smoothstep(-0.04, 1.04, share) * 0.35 + share * 0.65);
    pelvis.push_back({t, {at.x, at.y, i % 2 == 0 ? 0.886 : 0.905}});
    if (i % 2 != 0 || i == 0) continue;
    const double side = i / 2 % 2 == 0 ? 1 : -1;
    right.push_back({t, {0.265, 0.06 + 0.15 * side, -0.17}});
    left.push_back({t, {-0.265, 0.06 - 0.15 * side, -0.17}});
    chest.push_back({t, {5 * side, 3, 0}});
  }
  pelvis.push_back({walk.arrived() + 0.45, to + Point{0, 0, -0.02}}), pelvis.push_back({walk.end(), to});
  right.push_back({walk.end() - 0.1, after.rightWrist.at(0)}),
      left.push_back({walk.end() - 0.1, after.leftWrist.at(0)});
  chest.push_back({walk.end() - 0.1, after.chestTurn.at(0)});
  const double h = walk.heading(), go = walk.turned(), stop = walk.arrived();
  p.pelvis = pelvis, p.rightWrist = right, p.leftWrist = left, p.chestTurn = chest;
  p.pelvisTurn = {{{0, after.pelvisTurn.at(after.duration)},
                   {go - 0.05, {h, 2, 0}},
                   {stop, {h, 2, 0}},
                   {stop + 0.95, Point{360, 0, 0} + after.pelvisTurn.at(0)}}};
  p.gaze = {{{0, after.gaze.at(after.duration)},
             {go - 0.25, {h, 8, 0}},
             {stop - 0.2, {h, 10, 0}},
             {stop + 0.75, Point{360, 0, 0} + after.gaze.at(0)}}};
  p.rightElbow = {{{0, after.rightElbow.at(after.duration)},
                   {go, {0.45, -0.75, -0.35}},
                   {stop, {0.45, -0.75, -0.35}},
                   {walk.end(), after.rightElbow.at(0)}}};
  p.leftElbow = {{{0, after.leftElbow.at(after.duration)},
                  {go, {-0.45, -0.75, -0.35}},
                  {stop, {-0.45, -0.75, -0.35}},
                  {walk.end(), after.leftElbow.at(0)}}};
  p.rightTwist = {
      {{0, after.rightTwist.at(after.duration)}, {stop, {0, 0, 0}}, {walk.end(), after.rightTwist.at(0)}}};
  p.rightFoot = walk.right(), p.leftFoot = walk.left();
  return p;
}

}  // namespace stadion::assets
