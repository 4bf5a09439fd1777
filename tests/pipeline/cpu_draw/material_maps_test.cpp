/// Maps of materials: the CPU renderer draws them as OpenGL does, and the same pixels on every processor.

#include "pipeline/cpu_draw/kernels/choose_kernels.h"
#include "tests/pipeline/cpu_draw/compared_pictures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace stadion {
namespace {

using test::difference;
using test::drawnByCpu;
using test::drawnByOpenGl;
using test::matt;
using test::MeshMaker;
using test::Picture;
using test::PictureDifference;

constexpr std::uint32_t kMapsWidth = 203, kMapsHeight = 149;

using MapRgb = std::array<double, 3>;

/// A picture of 64 x 64 pixels; `colour`: of a place, 0 .. 1, from the left and the top.
Texture paintedMap(const std::function<MapRgb(double, double)>& colour) {
  constexpr std::uint32_t kSide = 64;
  Texture t{kSide, kSide, {}, "painted"};
  for (std::uint32_t y = 0; y < kSide; ++y)
    for (std::uint32_t x = 0; x < kSide; ++x) {
      for (const double c : colour((x + 0.5) / kSide, (y + 0.5) / kSide))
        t.rgba.push_back(static_cast<std::uint8_t>(std::lround(255 * std::clamp(c, 0.0, 1.0))));
      t.rgba.push_back(255);
    }
  return t;
}

double mapWave(double at) {
  return std::sin(6 * std::numbers::pi * at);
}
double mapWaveSlope(double at) {
  return std::cos(6 * std::numbers::pi * at);
}

Texture finishMap() {
  return paintedMap([](double x, double y) {
    return MapRgb{0, 0.6 + 0.4 * mapWave(x), 0.5 + 0.5 * mapWave(y)};
  });
}
Texture shadeMap() {
  return paintedMap([](double x, double y) { return MapRgb{0.5 + 0.5 * mapWave(x) * mapWave(y), 0, 0}; });
}
/// Of hills and valleys.
Texture reliefMap() {
  return paintedMap([](double x, double y) {
    const Vec3 n = Vec3(-mapWaveSlope(x) * mapWave(y), mapWave(x) * mapWaveSlope(y), 1.5).normalized();
    return MapRgb{0.5 + 0.5 * n.x(), 0.5 + 0.5 * n.y(), 0.5 + 0.5 * n.z()};
  });
}

/// Adds a map to the first material.
MaterialMap& addMap(Mesh& mesh, MapKind kind, Texture texture) {
  mesh.textures.push_back(std::move(texture));
  MaterialMap& map = mesh.materials[0].maps[kind];
  map.texture = static_cast<std::int32_t>(mesh.textures.size()) - 1;
  return map;
}

/// Tangents along u as a modelling program writes them for these spheres and boxes, but turned a little.
void addTangents(Mesh& mesh) {
  for (const auto& normal : mesh.normals) {
    const Vec3 n(normal[0], normal[1], normal[2]);
    const Vec3 across = std::abs(n.z()) < 0.9 ? Vec3::UnitZ().cross(n) : Vec3::UnitX().cross(n);
    const Vec3 t = (across + 0.3 * n.cross(across)).normalized();
    mesh.tangents.push_back({static_cast<float>(t.x()), static_cast<float>(t.y()), static_cast<float>(t.z()),
                             n.x() < 0 ? -1.0f : 1.0f});
  }
}

/// Texture coordinates that run otherwise over the mesh than the first ones.
void addSecondUvs(Mesh& mesh) {
  for (const auto& uv : mesh.uvs) mesh.secondUvs.push_back({0.7f * uv[1] + 0.1f, 0.9f * uv[0] - 0.2f});
}

struct MapFeature {
  std::string name;
  std::function<void(Mesh&)> add;
};

/// All wrap modes with all filters; every use of mipmaps with each wrap mode.
std::vector<MapFeature> samplerFeatures() {
  std::vector<MapFeature> features;
  for (const int wrap : {0, 1, 2})
    for (const int nearest : {0, 1, 2, 3}) {
      const int mipmaps = (wrap + nearest) % 3, across = nearest == 1 ? 2 - wrap / 2 : wrap;
      const Sampler sampler{WrapMode(wrap), WrapMode(across), (nearest & 1) != 0, (nearest & 2) != 0,
                            MipmapUse(mipmaps)};
      const auto add = [=](Mesh& mesh) {
        addMap(mesh, kBaseMap, test::chequered(16, 4)).sampler = sampler;
        for (auto& uv : mesh.uvs) uv = {2.6f * uv[0] - 0.83f, 2.3f * uv[1] - 0.71f};
      };
      features.push_back({"wrap" + std::to_string(wrap) + std::to_string(across) + "-nearest" +
                              std::to_string(nearest) + "-mipmaps" + std::to_string(mipmaps),
                          add});
    }
  return features;
}

std::vector<MapFeature> mapFeatures() {
  const auto all = [](Mesh& mesh) {
    addMap(mesh, kBaseMap, test::chequered(64, 8));
    addMap(mesh, kMetallicRoughnessMap, finishMap());
    addMap(mesh, kNormalMap, reliefMap());
    addMap(mesh, kOcclusionMap, shadeMap());
    mesh.materials[0].occlusionStrength = 0.6f;
  };
  const auto moved = [=](Mesh& mesh) {
    all(mesh);
    mesh.materials[0].emissive = {0.4f, 0.3f, 0.2f};
    addMap(mesh, kEmissiveMap, shadeMap()).secondUvs = true;
    addSecondUvs(mesh);
    auto& of = mesh.materials[0].maps;
    of[kBaseMap].uvTransform = {1.5f, 0.5f, 0.2f, -0.5f, 1.5f, 0.1f};
    of[kNormalMap].uvTransform = {0, 2, 0, -2, 0, 0.5f};
    of[kOcclusionMap].secondUvs = true;
  };
  return {
      {"metallic-roughness", [](Mesh& mesh) { addMap(mesh, kMetallicRoughnessMap, finishMap()); }},
      {"occlusion", [](Mesh& mesh) { addMap(mesh, kOcclusionMap, shadeMap()); }},
      {"unlit",
       [](Mesh& mesh) {
         addMap(mesh, kBaseMap, test::chequered(64, 8));
         mesh.materials[0].unlit = true;
       }},
      {"normals", [](Mesh& mesh) { addMap(mesh, kNormalMap, reliefMap()); }},
      {"strong-normals",
       [](Mesh& mesh) { addMap(mesh, kNormalMap, reliefMap()), mesh.materials[0].normalScale = -1.5f; }},
      {"normals-with-tangents", [](Mesh& mesh) { addMap(mesh, kNormalMap, reliefMap()), addTangents(mesh); }},
      {"normals-on-second-coordinates",
       [](Mesh& mesh) { addMap(mesh, kNormalMap, reliefMap()).secondUvs = true, addSecondUvs(mesh); }},
      {"all", all},
      {"all-moved", moved},
      {"masked",
       [=](Mesh& mesh) {
         moved(mesh);
         mesh.materials[0].alphaCutoff = 0.5f, mesh.materials[0].partlyTransparent = true;
         for (std::size_t i = 3; i < 4 * 64 * 20; i += 4) mesh.textures[0].rgba[i] = 0;
       }},
      {"transparent", [=](Mesh& mesh) { moved(mesh), mesh.materials[0].baseColour[3] = 0.6f; }}};
}

/// A sphere and a box of one material, as they are, turned and mirrored, under a sun, a lamp and haze.
struct MapScene {
  MeshStore meshes;
  DrawList list;

  explicit MapScene(const std::function<void(Mesh&)>& feature) {
    Material material = matt(0.7f, 0.6f, 0.5f);
    material.roughness = 0.8f, material.metallic = 0.6f;
    auto mesh = MeshMaker(material).sphere(0.6, 20).box({0.7, -0.5, -0.5}, {1.7, 0.5, 0.5}).seal();
    feature(*mesh);
    const bool transparent = mesh->transparent();
    const MeshId id = meshes.add(std::move(mesh));
    list = test::richList(meshes, double{kMapsWidth} / kMapsHeight);
    list.opaque.resize(1);  // the ground
    list.transparent.clear();
    auto& items = transparent ? list.transparent : list.opaque;
    items.push_back(test::place(id, placed({-1.6, 0, 0.8}, 0.4, 1)));
    items.push_back(test::place(id, placed({1, 2, 1.6}, 2.1, -1)));
  }

  static Affine placed(const Vec3& at, double angle, double mirrored) {
    Affine X = Affine::Identity();
    X.linear() = Eigen::AngleAxisd(angle, Vec3(0.3, 0.2, 1).normalized()).toRotationMatrix() *
                 Vec3(1, 0.9, mirrored).asDiagonal();
    X.translation() = at;
    return X;
  }
  Picture byCpu(const PictureRung& rung = {}, std::size_t threads = 1,
                const DrawKernels* kernels = nullptr) const {
    return drawnByCpu(meshes, list, kMapsWidth, kMapsHeight, rung, threads, kernels);
  }
  Picture byOpenGl(const RenderQuality& quality = {}) const {
    return drawnByOpenGl(meshes, list, kMapsWidth, kMapsHeight, quality);
  }
};

/// Edges differ where OpenGL moves corners to a grid of 1/256 pixel; textures by the rounding of filters.
void expectSamePicture(const Picture& cpu, const Picture& gl, const std::string& name, double mean = 0.3,
                       double alike = 0.995) {
  const PictureDifference d = difference(cpu, gl);
  ::testing::Test::RecordProperty(name, std::to_string(d.mean) + " " + std::to_string(d.alike));
  EXPECT_LE(d.mean, mean) << name << ", greatest " << d.most;
  EXPECT_GE(d.alike, alike) << name << ", greatest " << d.most;
  if (d.mean <= mean && d.alike >= alike) return;
  test::writePng(cpu, name + "-cpu"), test::writePng(gl, name + "-gl");
}

TEST(MaterialMaps, AreReadThroughTheirSamplersAsByOpenGl) {
  for (const MapFeature& f : samplerFeatures()) {
    const MapScene scene(f.add);
    expectSamePicture(scene.byCpu(), scene.byOpenGl(), f.name);
  }
}

TEST(MaterialMaps, AreDrawnAsByOpenGl) {
  const Picture without = MapScene([](Mesh&) {}).byCpu();
  for (const MapFeature& f : mapFeatures()) {
    const MapScene scene(f.add);
    const Picture cpu = scene.byCpu();
    expectSamePicture(cpu, scene.byOpenGl(), f.name);
    EXPECT_GT(difference(cpu, without).mean, 0.3) << f.name << " changes nothing";
  }
}

TEST(MaterialMaps, AreTheSameWithManyDrawsInOneCallOfOpenGl) {
  RenderQuality indirect;
  indirect.submission.indirect = GlUse::Always;
  RenderQuality direct;
  direct.submission.indirect = GlUse::Never;
  for (const MapFeature& f : mapFeatures()) {
    if (f.name != "all-moved" && f.name != "normals-with-tangents" && f.name != "unlit") continue;
    const MapScene scene(f.add);
    EXPECT_EQ(scene.byOpenGl(indirect), scene.byOpenGl(direct)) << f.name;
  }
}

TEST(MaterialMaps, GiveTheSamePixelsWithAllKernelsAndAnyNumberOfThreads) {
  std::vector<MapFeature> features = mapFeatures();
  const auto some = samplerFeatures();
  features.insert(features.end(), {some[1], some[6], some[11]});
  for (const MapFeature& f : features) {
    const MapScene scene(f.add);
    const Picture first = scene.byCpu({}, 1, &kDrawByFour);
    for (const DrawKernels* kernels : drawKernelsHere())
      for (const std::size_t threads : {1u, 3u})
        EXPECT_EQ(scene.byCpu({}, threads, kernels), first)
            << f.name << ", " << kernels->name << ", " << threads << " threads";
  }
}

TEST(MaterialMaps, OfNumbersAreLeftOutInThePlainLook) {
  const PictureRung plain = PictureRung::of(RenderQuality::plain());
  const auto base = [](Mesh& mesh) { addMap(mesh, kBaseMap, test::chequered(64, 8)); };
  const MapScene without(base);
  const MapScene scene([&](Mesh& mesh) {
    base(mesh);
    addMap(mesh, kMetallicRoughnessMap, finishMap()), addMap(mesh, kNormalMap, reliefMap());
    addMap(mesh, kOcclusionMap, shadeMap()), addTangents(mesh);
  });
  EXPECT_EQ(scene.byCpu(plain), without.byCpu(plain));
  EXPECT_EQ(scene.byOpenGl(RenderQuality::plain()), without.byOpenGl(RenderQuality::plain()));
}

TEST(MaterialMaps, OfThePlainLookAreDrawnAsByOpenGl) {
  for (const MapFeature& f : mapFeatures()) {
    const MapScene scene(f.add);
    expectSamePicture(scene.byCpu(PictureRung::of(RenderQuality::plain())),
                      scene.byOpenGl(RenderQuality::plain()), "plain-" + f.name, 0.5, 0.985);
  }
}

/// A quad that fills the picture, with the light of plainList().
struct MappedQuad {
  MeshStore meshes;
  DrawList list = test::plainList();

  explicit MappedQuad(const std::function<void(Mesh&)>& feature) {
    auto mesh = MeshMaker(matt(0.5f, 0.5f, 0.5f)).quad({-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}).seal();
    feature(*mesh);
    list.opaque = {test::place(meshes.add(std::move(mesh)))};
  }
  /// Pictures of 32 x 32 pixels, by name of the renderer.
  std::vector<std::pair<const char*, Picture>> pictures() const {
    return {{"CPU", drawnByCpu(meshes, list, 32, 32)}, {"OpenGL", drawnByOpenGl(meshes, list, 32, 32)}};
  }
  /// Red in the middle.
  void expectRed(double wanted, const std::string& what, double tolerance = 1.5) const {
    for (const auto& [renderer, picture] : pictures())
      EXPECT_NEAR(picture.at(16, 16)[0], wanted, tolerance) << what << ", " << renderer;
  }
};

Texture onePixelMap(std::uint8_t red, std::uint8_t green, std::uint8_t blue) {
  return {1, 1, {red, green, blue, 255}, "one pixel"};
}

TEST(MaterialMaps, OcclusionDimsTheLightFromAroundByItsStrength) {
  for (const float strength : {0.0f, 0.5f, 1.0f}) {
    const MappedQuad quad([&](Mesh& mesh) {
      addMap(mesh, kOcclusionMap, onePixelMap(51, 255, 255));
      mesh.materials[0].occlusionStrength = strength;
    });
    quad.expectRed(test::sRgb(0.5 * (1 - 0.8 * double{strength})), std::to_string(strength));
  }
}

TEST(MaterialMaps, AnUnlitSurfaceShowsItsColourWhateverTheLight) {
  for (const double light : {0.0, 5.0})
    for (const float colour : {0.25f, 1.0f}) {
      MappedQuad quad([&](Mesh& mesh) {
        mesh.materials[0].unlit = true, mesh.materials[0].baseColour = {colour, 0, 0, 1};
        mesh.materials[0].emissive = {1, 1, 1};
      });
      quad.list.sky.ambient = {float(light), float(light), float(light)};
      quad.expectRed(test::sRgb(double{colour}), std::to_string(light));
    }
}

TEST(MaterialMaps, PicturesContinueBeyondTheirEdgesAsTheSamplerSays) {
  // A black and a white pixel side by side; the quad shows eight columns, with middles at u = -1.25, -0.75, ...
  const Texture columns{2, 1, {0, 0, 0, 255, 255, 255, 255, 255}, "columns"};
  const std::array<std::array<int, 8>, 3> wanted{{{1, 0, 1, 0, 1, 0, 1, 0},    // repeat
                                                  {1, 1, 0, 0, 1, 1, 0, 0},    // mirror
                                                  {0, 0, 0, 0, 1, 1, 1, 1}}};  // clamp
  for (const WrapMode wrap : {WrapMode::Repeat, WrapMode::Mirror, WrapMode::Clamp}) {
    const MappedQuad quad([&](Mesh& mesh) {
      mesh.materials[0].baseColour = {1, 1, 1, 1}, mesh.materials[0].unlit = true;
      addMap(mesh, kBaseMap, columns).sampler = {wrap, wrap, true, true, MipmapUse::None};
      for (auto& uv : mesh.uvs) uv[0] = 4 * uv[0] - 1.5f;
    });
    for (const auto& [renderer, picture] : quad.pictures())
      for (std::uint32_t i = 0; i < 8; ++i)
        EXPECT_EQ(picture.at(4 * i + 2, 16)[0], 255 * wanted[std::size_t(wrap)][i])
            << renderer << ", wrap " << int(wrap) << ", column " << i;
  }
}

/// The light that a quad with the normal (red, green, blue) sends, if a lamp shines from `towards`.
void expectLitQuad(const std::array<std::uint8_t, 3>& normal, const Vec3& towards, double wanted,
                   const std::function<void(Mesh&)>& change) {
  MappedQuad quad([&](Mesh& mesh) {
    addMap(mesh, kNormalMap, onePixelMap(normal[0], normal[1], normal[2]));
    change(mesh);
  });
  quad.list.sky.ambient = {0, 0, 0};
  DrawLight sun;
  for (std::size_t k = 0; k < 3; ++k) sun.direction[k] = static_cast<float>(-towards[static_cast<int>(k)]);
  quad.list.lights = {sun};
  // The highlight of a matt surface adds up to a hundredth.
  quad.expectRed(test::sRgb(0.5 * wanted), "towards " + std::to_string(towards.x()), 4);
}

TEST(MaterialMaps, NormalsPointAlongUAndUpInThePicture) {
  constexpr std::array<std::uint8_t, 3> kRight{218, 128, 218}, kUp{128, 218, 218};  // by 45 degrees
  const double half = std::sqrt(0.5);
  const auto none = [](Mesh&) {};
  const auto turnedPicture = [](Mesh& mesh) {  // u runs to the left, v upwards
    for (auto& uv : mesh.uvs) uv = {1 - uv[0], 1 - uv[1]};
  };
  const auto withTangents = [](Mesh& mesh) { mesh.tangents.assign(mesh.positions.size(), {1, 0, 0, 1}); };
  const auto otherSide = [](Mesh& mesh) { mesh.tangents.assign(mesh.positions.size(), {1, 0, 0, -1}); };
  for (const auto& change : std::vector<std::function<void(Mesh&)>>{none, withTangents}) {
    expectLitQuad(kRight, Vec3::UnitX(), half, change);
    expectLitQuad(kRight, -Vec3::UnitX(), 0, change);
    expectLitQuad(kUp, Vec3::UnitZ(), half, change);
    expectLitQuad(kUp, -Vec3::UnitZ(), 0, change);
    expectLitQuad(kUp, -Vec3::UnitY(), half, change);
  }
  expectLitQuad(kRight, -Vec3::UnitX(), half, turnedPicture);
  expectLitQuad(kUp, -Vec3::UnitZ(), half, turnedPicture);
  expectLitQuad(kUp, -Vec3::UnitZ(), half, otherSide);
  expectLitQuad(kUp, Vec3::UnitZ(), 0, [](Mesh& mesh) { mesh.materials[0].normalScale = -1; });
  expectLitQuad(kUp, -Vec3::UnitY(), 1, [](Mesh& mesh) { mesh.materials[0].normalScale = 0; });
}

TEST(MaterialMaps, SurviveWhatIsNotFinite) {
  const float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();
  for (const float odd : {kNan, kInf, -3e38f}) {
    const MapScene scene([&](Mesh& mesh) {
      for (const MapFeature& f : mapFeatures())
        if (f.name == "all-moved") f.add(mesh);
      addTangents(mesh);
      for (std::size_t v = 0; v < mesh.positions.size(); v += 3)
        mesh.tangents[v][v % 4] = odd, mesh.secondUvs[v][v % 2] = odd, mesh.uvs[v + 1][v % 2] = odd;
      mesh.materials[0].normalScale = odd, mesh.materials[0].occlusionStrength = odd;
      mesh.materials[0].maps[kNormalMap].uvTransform[1] = odd;
    });
    const Picture first = scene.byCpu({}, 1, &kDrawByFour);
    for (const DrawKernels* kernels : drawKernelsHere())
      EXPECT_EQ(scene.byCpu({}, 2, kernels), first) << kernels->name << ", " << odd;
    scene.byOpenGl();
  }
}

}  // namespace
}  // namespace stadion
