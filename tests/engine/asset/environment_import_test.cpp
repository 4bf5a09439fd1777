/// Pictures of surroundings: Radiance HDR and OpenEXR, whole and damaged.

#include "tests/engine/asset/importing.h"

#include "engine/asset/mesh_file.h"
#include "engine/environment/radiance_map.h"

#include <functional>
#include <limits>

namespace stadion::test {
namespace {

using PixelAt = std::function<Radiance(std::uint32_t, std::uint32_t)>;

std::string hdrHead(std::uint32_t width, std::uint32_t height) {
  return "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(height) + " +X " +
         std::to_string(width) + "\n";
}

/// Red 1 on the left, 0.5 on the right; green 2; blue 0. Rows in runs.
std::string halvesHdr(std::uint32_t width, std::uint32_t height) {
  std::string file = hdrHead(width, height);
  for (std::uint32_t y = 0; y < height; ++y) {
    file += {2, 2, static_cast<char>(width >> 8), static_cast<char>(width & 255)};
    const auto run = [&](std::uint32_t count, int value) {
      for (; count > 0; count -= std::min(count, 127u)) {
        file += static_cast<char>(128 + std::min(count, 127u));
        file += static_cast<char>(value);
      }
    };
    run(width / 2, 64), run(width / 2, 32);
    run(width, 128);
    for (std::uint32_t x = 0; x < width; x += 4) file += {4, 0, 0, 0, 0};  // pixel by pixel
    run(width, 130);
  }
  return file;
}

/// Pixel by pixel: 1, 0.5, 0.
std::string smallHdr() {
  std::string file = hdrHead(4, 2);
  for (int i = 0; i < 8; ++i) file += {static_cast<char>(128), 64, 0, static_cast<char>(129)};
  return file;
}

template <class T>
void put(std::string& to, T value) {
  to.append(reinterpret_cast<const char*>(&value), sizeof value);
}
void putAttribute(std::string& to, const std::string& name, const std::string& type,
                  const std::string& value) {
  to += name + '\0' + type + '\0';
  put(to, static_cast<std::int32_t>(value.size()));
  to += value;
}

/// Three channels of 32-bit numbers, not compressed.
std::string exrOf(std::int32_t width, std::int32_t height, const PixelAt& pixel) {
  std::string file;
  put(file, std::int32_t{20000630}), put(file, std::int32_t{2});
  std::string channels, box, point, size;
  for (const char* name : {"B", "G", "R"}) {
    channels += std::string(name) + '\0';
    for (const std::int32_t value : {2, 0, 1, 1}) put(channels, value);
  }
  channels += '\0';
  for (const std::int32_t value : {0, 0, width - 1, height - 1}) put(box, value);
  put(point, 0.0f), put(point, 0.0f), put(size, 1.0f);
  putAttribute(file, "channels", "chlist", channels);
  putAttribute(file, "compression", "compression", std::string(1, '\0'));
  putAttribute(file, "dataWindow", "box2i", box);
  putAttribute(file, "displayWindow", "box2i", box);
  putAttribute(file, "lineOrder", "lineOrder", std::string(1, '\0'));
  putAttribute(file, "pixelAspectRatio", "float", size);
  putAttribute(file, "screenWindowCenter", "v2f", point);
  putAttribute(file, "screenWindowWidth", "float", size);
  file += '\0';
  const auto rowBytes = static_cast<std::uint64_t>(width) * 12;
  const std::uint64_t first = file.size() + 8 * static_cast<std::uint64_t>(height);
  for (std::int32_t y = 0; y < height; ++y) put(file, first + static_cast<std::uint64_t>(y) * (rowBytes + 8));
  for (std::int32_t y = 0; y < height; ++y) {
    put(file, y), put(file, static_cast<std::int32_t>(rowBytes));
    for (const std::size_t c : {2u, 1u, 0u})
      for (std::int32_t x = 0; x < width; ++x)
        put(file, pixel(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y))[c]);
  }
  return file;
}

Imported surroundings(const std::string& name, const std::string& bytes) {
  const TestFolder folder;
  folder.write(name, bytes);
  ImportOptions options;
  options.form = ModelForm::Environment;
  return importOf(folder.path(), name, options);
}

TEST(EnvironmentImport, ReadsRadianceHdr) {
  const Imported got = surroundings("hall.hdr", halvesHdr(128, 64));
  ASSERT_TRUE(got.mesh) << got.error;
  ASSERT_TRUE(got.mesh->environment);
  EXPECT_TRUE(got.mesh->indices.empty());
  EXPECT_TRUE(got.used("surroundings of 128 x 64 pixels")) << got.all();
  const EnvironmentLight& light = *got.mesh->environment;
  EXPECT_NEAR(light.matt({-1, 0, 0})[0], 1, 0.03);  // the left half is bright
  EXPECT_NEAR(light.matt({1, 0, 0})[0], 0.5, 0.03);
  EXPECT_NEAR(light.matt({0, 0, 1})[1], 2, 0.01);
  EXPECT_NEAR(light.matt({0, 0, 1})[2], 0, 0.01);
}

TEST(EnvironmentImport, ReadsRowsWithoutRuns) {
  const Imported got = surroundings("small.hdr", smallHdr());
  ASSERT_TRUE(got.mesh) << got.error;
  EXPECT_NEAR(got.mesh->environment->matt({0, 0, 1})[0], 1, 0.01);
  EXPECT_NEAR(got.mesh->environment->matt({0, 1, 0})[1], 0.5, 0.01);
}

TEST(EnvironmentImport, LinesMayEndInTwoBytes) {
  std::string file = smallHdr();
  for (std::size_t at = 0, lines = 0; lines < 4; at += 2, ++lines)
    file.insert(at = file.find('\n', at), 1, '\r');
  const Imported got = surroundings("small.hdr", file);
  ASSERT_TRUE(got.mesh) << got.error;
  EXPECT_NEAR(got.mesh->environment->matt({0, 0, 1})[0], 1, 0.01);
}

TEST(EnvironmentImport, ReadsExr) {
  const Imported got = surroundings("hall.exr", exrOf(64, 32, [](std::uint32_t, std::uint32_t y) {
                                      return Radiance{y < 16 ? 100000.0f : 0.0f, 0.25f, -3};
                                    }));
  ASSERT_TRUE(got.mesh) << got.error;
  const EnvironmentLight& light = *got.mesh->environment;
  EXPECT_NEAR(light.matt({0, 0, 1})[0] / 100000, 1, 0.07);
  EXPECT_NEAR(light.matt({0, 0, 1})[1], 0.25, 0.01);
  EXPECT_NEAR(light.matt({0, 0, 1})[2], 0, 1e-6) << "negative light counts as none";
}

TEST(EnvironmentImport, TheSamePictureIsTheSameMesh) {
  const std::string file = halvesHdr(128, 64);
  const Imported a = surroundings("a.hdr", file), b = surroundings("b.hdr", file),
                 c = surroundings("c.hdr", smallHdr());
  ASSERT_TRUE(a.mesh && b.mesh && c.mesh);
  EXPECT_EQ(a.mesh->hash, b.mesh->hash);
  EXPECT_NE(a.mesh->hash, c.mesh->hash);
}

void expectRefusal(const std::string& name, const std::string& bytes, const std::string& why) {
  const Imported got = surroundings(name, bytes);
  EXPECT_FALSE(got.mesh) << name;
  EXPECT_TRUE(contains(got.error, why)) << got.error;
}

TEST(EnvironmentImport, RefusesDamagedPicturesWithAReason) {
  const std::string hdr = halvesHdr(128, 64);
  const auto grey = [](std::uint32_t, std::uint32_t) { return Radiance{1, 1, 1}; };
  const std::string exr = exrOf(64, 32, grey);
  expectRefusal("a.hdr", "", "is empty");
  expectRefusal("a.hdr", "P6 4 4 255", "is damaged: its head has no end");
  expectRefusal("a.hdr", "P6\n4 4 255\n", "is no Radiance picture");
  expectRefusal("a.hdr", hdr.substr(0, hdr.size() / 2), "is damaged: it is cut short");
  expectRefusal("a.hdr", hdrHead(128, 64) + std::string(3000, '\xff'), "cut short");
  expectRefusal("a.hdr", hdrHead(128, 64) + std::string("\2\2\0\x81", 4) + std::string(600, '\1'),
                "a row has another length");
  expectRefusal("a.hdr", hdrHead(64, 64), "is 64 x 64 pixels large; a picture of surroundings");
  expectRefusal("a.hdr", hdrHead(1u << 30, 1u << 29), "surroundings have 2 x 1 to 8192 x 4096");
  expectRefusal("a.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 2 +X 4\n",
                "has the format 32-bit_rle_xyze");
  expectRefusal("a.exr", exr.substr(0, exr.size() - 3000), "is damaged");
  expectRefusal("a.exr", hdr, "is damaged");
  expectRefusal("a.exr", exrOf(64, 64, grey).substr(0, 4000), "is 64 x 64 pixels large");
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()})
    expectRefusal("a.exr",
                  exrOf(8, 4,
                        [&](std::uint32_t x, std::uint32_t y) {
                          return Radiance{x == 5 && y == 2 ? bad : 1, 1, 1};
                        }),
                  "has no finite number at pixel 5, 2");
}

TEST(EnvironmentImport, EveryCutOfAFileIsRefusedOrRead) {
  const std::string exr = exrOf(8, 4, [](std::uint32_t, std::uint32_t) { return Radiance{1, 1, 1}; });
  const TestFolder folder;
  ImportOptions options;
  options.form = ModelForm::Environment;
  Importer importer = importerOf(folder.path());
  for (std::size_t size = 1; size < exr.size(); size += 37) {
    folder.write("cut.exr", exr.substr(0, size));
    EXPECT_FALSE(importer.load("cut.exr", options)) << size;
  }
  EXPECT_EQ(importer.started(), 1) << "no cut crashes the importer";
}

TEST(EnvironmentImport, ModelsAndSurroundingsAreNotTakenForEachOther) {
  const TestFolder folder;
  folder.write("hall.hdr", halvesHdr(128, 64));
  folder.write("leg.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  ImportOptions options;
  EXPECT_TRUE(contains(importOf(folder.path(), "hall.hdr", options).error, "an environment takes it"));
  options.form = ModelForm::Environment;
  EXPECT_TRUE(contains(importOf(folder.path(), "leg.obj", options).error, "is no picture of surroundings"));
}

TEST(EnvironmentFile, BytesOfAnEnvironmentAreCheckedAndKept) {
  Mesh mesh;
  mesh.materials.emplace_back();
  auto light =
      std::make_shared<EnvironmentLight>(skyLight({0.1f, 0.2f, 0.3f}, {1, 1, 1}, {0.5f, 0.4f, 0.3f}));
  mesh.environment = light;
  const std::vector<std::uint8_t> bytes = encode(mesh);
  const auto back = decode(bytes);
  ASSERT_TRUE(back) << back.error().message;
  ASSERT_TRUE(back.value()->environment);
  EXPECT_EQ(back.value()->environment->texels, light->texels);
  EXPECT_EQ(back.value()->environment->harmonics, light->harmonics);
  EXPECT_FALSE(decode(std::span(bytes).first(bytes.size() - 4)));
  auto broken = std::make_shared<EnvironmentLight>(*light);
  broken->harmonics[3][1] = std::numeric_limits<float>::quiet_NaN();
  mesh.environment = broken;
  EXPECT_FALSE(decode(encode(mesh)));
  broken = std::make_shared<EnvironmentLight>(*light);
  broken->pictureSide = 300;
  mesh.environment = broken;
  EXPECT_FALSE(decode(encode(mesh)));
}

}  // namespace
}  // namespace stadion::test
