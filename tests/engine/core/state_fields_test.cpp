#include "engine/core/state_fields.h"

#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace stadion {
namespace {

enum class Colour : std::uint8_t { Red, Green };
constexpr Colour lastOf(Colour) {
  return Colour::Green;
}

struct Part {
  double weight = 0;
  std::string name;

  template <class Self, class Fields>
  static void fields(Self& p, Fields& f) {
    f("weight", p.weight), f("name", p.name);
  }
};

struct Whole {
  bool on = false;
  std::int64_t time = 0;
  std::uint32_t count = 0;
  Colour colour = Colour::Red;
  Vec3 place = Vec3::Zero();
  Pose pose;
  std::optional<double> limit;
  std::vector<Part> parts;
  std::map<std::uint32_t, std::string> names;
  NodeRef node;

  template <class Self, class Fields>
  static void fields(Self& w, Fields& f) {
    f("on", w.on), f("time", w.time), f("count", w.count), f("colour", w.colour), f("place", w.place);
    f("pose", w.pose), f("limit", w.limit), f("parts", w.parts), f("node", w.node);
    f.unhashed("names", w.names);
  }
};

Whole example() {
  Whole w;
  w.on = true, w.time = -7, w.count = 4'000'000'000U, w.colour = Colour::Green;
  w.place = Vec3(-0.0, 1e-310, std::numeric_limits<double>::infinity());
  w.pose = {Vec3(1, 2, 3), Quat(0.5, -0.5, 0.5, -0.5)};
  w.limit = 0.1;
  w.parts = {{1.5, "hull"}, {0, ""}};
  w.names = {{3, "three"}, {9, ""}};
  w.node = {2, 77};
  return w;
}

std::vector<std::uint8_t> saved(Whole& w) {
  SavedState out;
  Whole::fields(w, out);
  return out.take();
}

std::uint64_t hashOf(const Whole& w) {
  StateHash h;
  hashFields(w, h);
  return h.value();
}

TEST(StateFields, WhatIsPutBackIsTheSameToTheBit) {
  Whole w = example();
  const std::vector<std::uint8_t> bytes = saved(w);
  Whole other;
  other.parts = {{9, "gone"}, {9, "gone"}, {9, "gone"}};
  RestoredState in(bytes);
  Whole::fields(other, in);
  EXPECT_TRUE(in.complete());
  EXPECT_EQ(saved(other), bytes);
  EXPECT_EQ(hashOf(other), hashOf(w));
  EXPECT_TRUE(std::signbit(other.place.x()));
  EXPECT_EQ(other.names, w.names);
}

TEST(StateFields, UnhashedFieldsAreNoPartOfTheHash) {
  Whole w = example();
  const std::uint64_t before = hashOf(w);
  w.names[3] = "four";
  EXPECT_EQ(hashOf(w), before);
  w.parts[1].weight = -0.0;
  EXPECT_NE(hashOf(w), before);
}

TEST(StateFields, TheFirstFieldThatDiffersIsNamed) {
  Whole here = example(), there = example();
  const auto difference = [&] {
    const std::vector<std::uint8_t> written = saved(there);
    StateDifference d(written);
    return Whole::fields(here, d), d.first();
  };
  EXPECT_FALSE(difference());
  there.parts[1].weight = 1e-300;
  auto found = difference();
  ASSERT_TRUE(found);
  EXPECT_EQ(found->name, "parts.weight");
  EXPECT_EQ(found->here, "0");
  EXPECT_EQ(found->there, "1e-300");
  there.time = 8;
  found = difference();
  ASSERT_TRUE(found);
  EXPECT_EQ(found->name + " " + found->here + " " + found->there, "time -7 8");
}

TEST(StateFields, AfterTheFirstDifferenceThereIsTheNextUnlessListsAreNotAlike) {
  Whole here = example(), there = example();
  there.time = 8, there.node.position = 78;
  std::vector<std::uint8_t> written = saved(there);
  StateDifference d(written);
  d("on", here.on), d("time", here.time);
  ASSERT_TRUE(d.first());
  d.next();
  d("count", here.count), d("colour", here.colour), d("place", here.place), d("pose", here.pose);
  d("limit", here.limit), d("parts", here.parts);
  EXPECT_FALSE(d.first()) << d.first()->name;
  d("node", here.node);
  ASSERT_TRUE(d.first());
  EXPECT_EQ(d.first()->name, "node");

  there.parts.pop_back();
  written = saved(there);
  StateDifference shorter(written);
  Whole::fields(here, shorter);
  ASSERT_TRUE(shorter.first());
  shorter.next();
  Whole::fields(here, shorter);
  EXPECT_FALSE(shorter.first()) << "what follows cannot be compared";
}

TEST(StateFields, WhatIsCutShortOrHasTooMuchIsRefused) {
  Whole w = example();
  const std::vector<std::uint8_t> bytes = saved(w);
  for (std::size_t n = 0; n < bytes.size(); ++n) {
    Whole other;
    RestoredState in({bytes.data(), n});
    Whole::fields(other, in);
    EXPECT_TRUE(in.failed()) << n << " of " << bytes.size() << " bytes";
  }
  std::vector<std::uint8_t> longer = bytes;
  longer.push_back(0);
  Whole other;
  RestoredState in(longer);
  Whole::fields(other, in);
  EXPECT_FALSE(in.failed());
  EXPECT_FALSE(in.complete());
}

TEST(StateFields, DamageIsNoneOfOurDeath) {
  Whole w = example();
  const std::vector<std::uint8_t> bytes = saved(w);
  std::mt19937 random(1);
  for (int i = 0; i < 20'000; ++i) {
    std::vector<std::uint8_t> damaged = bytes;
    for (int k = 0; k < 3; ++k) damaged[random() % damaged.size()] = static_cast<std::uint8_t>(random());
    Whole other;
    RestoredState in(damaged);
    Whole::fields(other, in);
    EXPECT_LE(other.parts.size(), damaged.size());
    StateDifference d(damaged);
    Whole::fields(other, d);
  }
}

TEST(StateFields, NumbersThatDoNotFitAreRefused) {
  std::uint64_t large = 1ULL << 32;
  SavedState out;
  out("count", large);
  std::uint32_t count = 5;
  RestoredState in(out.bytes());
  in("count", count);
  EXPECT_TRUE(in.failed());
}

TEST(StateFields, WhatNoEnumeratorStandsForIsRefused) {
  std::uint64_t none = 2;
  SavedState out;
  out("colour", none);
  Colour colour = Colour::Green;
  RestoredState in(out.bytes());
  in("colour", colour);
  EXPECT_TRUE(in.failed());
  EXPECT_EQ(colour, Colour::Red);
}

TEST(StateFields, WhatIsNoNumberIsRefused) {
  double none = std::numeric_limits<double>::quiet_NaN();
  SavedState out;
  out("weight", none);
  double weight = 1;
  RestoredState in(out.bytes());
  in("weight", weight);
  EXPECT_TRUE(in.failed());
  EXPECT_EQ(weight, 1);
}

}  // namespace
}  // namespace stadion
