#include "engine/display/screen_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <random>

namespace stadion {
namespace {

std::string messagesOf(const Diagnostics& findings) {
  std::string all;
  for (const Diagnostic& d : findings.all()) all += std::to_string(d.where.line) + ": " + d.message + "\n";
  return all;
}

std::string pfm(const std::string& heading, const std::vector<float>& values, bool bigEndian = false) {
  std::string bytes = heading;
  for (const float value : values) {
    auto raw = std::bit_cast<std::array<char, 4>>(value);
    if (bigEndian) std::ranges::reverse(raw);
    bytes.append(raw.data(), raw.size());
  }
  return bytes;
}

const std::vector<float> kSquare{0, 1, 0, 1, 1, 0, 0, 1, 2, 1, 1, 2};

std::string refusalOf(const std::string& bytes) {
  Diagnostics out;
  EXPECT_FALSE(readPointGrid(bytes, "a.pfm", 1, out));
  return messagesOf(out);
}

TEST(PointGrid, IsReadInEitherByteOrderFromTheBottomToTheTop) {
  for (const bool bigEndian : {false, true}) {
    Diagnostics out;
    const auto grid = readPointGrid(pfm(bigEndian ? "PF\n2 2\n1.0\n" : "PF\n2 2\n-1.0\n", kSquare, bigEndian),
                                    "a.pfm", 0.1, out);
    ASSERT_TRUE(grid) << messagesOf(out);
    EXPECT_EQ(grid->columns, 2u);
    EXPECT_LE((grid->points[0] - Vec3(0, 0.1, 0.2)).norm(), 1e-12) << "upper left";
    EXPECT_LE((grid->points[3] - Vec3(0.1, 0.1, 0)).norm(), 1e-12) << "lower right";
  }
}

TEST(PointGrid, TakesWhatIsNoPointAsOffTheScreen) {
  std::vector<float> values = kSquare;
  values[1] = std::numeric_limits<float>::quiet_NaN();
  values[4] = std::numeric_limits<float>::infinity();
  values[7] = 1e30F;
  Diagnostics out;
  const auto grid = readPointGrid(pfm("PF 2 2 -1\n", values), "a.pfm", 1, out);
  ASSERT_TRUE(grid) << messagesOf(out);
  EXPECT_EQ(std::ranges::count_if(grid->points, [](const Vec3& p) { return p.allFinite(); }), 1);
  EXPECT_FALSE(meshOfGrid(*grid, "a.pfm", out));
  EXPECT_EQ(messagesOf(out), "0: the grid has no three neighbouring points on a screen; measure it again\n");
}

TEST(PointGrid, ThatIsWrongIsRefusedWithTheReason) {
  EXPECT_EQ(refusalOf(""), "0: this is not a PFM file; one begins with the line PF\n");
  EXPECT_EQ(refusalOf("Pf\n2 2\n-1\n"),
            "0: this PFM file has one channel; points need three, so its first line must be PF\n");
  EXPECT_EQ(refusalOf("PF\n2\n"),
            "0: the second line of a PFM file must be its width and height, such as 64 48\n");
  EXPECT_EQ(refusalOf("PF\n-2 2\n-1\n"),
            "0: the second line of a PFM file must be its width and height, such as 64 48\n");
  EXPECT_EQ(refusalOf("PF\n2 2\n0\n"), "0: the third line of a PFM file must be its scale, such as -1.0 for "
                                       "little-endian numbers\n");
  EXPECT_EQ(refusalOf("PF\n2 2\nnan\n"), refusalOf("PF\n2 2\n0\n"));
  EXPECT_EQ(refusalOf(pfm("PF\n2 2\n-1\n", {1, 2, 3})),
            "0: the file ends too early: 2 x 2 points take 48 bytes, and 12 are there; copy it again\n");
  for (const char* size : {"1 5", "16385 2", "16384 16384", "4294967296 4294967296"})
    EXPECT_NE(refusalOf(std::string("PF\n") + size + "\n-1\n").find("is not read; it must have 2 to 16384"),
              std::string::npos);
}

TEST(PointGrid, MakesTrianglesBetweenNeighbours) {
  Diagnostics out;
  const auto grid = readPointGrid(pfm("PF\n2 2\n-1\n", kSquare), "a.pfm", 1, out);
  ASSERT_TRUE(grid);
  const auto mesh = meshOfGrid(*grid, "a.pfm", out);
  ASSERT_TRUE(mesh);
  EXPECT_EQ(mesh->points.size(), 4u);
  EXPECT_EQ(mesh->triangles.size(), 2u);
}

TEST(ObjMesh, HasFacesOfAnyNumberOfCornersInAllForms) {
  Diagnostics out;
  const auto mesh =
      readObjMesh("# a sheet\no sheet\nv 0 1 0\nv 1 1 0\nv 1 1 1\r\nv 0 1 1 1.0\nvt 0 0\nvn 0 1 0\n"
                  "f 1 2 3 4\nf -4/1 -3/1 -2/1\nf 1//1 2//1 3//1\nf 1/1/1 2/1/1 4/1/1\n",
                  "a.obj", 100, out);
  ASSERT_TRUE(mesh) << messagesOf(out);
  EXPECT_EQ(messagesOf(out), "");
  ASSERT_EQ(mesh->triangles.size(), 5u);
  EXPECT_EQ(mesh->triangles[1], (std::array<std::uint32_t, 3>{0, 2, 3}));
  EXPECT_EQ(mesh->triangles[2], (std::array<std::uint32_t, 3>{0, 1, 2}));
  EXPECT_EQ(mesh->points[2], Vec3(100, 100, 100));
}

TEST(ObjMesh, NamesWhatItSkipsOnce) {
  Diagnostics out;
  ASSERT_TRUE(readObjMesh("curv 0 1\nl 1 2\nl 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "a.obj", 1, out));
  EXPECT_EQ(messagesOf(out),
            "0: these statements are skipped: curv, l; a screen is made of v and f lines only\n");
}

TEST(ObjMesh, ThatIsWrongIsRefusedWithItsLine) {
  const auto refusal = [](const std::string& text) {
    Diagnostics out;
    EXPECT_FALSE(readObjMesh(text, "a.obj", 1, out)) << text;
    return messagesOf(out);
  };
  EXPECT_EQ(refusal("v 0 0\n"), "1: a v line must have three numbers of at most 1e7, such as: v 1.5 2 0.3\n");
  for (const char* bad : {"v 0 0 nan", "v 0 0 inf", "v 0 0 1e300", "v 0 0 1x", "v"})
    EXPECT_EQ(refusal(bad), refusal("v 0 0\n"));
  EXPECT_EQ(refusal("v 0 0 0\nv 1 0 0\nf 1 2 3\n"),
            "3: \"3\" is no corner of a face; the file has 2 points up to this line\n");
  for (const char* bad : {"f 0 1 2", "f -3 1 2", "f 1 2 9223372036854775808", "f 1 2 a", "f / / /"})
    EXPECT_NE(refusal("v 0 0 0\nv 1 0 0\n" + std::string(bad)).find("is no corner of a face"),
              std::string::npos);
  EXPECT_EQ(refusal("v 0 0 0\nv 1 0 0\nf 1 2\n"),
            "3: a face needs at least three corners, such as: f 1 2 3\n");
  EXPECT_NE(refusal("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n").find("no triangle with an area"),
            std::string::npos);
  EXPECT_NE(refusal("").find("no triangle with an area"), std::string::npos);
}

TEST(MeasuredFiles, OfAnyBytesNeverCrash) {
  std::mt19937 random(5);
  const std::string obj = "v 0 1 0\nv 1 1 0\nv 1 1 1\nv 0 1 1\nf 1 2 3 4\nf -1/2 -2 -3//3\n";
  const std::string grid = pfm("PF\n2 2\n-1.0\n", kSquare);
  for (int i = 0; i < 20000; ++i) {
    std::string bytes = i % 2 == 0 ? obj : grid;
    for (unsigned k = 1 + random() % 3; k > 0; --k) {
      const std::size_t at = random() % (bytes.size() + 1);
      if (random() % 2 == 0 && at < bytes.size())
        bytes[at] = static_cast<char>(random());
      else
        bytes.erase(at, random() % 4);
    }
    Diagnostics out;
    if (i % 2 == 0) {
      const auto mesh = readObjMesh(bytes, "a.obj", 1, out);
      ASSERT_EQ(mesh.has_value(), !out.hasErrors());
      if (!mesh) continue;
      for (const auto& t : mesh->triangles) ASSERT_LT(*std::ranges::max_element(t), mesh->points.size());
    } else if (const auto read = readPointGrid(bytes, "a.pfm", 1, out)) {
      ASSERT_EQ(read->points.size(), std::size_t{read->columns} * read->rows);
    } else {
      ASSERT_TRUE(out.hasErrors());
    }
  }
}

}  // namespace
}  // namespace stadion
