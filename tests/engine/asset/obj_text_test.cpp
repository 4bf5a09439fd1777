// Numbers in OBJ files, as modelling programs write them, and errors with line and column.

#include "tests/engine/asset/importing.h"

#include "engine/asset/mesh_checks.h"

namespace stadion::test {
namespace {

constexpr const char* kFaces = "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

std::string boxOf(const std::string& less, const std::string& more) {
  std::string text;
  const auto vertex = [&](bool x, bool y, bool z) {
    text += "v " + (x ? more : less) + " " + (y ? more : less) + " " + (z ? more : less) + "\n";
  };
  for (const bool z : {false, true})
    vertex(false, false, z), vertex(true, false, z), vertex(true, true, z), vertex(false, true, z);
  return text + kFaces;
}

class ObjText : public ::testing::Test {
protected:
  Result<std::unique_ptr<Mesh>> load(const std::string& text) {
    folder_.write("m.obj", text);
    ImportLimits limits;
    limits.timeout = std::chrono::minutes(1);  // the program may take its time to start on a busy machine
    return importerOf(folder_.path(), limits).load("m.obj");
  }
  std::string errorOf(const std::string& text) {
    const auto mesh = load(text);
    EXPECT_FALSE(mesh) << text;
    return mesh ? std::string() : mesh.error().message;
  }
  TestFolder folder_;
};

TEST_F(ObjText, MayOmitDigitsBeforeAndAfterThePoint) {
  struct {
    const char *less, *more;
  } const spellings[] = {{"-.2", ".2"},         {"-0.2", "+.2"}, {"-2e-1", "2E-1"},
                         {"-.02e1", "+.02E+1"}, {"-,2", ",2"},   {"-0.20000000000000000000000000", "0.2"}};
  for (const auto& [less, more] : spellings) {
    SCOPED_TRACE(more);
    const auto mesh = load(boxOf(less, more));
    ASSERT_TRUE(mesh) << mesh.error().message;
    EXPECT_TRUE(closed(*mesh.value()));
    EXPECT_NEAR(volume(*mesh.value()), 0.064, 1e-7);
  }
  const auto whole = load(boxOf("-1.", "1."));
  ASSERT_TRUE(whole) << whole.error().message;
  EXPECT_NEAR(volume(*whole.value()), 8, 1e-6);
}

TEST_F(ObjText, MayHaveAMarkCommentsAndJoinedLines) {
  const auto mesh =
      load("\xef\xbb\xbfv .0 .0 .0 # first\r\nv 1. \\\r\n .0 .0\r\nv 0 1 0 1.\r\nv 0 0 1 .5 .5 .5\r\n"
           "  vt .5\r\nvn .0 .0 1.\r\nf 1/1/1 3/1 2\r\nf 1 2 4 # side\r\nf -3 -2 -1\r\nf 3//1 1 4");
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh.value()->indices.size() / 3, 4u);
  EXPECT_NEAR(volume(*mesh.value()), 1.0 / 6, 1e-6);
}

TEST_F(ObjText, WithMoreDigitsThanAnIntegerHasKeepsItsSize) {
  const auto mesh = load(boxOf("-100000000000000000000e-20", "100000000000000000000e-20"));
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_NEAR(volume(*mesh.value()), 8, 1e-5);
}

TEST_F(ObjText, ThatIsWrongIsNamedWithLineAndColumn) {
  const std::string three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  EXPECT_TRUE(
      contains(errorOf("v 0 0 0\nv 1 1.2.3 0\n"),
               "is wrong in line 2, column 5: \"1.2.3\" is not a number; write it as 0.5, -2 or 1e-3"));
  EXPECT_TRUE(contains(errorOf("v 0 0 0\nv  1 - 0\n"), "line 2, column 6: \"-\" is not a number"));
  EXPECT_TRUE(contains(errorOf("v 0 0 zero\n"), "line 1, column 7: \"zero\" is not a number"));
  EXPECT_TRUE(contains(errorOf("v 0 1e400 0\n"), "line 1, column 5: \"1e400\" is too large"));
  EXPECT_TRUE(contains(errorOf("# x\nv 1 2\n"), "line 2, column 5: a vertex has three numbers, four with a "
                                                "weight, six with a colour, this one has 2"));
  EXPECT_TRUE(contains(errorOf("v 1 2 3 4 5\n"), "this one has 5"));
  EXPECT_TRUE(contains(errorOf("v \\\n 1 \\\n 2 x\n"), "line 3, column 4: \"x\" is not a number"));
  EXPECT_TRUE(
      contains(errorOf(three + "vn 1 0\n"), "line 4, column 6: a normal has three numbers, this one has 2"));
  EXPECT_TRUE(contains(errorOf(three + "f 1 2 4\n"),
                       "line 4, column 7: \"4\" names a vertex that does not exist; there are 3"));
  EXPECT_TRUE(contains(errorOf(three + "f 1 2 -4\n"), "line 4, column 7: \"-4\" names a vertex"));
  EXPECT_TRUE(contains(errorOf(three + "f 1/2 2 3\n"),
                       "names a texture coordinate that does not exist; there are 0"));
  EXPECT_TRUE(contains(errorOf(three + "f 1 2 0\n"), "line 4, column 7: \"0\" is not the corner of a face"));
  EXPECT_TRUE(contains(errorOf(three + "f 1 2 1/1/1/1\n"), "\"1/1/1/1\" is not the corner of a face"));
}

}  // namespace
}  // namespace stadion::test
