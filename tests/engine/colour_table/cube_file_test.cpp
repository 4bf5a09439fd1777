/// Colour tables as files: what is read, what is refused and where.

#include "engine/colour_table/cube_file.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

std::string refusal(const std::string& text) {
  Diagnostics out;
  EXPECT_FALSE(readCube(text, "t.cube", out)) << text;
  std::string all;
  for (const Diagnostic& d : out.all())
    all += std::to_string(d.where.line) + ":" + std::to_string(d.where.column) + ": " + d.message + "\n";
  return all;
}

ColourTable tableOf(const std::string& text) {
  Diagnostics out;
  auto table = readCube(text, "t.cube", out);
  EXPECT_TRUE(table) << (out.all().empty() ? "" : out.all()[0].message);
  return table.value_or(ColourTable{});
}

constexpr const char* kEight = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 0 1\n1 0 1\n0 1 1\n1 1 1\n";

TEST(CubeFile, HasCurvesASolidOrBoth) {
  const ColourTable curve = tableOf("# made by hand\r\nTITLE \"left  one\"\r\nLUT_1D_SIZE 2\r\nDOMAIN_MAX 1 "
                                    "2 4\r\n\r\n0 0.5 1\r\n1,0.25,-0.5\r\n");
  EXPECT_EQ(curve.title, "left one");
  EXPECT_EQ(curve.curve, (std::vector<float>{0, 0.5f, 1, 1, 0.25f, -0.5f}));
  EXPECT_EQ(curve.curveRange.high[2], 4);
  EXPECT_EQ(curve.solidSize, 0u);
  const ColourTable both = tableOf(
      std::string("LUT_3D_SIZE 2\nLUT_1D_SIZE 3\nLUT_3D_INPUT_RANGE -0.5 1.5\n0 0 0\n.5 .5 .5\n1 1 1\n") +
      kEight);
  EXPECT_EQ(both.curve.size(), 9u);
  EXPECT_EQ(both.solid.size(), 24u);
  EXPECT_EQ(both.solid[3], 1) << "red varies first";
  EXPECT_EQ(both.solidRange.low[1], -0.5);
  for (const ColourTable& table : {curve, both}) EXPECT_EQ(tableOf(formatCube(table)), table);
}

TEST(CubeFile, RefusesWhatIsWrongInItsPlace) {
  EXPECT_EQ(refusal(""), "0:0: the file has no table; it needs LUT_1D_SIZE N or LUT_3D_SIZE N\n");
  EXPECT_EQ(refusal("TITLE x\n0 0 0\n"),
            "2:1: a row stands before the size of the table; put LUT_1D_SIZE N or LUT_3D_SIZE N above it\n");
  EXPECT_EQ(
      refusal("LUT_3D_SIZE 1\n"),
      "1:13: the number of grid points along an edge must be a whole number from 2 to 128, not \"1\"\n");
  EXPECT_EQ(refusal("LUT_1D_SIZE 2\n0 0 0\n1 1\n"), "3:4: blue is missing\n");
  EXPECT_EQ(refusal("LUT_1D_SIZE 2\n0 0 0\n1 one 1\n"), "3:3: \"one\" is not a number (green)\n");
  EXPECT_EQ(refusal("LUT_1D_SIZE 2\n0 0 0\n1 1 1 1\n").substr(0, 4), "3:7:");
  EXPECT_EQ(refusal("LUT_1D_SIZE 2\n0 0 0\n1 1 1\n1 1 1\n"),
            "4:1: the table has 2 rows, and this is one more; delete it, or correct the size\n");
  EXPECT_EQ(refusal("LUT_1D_SIZE 3\n0 0 0\n1 1 1\n"),
            "0:0: the file ends after 2 of 3 rows; write it again\n");
  EXPECT_EQ(refusal("LUT_1D_SIZE 2\n0 0 0\nDOMAIN_MAX 1 1 1\n1 1 1\n"),
            "3:1: \"DOMAIN_MAX\" stands below the first row of the table; move this line up\n");
  EXPECT_EQ(refusal("LUT_1D_SIZE 2\nDOMAIN_MIN 0 2 0\n0 0 0\n1 1 1\n"),
            "2:1: the highest place (1) must be above the lowest (2)\n");
  EXPECT_EQ(refusal("LUT_1D_SIZE 2\n0 0 0\n1 1 1e7\n"), "3:1: a value of this row is beyond 1000000\n");
  EXPECT_EQ(refusal("LUT_IN_VIDEO_RANGE\n"),
            "1:1: \"LUT_IN_VIDEO_RANGE\" is not read here; write the table for values of the full range\n");
  EXPECT_NE(refusal("LUT_3D_SISE 2\n").find("LUT_3D_SIZE"), std::string::npos);
  EXPECT_NE(refusal(std::string("LUT_1D_SIZE 2\nLUT_3D_SIZE 2\nDOMAIN_MIN 0 0 0\n0 0 0\n1 1 1\n") + kEight)
                .find("3:1: the file has two tables"),
            std::string::npos);
}

}  // namespace
}  // namespace stadion
