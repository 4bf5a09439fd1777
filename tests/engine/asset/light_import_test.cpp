/// Lights and cameras of model files, as a mesh has them.

#include "engine/asset/mesh_file.h"
#include "tests/engine/asset/gltf_builder.h"
#include "tests/engine/asset/importing.h"

#include <cmath>
#include <numbers>

namespace stadion::test {
namespace {

using Json = nlohmann::json;

/// A square, and a lamp, a spot, a sun and a camera. The file's (x, y, z) is (x, -z, y) in a show.
GltfBuilder litModel() {
  GltfBuilder b;
  b.square();
  b.json["cameras"] =
      Json::parse(R"([{"name": "lens", "type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}])");
  b.json["extensionsUsed"] = {"KHR_lights_punctual"};
  b.json["extensions"]["KHR_lights_punctual"]["lights"] = Json::parse(
      R"([{"name": "bulb", "type": "point", "color": [1, 0.5, 0.25], "intensity": 6.283185307179586, "range": 7},
          {"name": "beam", "type": "spot", "spot": {"innerConeAngle": 0.2, "outerConeAngle": 0.4}},
          {"type": "directional", "intensity": 3.141592653589793}, {"name": "glow", "type": "area"}])");
  const auto light = [](int number) { return Json{{"KHR_lights_punctual", {{"light", number}}}}; };
  b.json["nodes"] = Json::parse(
      R"([{"name": "hall", "mesh": 0, "children": [1, 4]},
          {"name": "roof", "mesh": 0, "translation": [0, 3, 0], "scale": [2, 2, 2], "children": [2, 3]},
          {"name": "lamp", "translation": [1, 0, 0]},
          {"rotation": [-0.7071067811865476, 0, 0, 0.7071067811865476]},
          {"name": "sun"},
          {"name": "glow"},
          {"name": "front", "camera": 0, "translation": [0, 2, 5]}])");
  for (const auto& [node, number] : {std::pair{2, 0}, {3, 1}, {4, 2}, {5, 3}})
    b.json["nodes"][static_cast<std::size_t>(node)]["extensions"] = light(number);
  b.json["scenes"][0]["nodes"] = {0, 5, 6};
  return b;
}

Imported imported(const GltfBuilder& b, const NodeSelection& nodes = {}) {
  TestFolder folder;
  folder.write("hall.glb", b.glb());
  ImportOptions options;
  options.nodes = nodes;
  return importOf(folder.path(), "hall.glb", options);
}

const ModelLight* lightOf(const Mesh& mesh, const std::string& name) {
  const auto at = std::ranges::find(mesh.lights, name, &ModelLight::name);
  return at == mesh.lights.end() ? nullptr : &*at;
}

double apart(const std::array<float, 3>& a, const Vec3& b) {
  return (Vec3(double{a[0]}, double{a[1]}, double{a[2]}) - b).norm();
}

TEST(LightImport, LightsHaveTheFilesPlacesColoursAndCones) {
  const Imported m = imported(litModel());
  ASSERT_TRUE(m.mesh) << m.error;
  ASSERT_EQ(m.mesh->lights.size(), 3u) << "an area light is none of a show";
  const ModelLight *lamp = lightOf(*m.mesh, "lamp"), *beam = lightOf(*m.mesh, "beam"),
                   *sun = lightOf(*m.mesh, "sun");
  ASSERT_TRUE(lamp && beam && sun);
  EXPECT_EQ(lamp->kind, ModelLight::Kind::Point);
  EXPECT_LT(apart(lamp->position, {2, 0, 3}), 1e-6) << "the roof's scale moves it";
  EXPECT_FLOAT_EQ(lamp->range, 7) << "but leaves its range";
  EXPECT_LT(apart(lamp->colour, {2, 1, 0.5}), 1e-6) << "2 pi candela";
  EXPECT_EQ(beam->kind, ModelLight::Kind::Spot);
  EXPECT_LT(apart(beam->direction, {0, 0, -1}), 1e-6) << "down";
  EXPECT_FLOAT_EQ(beam->innerAngle, 0.2f);
  EXPECT_FLOAT_EQ(beam->outerAngle, 0.4f);
  EXPECT_EQ(beam->range, 0);
  EXPECT_EQ(sun->kind, ModelLight::Kind::Directional);
  EXPECT_LT(apart(sun->direction, {0, 1, 0}), 1e-6) << "the file's -z";
  EXPECT_LT(apart(sun->colour, {1, 1, 1}), 1e-6) << "pi lux";
  EXPECT_TRUE(m.leftOut("1 light (\"glow\"): shows have none of this kind")) << m.all();
}

TEST(LightImport, CamerasHaveTheirPlacesAndDirections) {
  const Imported m = imported(litModel());
  ASSERT_TRUE(m.mesh) << m.error;
  ASSERT_EQ(m.mesh->cameras.size(), 1u);
  EXPECT_EQ(m.mesh->cameras[0].name, "front");
  EXPECT_LT(apart(m.mesh->cameras[0].position, {0, -5, 2}), 1e-6);
  EXPECT_LT(apart(m.mesh->cameras[0].direction, {0, 1, 0}), 1e-6);
}

TEST(LightImport, APartHasTheLightsBelowItInItsOwnCoordinates) {
  const Imported roof = imported(litModel(), {"roof", {}}), rest = imported(litModel(), {"", {"roof"}});
  ASSERT_TRUE(roof.mesh && rest.mesh) << roof.error << rest.error;
  ASSERT_TRUE(lightOf(*roof.mesh, "lamp"));
  EXPECT_LT(apart(lightOf(*roof.mesh, "lamp")->position, {2, 0, 0}), 1e-6);
  EXPECT_FALSE(lightOf(*roof.mesh, "sun") || lightOf(*rest.mesh, "lamp"));
  EXPECT_TRUE(lightOf(*rest.mesh, "sun"));
}

TEST(LightImport, LightsBelongToTheContentHashAndSurviveTheWayAsBytes) {
  GltfBuilder other = litModel();
  other.json["extensions"]["KHR_lights_punctual"]["lights"][0]["intensity"] = 5;
  const Imported a = imported(litModel()), b = imported(other), again = imported(litModel());
  ASSERT_TRUE(a.mesh && b.mesh && again.mesh);
  EXPECT_NE(a.mesh->hash, b.mesh->hash);
  EXPECT_EQ(a.mesh->hash, again.mesh->hash);
  std::vector<std::uint8_t> bytes = encode(*a.mesh);
  const auto back = decode(bytes);
  ASSERT_TRUE(back);
  EXPECT_EQ(encode(*back.value()), bytes);
  EXPECT_EQ(back.value()->lights.size(), 3u);
  Mesh dark = std::move(*back.value());
  dark.lights[0].colour[1] = std::nanf("");
  EXPECT_FALSE(decode(encode(dark)));
  dark.lights[0].colour[1] = 0, dark.cameras[0].direction = {0, 0, 0};
  EXPECT_FALSE(decode(encode(dark)));
}

TEST(LightImport, NumbersThatAreNoneGiveLightsThatCanBeDrawn) {
  GltfBuilder b = litModel();
  Json& lights = b.json["extensions"]["KHR_lights_punctual"]["lights"];
  lights[0]["intensity"] = 1e300, lights[0]["range"] = -5, lights[1]["spot"]["outerConeAngle"] = 9;
  lights[1]["spot"]["innerConeAngle"] = 12;
  const Imported m = imported(b);
  ASSERT_TRUE(m.mesh) << m.error;
  for (const ModelLight& light : m.mesh->lights) {
    for (const float c : light.colour) EXPECT_TRUE(c >= 0 && c <= 1e9f) << light.name;
    EXPECT_GE(light.range, 0);
    EXPECT_LE(light.innerAngle, light.outerAngle);
    EXPECT_LE(light.outerAngle, 1.6f);
  }
}

TEST(LightImport, ALightThatLiesNowhereIsToldOf) {
  for (const char* place : {R"({"translation": [1e30, 0, 0]})", R"({"scale": [0, 0, 0]})"}) {
    GltfBuilder b = litModel();
    b.json["nodes"][2].update(Json::parse(place));
    const Imported got = imported(b);
    ASSERT_TRUE(got.mesh) << got.error;
    EXPECT_TRUE(got.leftOut("the light \"lamp\": its node is too far away, or of no size")) << got.all();
  }
}

TEST(LightImport, ANodeOfASceneThatIsNotShownIsReachedAsAPart) {
  GltfBuilder b;
  b.square();
  b.json["nodes"] =
      Json::parse(R"([{"name": "day", "mesh": 0}, {"name": "night", "mesh": 0, "translation": [0, 0, -4]}])");
  b.json["scenes"] = Json::parse(R"([{"nodes": [0]}, {"name": "second", "nodes": [1]}])");
  const Imported m = imported(b, {"night", {}});
  ASSERT_TRUE(m.mesh) << m.error;
  EXPECT_LT((m.mesh->place.translation() - Vec3(0, 4, 0)).norm(), 1e-9);
}

}  // namespace
}  // namespace stadion::test
