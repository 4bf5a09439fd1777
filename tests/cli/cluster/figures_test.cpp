/// Figures, painted models and surroundings in a cluster: every machine shows what one machine alone would.

#include "tests/engine/asset/rigged_model.h"
#include "tests/programs/played_cluster.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

/// A floor, a roof 2 m above it.
test::GltfBuilder pavilion() {
  test::GltfBuilder b;
  b.attribute("POSITION", std::vector<float>{-1, 0, -1, 1, 0, -1, 1, 0, 1, -1, 0, 1}, b.kFloat, "VEC3", 4);
  b.primitive()["indices"] =
      b.accessor(std::vector<std::uint16_t>{0, 2, 1, 0, 3, 2}, b.kUnsignedShort, "SCALAR", 6);
  b.json["nodes"] = nlohmann::json::parse(
      R"([{"name": "floor", "mesh": 0, "children": [1]},
          {"name": "roof", "mesh": 0, "translation": [0, 2, 0]}])");
  return b;
}

/// A walker around the visitor with a layer and markers, figures before every wall, and paint that messages change.
const char* const kShow = R"(light( direction="-1, 2, -3" )
figure( name=walker, file=tube.glb, clip=stroll, root=lower, position="-1, 2, 0", marker="stroll, 0.1, step",
        eventmessage="marker step, left, tint 1 0.3 0.2", eventmessage="looped, left, emit 0 0.3 0" )
bone( name=hand, parent=walker, bone=upper )
object( file=box.obj, up=z, parent=hand, position="0, 0, 1", scale=0.2 )
figure( name=left, file=tube.glb, clip=bend, position="-2, 0, 0" )
figure( name=right, file=tube.glb, clip=bend, speed=-0.7, phase=0.3, position="2, 0, 0" )
object( name=hall, file=pavilion.glb, position="1, 2.5, 0" )
timer( period=0.1, eventmessage="timesup, walker, layer bend weight 0.6 fade 0.1",
       eventmessage="timesup, right, opacity 0.4, 0.05", eventmessage="timesup, hall/roof, tint 0.2 1 0.3, 0.05",
       eventmessage="timesup, hall/roof, opacity 0.5, 0.1", eventmessage="timesup, right, play lift fade 0.2, 0.1",
       eventmessage="timesup, walker, unlayer bend fade 0.1, 0.2", eventmessage="timesup, hall/roof, reset, 0.2" )
)";

/// Plays the show on four machines and on one.
void compareFourWithOne(const TestFolder& folder, const char* show) {
  const std::string script = folder.write("show.evs", show);
  const std::string out = folder.path() / "four", one = folder.path() / "one";
  const std::vector<std::string> same{"--size",     "48x36", "--frames",   "32",
                                      "--pictures", "4",     "--renderer", "cpu"};
  std::vector<std::string> cluster{"cluster", fourNodes(folder), script, "--out", out},
      alone{"run", script, "--walls", "cave4", "--out", one};
  cluster.insert(cluster.end(), same.begin(), same.end());
  alone.insert(alone.end(), same.begin(), same.end());
  const ProgramResult r = stadionProgram(cluster);
  ASSERT_EQ(r.status, 0) << r.out << r.err;
  const ProgramResult by = stadionProgram(alone);
  ASSERT_EQ(by.status, 0) << by.err;
  const auto wanted = picturesIn(one);
  EXPECT_GE(wanted.size(), 64U);
  EXPECT_EQ(picturesIn(out), wanted);
  std::set<std::string> different;
  for (const auto& [name, bytes] : wanted) different.insert(bytes);
  EXPECT_GT(different.size(), 40U) << "it moves";
  for (const char* node : {"front", "left", "right", "floor"})
    EXPECT_EQ(summaryOf(out + "/" + node)["state_hash"], summaryOf(one)["state_hash"]) << node;
}

TEST(ClusterFigures, FourMachinesShowWhatOneShows) {
  const TestFolder folder;
  folder.write("tube.glb", test::strollingTube().glb());
  folder.write("pavilion.glb", pavilion().glb());
  folder.write("box.obj", "v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nv 0 1 0\nv 1 1 0\nv 1 1 1\nv 0 1 1\n"
                          "f 1 2 3 4\nf 6 5 8 7\nf 5 1 4 8\nf 2 6 7 3\nf 4 3 7 8\nf 5 6 2 1\n");
  compareFourWithOne(folder, kShow);
}

/// 8 x 4 pixels, each darker than the one before it.
std::string stepsHdr() {
  std::string file = "#?RADIANCE\n\n-Y 4 +X 8\n";
  for (int i = 0; i < 32; ++i) file += {char(250 - 4 * i), char(200 - 2 * i), char(128 + i), char(129)};
  return file;
}

/// A yard that fades and gives way to a hall, and an exposure that changes, before every wall.
const char* const kSurroundedShow = R"(light( direction="-1, 2, -3" )
environment( name=yard, file=yard.hdr, turn=40 )
environment( name=hall, intensity=0.4, initstate=off )
tones( name=camera, curve=neutral )
object( file=pavilion.glb, position="0, 3, 0" )
timer( period=0.1, repeat=off, eventmessage="timesup, yard, intensity 0.2 fade 0.3",
       eventmessage="timesup, camera, exposure 1.5 fade 0.25, 0.05", eventmessage="timesup, hall, enable, 0.25" )
timer( period=0.05, eventmessage="timesup, camera, exposure 0, 0.4" )
)";

TEST(ClusterFigures, FourMachinesHaveTheSurroundingsOfOne) {
  const TestFolder folder;
  folder.write("pavilion.glb", pavilion().glb());
  folder.write("yard.hdr", stepsHdr());
  compareFourWithOne(folder, kSurroundedShow);
}

}  // namespace
}  // namespace stadion
