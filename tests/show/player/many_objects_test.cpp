/// A node that has nothing to do costs nothing: a hundred thousand objects that stand still beside ten that
/// move.

#include "tests/programs/program.h"
#include "tests/show/player/played_show.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <malloc.h>
#include <nlohmann/json.hpp>

namespace stadion {
namespace {

constexpr int kStatic = 100'000, kMoving = 10;

/// `count` objects on a grid behind the visitor, where they cost no drawing, and ten that paths move.
std::string manyObjects(int count) {
  std::string text;
  for (int i = 0; i < count; ++i)
    text += fmt::format("object( file=football.3ds, position=\"{}, {}, 0\" )\n", i % 400, -10 - i / 400);
  for (int i = 0; i < kMoving; ++i)
    text += fmt::format(
        "object( name=m{0}, file=football.3ds )\n"
        "path( target=m{0}, loop=on, key=\"0, {0}, 0, 1\", key=\"1, {0}, 5, 1\", key=\"2, {0}, 0, 1\" )\n",
        i);
  return text;
}

TEST(ProgramManyObjects, AppVisitsTenNodesAFrameAndPublishesTenChanges) {
  const TestFolder folder;
  const std::string script = folder.write("many.evs", manyObjects(kStatic));
  const ProgramResult r = stadionProgram({"run", script, "--asset-root", assetFolder(), "--walls", "desktop",
                                          "--gl", "none", "--frames", "20", "--input", "none", "--json"});
  ASSERT_EQ(r.status, 0) << r.err;
  const auto counters = nlohmann::json::parse(r.out).at("counters");
  EXPECT_EQ(counters.at("nodes visited per frame"), kMoving);
  EXPECT_EQ(counters.at("changes published per frame"), kMoving);
}

std::size_t bytesInUse() {
  const struct mallinfo2 m = mallinfo2();
  return m.uordblks + m.hblkhd;
}

/// Memory that an opened show holds: what was allocated for it, and its static chunk.
std::size_t bytesOf(int count) {
  const TestFolder folder;
  const std::string script = folder.write("many.evs", manyObjects(count));
  const std::size_t before = bytesInUse();
  const auto player = openShow(script);
  if (!player) return 0;
  return bytesInUse() - before + player->parts(StereoLayout::Off).state.arena().bytesInUse();
}

TEST(ProgramManyObjects, AStaticObjectCostsAtMostTwoHundredBytes) {
  bytesOf(10);  // what is allocated once
  const std::size_t few = bytesOf(10), many = bytesOf(10 + kStatic);
  const double each = static_cast<double>(many - few) / kStatic;
  RecordProperty("bytes_per_static_object", fmt::format("{:.1f}", each));
  fmt::print("{:.1f} bytes per static object\n", each);
  EXPECT_LE(each, 200);
  EXPECT_GE(each, sizeof(InstanceRecord)) << "something has not been counted";
}

}  // namespace
}  // namespace stadion
