// The checks of meshes, and meshes as bytes.

#include "tests/engine/asset/importing.h"

#include "engine/asset/mesh_checks.h"
#include "engine/asset/mesh_file.h"

#include <cstring>

namespace stadion::test {
namespace {

TEST(AssetMeshChecks, ABoxIsClosedUntilATriangleIsMissingOrTurned) {
  const auto box = standIn("box");
  EXPECT_TRUE(closed(*box));
  Mesh open = *box;
  open.indices.resize(open.indices.size() - 3);
  EXPECT_FALSE(closed(open));
  Mesh turned = *box;
  std::swap(turned.indices[0], turned.indices[1]);
  EXPECT_FALSE(closed(turned));
  EXPECT_FALSE(closed(Mesh{}));
}

TEST(AssetMeshChecks, TheHashIsOfTheContentAndNotOfTheName) {
  const auto a = standIn("a"), b = standIn("b");
  EXPECT_EQ(a->hash, b->hash);
  Mesh other = *a;
  other.positions[0][0] += 0.001f;
  finish(other);
  EXPECT_NE(other.hash, a->hash);
  Mesh painted = *a;
  painted.materials[0].roughness = 0.1f;
  finish(painted);
  EXPECT_NE(painted.hash, a->hash);
}

TEST(AssetMeshChecks, TheSphereHoldsEveryVertex) {
  const auto box = standIn("box");
  EXPECT_NEAR(box->sphere.radius, 0.25 * std::sqrt(3.0), 1e-6);
  EXPECT_TRUE(box->sphere.centre.isApprox(Vec3(0, 0, 0.25), 1e-9));
}

TEST(AssetMeshFile, AMeshComesBackAsItWent) {
  const auto box = standIn("box");
  auto back = decode(encode(*box));
  ASSERT_TRUE(back) << back.error().message;
  back.value()->standIn = true;
  finish(*back.value());
  EXPECT_EQ(back.value()->hash, box->hash);
  EXPECT_EQ(back.value()->materials[0].name, "stand-in");
}

TEST(AssetMeshFile, NoShortenedFileIsAccepted) {
  const auto bytes = encode(*standIn("box"));
  for (std::size_t n = 0; n < bytes.size(); n += n < 1200 ? 1 : 97)
    ASSERT_FALSE(decode({bytes.data(), n})) << n << " bytes";
  auto longer = bytes;
  longer.push_back(0);
  EXPECT_FALSE(decode(longer));
}

TEST(AssetMeshFile, WhateverIsAcceptedIsSound) {
  const auto bytes = encode(*standIn("box"));
  std::uint64_t state = 1;
  for (int i = 0; i < 20000; ++i) {
    auto bad = bytes;
    for (int k = 0; k < 3; ++k) {
      state = state * 6364136223846793005ull + 1442695040888963407ull;
      bad[(state >> 33) % 1400] = static_cast<std::uint8_t>(state >> 25);
    }
    const auto mesh = decode(bad);
    if (!mesh) continue;
    const Mesh& m = *mesh.value();
    for (const auto& p : m.positions)
      for (float c : p) ASSERT_TRUE(std::isfinite(c));
    for (auto index : m.indices) ASSERT_LT(index, m.positions.size());
    for (const auto& s : m.submeshes) ASSERT_LT(s.material, m.materials.size());
    for (const auto& material : m.materials) {
      ASSERT_LT(material.maps[kBaseMap].texture, static_cast<int>(m.textures.size()));
      ASSERT_LT(material.maps[kEmissiveMap].texture, static_cast<int>(m.textures.size()));
      ASSERT_TRUE(material.alphaCutoff >= 0 && material.alphaCutoff <= kMostAlphaCutoff);
    }
  }
}

TEST(AssetMeshFile, HugeCountsCostNothing) {
  auto bytes = encode(*standIn("box"));
  const std::uint32_t huge = 19'999'999;
  std::memcpy(bytes.data() + 8, &huge, sizeof huge);
  EXPECT_FALSE(decode(bytes));
}

}  // namespace
}  // namespace stadion::test
