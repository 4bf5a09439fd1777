/// A show whose surroundings come, change and go.

#include "engine/asset/mesh.h"
#include "engine/scene/scene.h"
#include "tests/engine/asset/importing.h"
#include "tests/programs/program.h"
#include "tests/show/player/played_show.h"

#include <gtest/gtest.h>

namespace stadion::test {
namespace {

/// All around of one grey; 128 is 1.
std::string greyHdr(int grey) {
  std::string file = "#?RADIANCE\n\n-Y 2 +X 4\n";
  for (int i = 0; i < 8; ++i) file += {char(grey), char(grey), char(grey), char(129)};
  return file;
}

/// A hall in a scene of its own, and a yard.
struct SurroundedShow : SteppedShow {
  explicit SurroundedShow(const std::string& hall = "") {
    folder.write("yard.hdr", greyHdr(128));
    folder.write("hall.hdr", hall.empty() ? greyHdr(32) : hall);
    folder.write("inner.evs", "environment( name=hall, file=hall.hdr, intensity=2, background=off )\n");
    player = openShow(folder.write("show.evs", R"(
environment( name=yard, file=yard.hdr, turn=90 )
scene( name=inner, file=inner.evs, initstate=off, ready=0.5 )
timer( period=0.5, repeat=off, eventmessage="timesup, inner, load" )
timer( period=2, repeat=off, eventmessage="timesup, inner, unload" )
timer( period=2.2, repeat=off, eventmessage="timesup, yard, intensity 3 fade 0.5" )
)"));
  }
  /// The surroundings at a show time.
  const EnvironmentRecord& at(double seconds) {
    while (next == 0 || toSeconds(changes.signature.time) < seconds) play(1);
    return changes.sky.environment;
  }
  const EnvironmentLight* picture() {
    const Mesh* mesh = player->meshes().find(changes.sky.environment.picture);
    return mesh ? mesh->environment.get() : nullptr;
  }
  TestFolder folder;
};

TEST(SurroundedShow, AScenesSurroundingsComeAndGoWithIt) {
  SurroundedShow show;
  ASSERT_TRUE(show.player);
  const MeshId yard = show.at(0.9).picture;
  ASSERT_TRUE(show.picture());
  EXPECT_NEAR(show.picture()->matt({0, 0, 1})[0], 1, 0.01);
  EXPECT_NEAR(show.at(0.9).turnSin, 1, 1e-6);
  EXPECT_NE(show.at(1.1).picture, yard);
  ASSERT_TRUE(show.picture());
  EXPECT_NEAR(show.picture()->matt({0, 0, 1})[0], 0.25, 0.01);
  EXPECT_EQ(show.at(1.1).background, 0u);
  EXPECT_EQ(show.at(1.1).intensity, 2);
  EXPECT_EQ(show.at(2.6).picture, yard);
  EXPECT_EQ(show.at(3.0).intensity, 3);
}

TEST(SurroundedShow, ThePictureThatCannotBeReadGivesWayToTheSky) {
  SurroundedShow show("not a picture");
  ASSERT_TRUE(show.player);
  EXPECT_EQ(show.at(1.1).lit, 1u);
  EXPECT_EQ(show.at(1.1).picture, kNoMesh);
}

}  // namespace
}  // namespace stadion::test
