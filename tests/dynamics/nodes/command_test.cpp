/// What a field does between its commands, however they fall on the steps of contact.

#include "tests/dynamics/world/watch.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

using namespace scenes;

FieldId addPulse(World& w, double push) {
  ForceField f;
  f.law = LinearField{{push, 0, 0}, LinearField::Unit::Acceleration};
  return w.addField(f, false);
}

BodyId addSlider(World& w, FieldId g, FieldId pulse, const Vec3& p, double friction = 0) {
  const BodyId b =
      addBox(w, g, {.half = Vec3::Constant(0.15), .pose = {p, Quat::Identity()}, .friction = friction});
  w.hook(b, pulse, 0);
  return b;
}

TEST(Command, AShortPulseGivesABoxOnTheFloorItsExactSpeedWheneverItComes) {
  for (const Nanoseconds at : {550'200'000, 551'200'000, 550'000'001, 549'999'300, 551'999'999})
    for (const bool moving : {false, true}) {
      World w;
      const FieldId g = addGravity(w), pulse = addPulse(w, 20 * kG);
      addFloor(w);
      const BodyId b = addSlider(w, g, pulse, {0, 0, 0.15});
      const BodyId rider = addSlider(w, g, pulse, {0, 0, 0.45});
      if (moving)
        for (const BodyId it : {b, rider}) w.push(it, Vec3(0, 0.3, 0), w.state(it).p);
      w.switchField(pulse, true, at), w.switchField(pulse, false, at + 1'500'000);
      play(w, 1);
      for (const BodyId it : {b, rider})
        EXPECT_NEAR(w.state(it).v.x(), 20 * kG * 1.5e-3, 1e-9) << at << moving;
    }
}

TEST(Command, PulsesOnABoxThatTurnsOnTheFloorAddUp) {
  // It turns, so that its island takes steps; sideways nothing but the pulses acts.
  World w;
  const FieldId g = addGravity(w), pulse = addPulse(w, 2 * kG);
  addFloor(w);
  const BodyId b = addBox(
      w, g, {.half = Vec3::Constant(0.15), .pose = {{0, 0, 0.15}, Quat::Identity()}, .omega = {0, 0, 1}});
  w.hook(b, pulse, 0);
  for (int k = 0; k < 20; ++k) {
    const Nanoseconds at = 103'100'000 + 53'100'000 * Nanoseconds{k};
    w.switchField(pulse, true, at), w.switchField(pulse, false, at + 1'500'000);
  }
  play(w, 1.3);
  EXPECT_NEAR(w.state(b).v.x(), 20 * 2 * kG * 1.5e-3, 1e-9);
}

TEST(Command, HooksReachABodyInContactAtTheirTime) {
  World w;
  const FieldId g = addGravity(w), pulse = addPulse(w, 20 * kG);
  addFloor(w);
  const BodyId b = addBox(w, g, {.half = Vec3::Constant(0.15), .pose = {{0, 0, 0.15}, Quat::Identity()}});
  w.switchField(pulse, true, 0);
  w.push(b, Vec3(0, 0.3, 0), w.state(b).p);
  w.hook(b, pulse, 300'700'000), w.unhook(b, pulse, 301'100'000);
  play(w, 1);
  EXPECT_NEAR(w.state(b).v.x(), 20 * kG * 0.4e-3, 1e-9);
}

TEST(Command, AHeapOnTheFloorTakesAPulseAtItsTime) {
  World w;
  const FieldId g = addGravity(w), pulse = addPulse(w, 20 * kG);
  addFloor(w);
  std::vector<BodyId> heap;
  for (int i = 0; i < 18; ++i)
    heap.push_back(addSlider(w, g, pulse, {0.3001 * (i % 6), 0.3 * (i / 6), 0.15}));
  w.switchField(pulse, true, 203'300'000), w.switchField(pulse, false, 204'800'000);
  play(w, 0.5);
  double mean = 0;
  for (const BodyId b : heap) mean += w.state(b).v.x() / 18;
  EXPECT_NEAR(mean, 20 * kG * 1.5e-3, 1e-4);
}

TEST(Command, ABoxUnderAStrengthThatGrowsGoesAsFarAtEveryFrameRate) {
  // Steps end with the frames, beyond which the strength is unknown; parts may be a nanosecond long.
  for (const double rate : {30., 60., 97., 240., 1000.}) {
    World w;
    const FieldId g = addGravity(w), push = addPulse(w, 4);
    addFloor(w);
    const BodyId b = addSlider(w, g, push, {0, 0, 0.15});
    w.switchField(push, true, 0);
    double worst = 0, off = 0;
    for (std::uint64_t n = 1; n <= static_cast<std::uint64_t>(2 * rate); ++n) {
      const TimeSignature s = signatureAt(n, rate);
      Nanoseconds from = s.time - s.step;
      for (const Nanoseconds to : {from + 1, from + 2, s.time}) {
        w.setFieldStrength(push, toSeconds(from), toSeconds(to));
        w.advance(from, to, to != s.time - s.step + 1);
        from = to;
      }
      const double t = toSeconds(s.time);
      worst = std::max(worst, std::fabs(w.state(b).p.x() - 4 * t * t * t / 6));
      off = std::max(off, std::fabs(w.state(b).v.x() - 2 * t * t));
    }
    std::printf("  %g Hz: %.1e m\n", rate, worst);
    EXPECT_LE(worst, 4e-6) << rate;
    EXPECT_LE(off, 1e-8) << rate;
  }
}

}  // namespace
}  // namespace stadion
