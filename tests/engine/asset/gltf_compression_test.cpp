// Compressed glTF files, packed here by the encoders of the same libraries.

#include "tests/engine/asset/gltf_builder.h"
#include "tests/engine/asset/importing.h"

#include "engine/asset/mesh_checks.h"

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <meshoptimizer.h>
#include <webp/encode.h>

namespace stadion::test {
namespace {

using Builder = GltfBuilder;
using Bytes = std::vector<unsigned char>;

/// A bent grid of 21 x 21 vertices.
struct Grid {
  static constexpr std::uint32_t kSide = 21;
  std::vector<std::array<float, 3>> positions;
  std::vector<std::uint32_t> corners;

  Grid() {
    for (std::uint32_t y = 0; y < kSide; ++y)
      for (std::uint32_t x = 0; x < kSide; ++x) {
        const float u = static_cast<float>(x) / 20, v = static_cast<float>(y) / 20;
        positions.push_back({u, v, u * v});
      }
    for (std::uint32_t i = 0; i + kSide + 1 < kSide * kSide; ++i)
      if (i % kSide + 1 < kSide)
        corners.insert(corners.end(), {i, i + 1, i + kSide, i + 1, i + kSide + 1, i + kSide});
  }
};

void expectGrid(const Imported& m, double tolerance) {
  ASSERT_TRUE(m.mesh) << m.error;
  EXPECT_EQ(m.mesh->indices.size(), Grid().corners.size());
  for (const auto& p : m.mesh->positions)  // y of the show is -z of the file
    EXPECT_NEAR(double{-p[1]}, double{p[0]} * double{p[2]}, tolerance);
  EXPECT_TRUE(m.mesh->bounds.hi.isApprox(Vec3(1, 0, 1), tolerance)) << m.mesh->bounds.hi.transpose();
  for (const auto& n : m.mesh->normals) EXPECT_LT(n[1], -0.5) << "the same side is the front";
}

/// Adds a view with compressed bytes; its uncompressed buffer has no data.
std::size_t packedView(Builder& b, const Bytes& packed, std::size_t count, std::size_t stride,
                       const char* mode, const char* filter = "NONE") {
  const std::size_t view = b.view(packed.data(), packed.size());
  auto& json = b.json["bufferViews"][view];
  nlohmann::json extension = json;
  extension["count"] = count, extension["byteStride"] = stride, extension["mode"] = mode,
  extension["filter"] = filter;
  json = {{"buffer", 1}, {"byteLength", count * stride}};
  json["extensions"]["EXT_meshopt_compression"] = extension;
  b.json["buffers"][1] = {{"byteLength", 1'000'000}};
  b.json["extensionsUsed"] =
      b.json["extensionsRequired"] = {"EXT_meshopt_compression", "KHR_mesh_quantization"};
  return view;
}

template <class T>
Bytes packedVertices(const std::vector<T>& vertices) {
  Bytes packed(meshopt_encodeVertexBufferBound(vertices.size(), sizeof(T)));
  packed.resize(
      meshopt_encodeVertexBuffer(packed.data(), packed.size(), vertices.data(), vertices.size(), sizeof(T)));
  return packed;
}

Builder meshoptGrid(const Grid& grid, bool sequence) {
  Builder b;
  const std::size_t vertices = grid.positions.size(), count = grid.corners.size();
  const std::size_t position = b.emptyAccessor(Builder::kFloat, "VEC3", vertices);
  b.json["accessors"][position]["bufferView"] =
      packedView(b, packedVertices(grid.positions), vertices, 12, "ATTRIBUTES");
  Bytes packed(sequence ? meshopt_encodeIndexSequenceBound(count, vertices)
                        : meshopt_encodeIndexBufferBound(count, vertices));
  packed.resize(sequence
                    ? meshopt_encodeIndexSequence(packed.data(), packed.size(), grid.corners.data(), count)
                    : meshopt_encodeIndexBuffer(packed.data(), packed.size(), grid.corners.data(), count));
  const std::size_t corners = b.emptyAccessor(Builder::kUnsignedInt, "SCALAR", count);
  b.json["accessors"][corners]["bufferView"] =
      packedView(b, packed, count, 4, sequence ? "INDICES" : "TRIANGLES");
  b.primitive()["attributes"]["POSITION"] = position;
  b.primitive()["indices"] = corners;
  return b;
}

TEST(GltfCompression, MeshoptIsUnpacked) {
  TestFolder folder;
  for (const bool sequence : {false, true}) {
    folder.write("m.glb", meshoptGrid(Grid(), sequence).glb());
    const Imported m = importOf(folder.path(), "m.glb");
    expectGrid(m, 1e-6);
    EXPECT_TRUE(m.used("glTF extension \"EXT_meshopt_compression\"")) << m.all();
  }
}

TEST(GltfCompression, MeshoptFiltersAreApplied) {
  const Grid grid;
  Builder b = meshoptGrid(grid, false);
  const std::size_t vertices = grid.positions.size();
  std::vector<std::array<float, 4>> up(vertices, {0, 0.6f, 0.8f, 0});
  std::vector<std::array<std::int8_t, 4>> packed(vertices);
  meshopt_encodeFilterOct(packed.data(), vertices, 4, 8, up[0].data());
  const std::size_t normal = b.emptyAccessor(Builder::kByte, "VEC3", vertices);
  b.json["accessors"][normal]["bufferView"] =
      packedView(b, packedVertices(packed), vertices, 4, "ATTRIBUTES", "OCTAHEDRAL");
  b.json["accessors"][normal]["normalized"] = true;
  b.primitive()["attributes"]["NORMAL"] = normal;
  TestFolder folder;
  folder.write("m.glb", b.glb());
  const Imported m = importOf(folder.path(), "m.glb");
  ASSERT_TRUE(m.mesh) << m.error;
  for (const auto& n : m.mesh->normals) {
    EXPECT_NEAR(n[1], -0.8, 0.02);
    EXPECT_NEAR(n[2], 0.6, 0.02);
  }
}

Builder dracoGrid(const Grid& grid) {
  draco::TriangleSoupMeshBuilder soup;
  soup.Start(static_cast<int>(grid.corners.size() / 3));
  const int position = soup.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  for (std::uint32_t f = 0; f < grid.corners.size() / 3; ++f)
    soup.SetAttributeValuesForFace(position, draco::FaceIndex(f), grid.positions[grid.corners[3 * f]].data(),
                                   grid.positions[grid.corners[3 * f + 1]].data(),
                                   grid.positions[grid.corners[3 * f + 2]].data());
  const auto mesh = soup.Finalize();
  draco::Encoder encoder;
  encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 16);
  draco::EncoderBuffer packed;
  EXPECT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &packed).ok());
  Builder b;
  const std::size_t view = b.view(packed.data(), packed.size());
  b.primitive()["attributes"]["POSITION"] = b.emptyAccessor(Builder::kFloat, "VEC3", grid.positions.size());
  b.primitive()["indices"] = b.emptyAccessor(Builder::kUnsignedShort, "SCALAR", grid.corners.size());
  b.primitive()["extensions"]["KHR_draco_mesh_compression"] = {
      {"bufferView", view}, {"attributes", {{"POSITION", mesh->attribute(position)->unique_id()}}}};
  b.json["extensionsUsed"] = b.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  return b;
}

TEST(GltfCompression, DracoIsUnpacked) {
  TestFolder folder;
  Builder b = dracoGrid(Grid());
  folder.write("m.glb", b.glb());
  const Imported m = importOf(folder.path(), "m.glb");
  expectGrid(m, 1e-4);
  EXPECT_TRUE(m.used("glTF extension \"KHR_draco_mesh_compression\"")) << m.all();
  b.primitive()["extensions"]["KHR_draco_mesh_compression"]["attributes"]["POSITION"] = 7;
  folder.write("m.glb", b.glb());
  EXPECT_TRUE(contains(importOf(folder.path(), "m.glb").error,
                       "mesh 0, primitive 0: \"POSITION\" has 0 elements, but there are 441 vertices"));
}

TEST(GltfCompression, WebpPicturesAreRead) {
  const std::vector<std::uint8_t> pixels{255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 128, 9, 9, 9, 0};
  std::uint8_t* packed = nullptr;
  const std::size_t size = WebPEncodeLosslessRGBA(pixels.data(), 2, 2, 8, &packed);
  ASSERT_GT(size, 0u);
  Builder b;
  b.square();
  b.attribute("TEXCOORD_0", std::vector<float>(8, 0.5f), Builder::kFloat, "VEC2", 4);
  b.json["images"] = {{{"bufferView", b.view(packed, size)}, {"mimeType", "image/webp"}},
                      {{"uri", "fallback.png"}}};
  WebPFree(packed);
  b.json["textures"] =
      nlohmann::json::parse(R"([{"source": 1, "extensions": {"EXT_texture_webp": {"source": 0}}}])");
  b.json["materials"] = nlohmann::json::parse(
      R"([{"alphaMode": "BLEND", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}])");
  b.primitive()["material"] = 0;
  b.json["extensionsUsed"] = b.json["extensionsRequired"] = {"EXT_texture_webp"};
  TestFolder folder;
  folder.write("m.glb", b.glb());
  const Imported m = importOf(folder.path(), "m.glb");
  ASSERT_TRUE(m.mesh) << m.error;
  ASSERT_EQ(m.mesh->textures.size(), 1u) << m.all();
  EXPECT_EQ(m.mesh->textures[0].rgba[0], 255);
  EXPECT_EQ(m.mesh->textures[0].rgba[11], 128);
  EXPECT_TRUE(m.mesh->materials[0].transparent());
}

}  // namespace
}  // namespace stadion::test
