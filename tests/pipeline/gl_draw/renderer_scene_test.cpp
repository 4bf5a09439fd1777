#include "tests/pipeline/gl_draw/renderer_scene.h"

#include <gtest/gtest.h>

namespace stadion::test {

TEST(PictureScene, ShowsALittleOfEverything) {
  MeshStore meshes;
  const DrawList list = richList(meshes, 800.0 / 600);
  Stage stage(meshes, 800, 600);
  const Picture left = stage.draw(list, 0);
  const Picture right = stage.draw(list, 1);
  EXPECT_NE(left.rgba, right.rgba);
  writePng(left, "rich-left");
  // The eye of the beholder judges the rest; these three colours are of the sky, the ground and the ball.
  EXPECT_GT(left.at(400, 20)[2], left.at(400, 20)[0] + 20);
  EXPECT_GT(left.at(400, 580)[1], left.at(400, 580)[2]);
  EXPECT_GT(left.at(400, 340)[0], left.at(400, 340)[1] + 60);
}

}  // namespace stadion::test
