#pragma once
// A model with a skin and clips, for tests of figures.

#include "tests/engine/asset/gltf_builder.h"

namespace stadion::test {

/// A strip 2 m high: four corners at each of the heights 0, 1 and 2 (file's y), as a square tube of 0.2 m. The
/// bone "upper", 1 m above "lower", carries the top; both carry the middle in equal parts. Clips: "bend" turns
/// "upper" about the file's z by 90 degrees within a second, "lift" moves "lower" up by 1 m in half a second.
inline GltfBuilder riggedTube() {
  GltfBuilder b;
  std::vector<float> positions, weights;
  std::vector<std::uint8_t> joints;
  std::vector<std::uint16_t> indices;
  for (int ring = 0; ring < 3; ++ring)
    for (int k = 0; k < 4; ++k) {
      positions.insert(positions.end(),
                       {k == 0 || k == 3 ? -0.1f : 0.1f, static_cast<float>(ring), k < 2 ? 0.1f : -0.1f});
      joints.insert(joints.end(), {0, 1, 0, 0});
      const float upper = 0.5f * static_cast<float>(ring);
      weights.insert(weights.end(), {1 - upper, upper, 0, 0});
    }
  const auto quad = [&](int a, int c, int d, int e) {
    for (const int i : {a, c, d, a, d, e}) indices.push_back(static_cast<std::uint16_t>(i));
  };
  for (int ring = 0; ring < 2; ++ring)
    for (int k = 0; k < 4; ++k) {
      const int next = (k + 1) % 4, base = 4 * ring;
      quad(base + k, base + next, base + 4 + next, base + 4 + k);
    }
  quad(3, 2, 1, 0);
  quad(8, 9, 10, 11);
  b.attribute("POSITION", positions, GltfBuilder::kFloat, "VEC3", 12);
  b.attribute("JOINTS_0", joints, GltfBuilder::kUnsignedByte, "VEC4", 12);
  b.attribute("WEIGHTS_0", weights, GltfBuilder::kFloat, "VEC4", 12);
  b.primitive()["indices"] = b.accessor(indices, GltfBuilder::kUnsignedShort, "SCALAR", indices.size());
  b.json["nodes"] = nlohmann::json::parse(R"([{"mesh": 0, "skin": 0, "name": "tube"},
      {"name": "lower", "children": [2]}, {"name": "upper", "translation": [0, 1, 0]}])");
  b.json["scenes"][0]["nodes"] = {0, 1};
  const std::vector<float> binds{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0,  0, 1,
                                 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1};
  b.json["skins"] = {{{"joints", {1, 2}},
                      {"name", "rig"},
                      {"inverseBindMatrices", b.accessor(binds, GltfBuilder::kFloat, "MAT4", 2)}}};
  const auto clip = [&](const char* name, int node, const char* path, std::vector<float> times,
                        const std::vector<float>& values, const char* type) {
    const std::size_t count = times.size();
    return nlohmann::json{{"name", name},
                          {"samplers",
                           {{{"input", b.accessor(times, GltfBuilder::kFloat, "SCALAR", count)},
                             {"output", b.accessor(values, GltfBuilder::kFloat, type, count)}}}},
                          {"channels", {{{"sampler", 0}, {"target", {{"node", node}, {"path", path}}}}}}};
  };
  const float half = 0.70710678f;
  b.json["animations"] = {clip("bend", 2, "rotation", {0, 1}, {0, 0, 0, 1, 0, 0, half, half}, "VEC4"),
                          clip("lift", 1, "translation", {0, 0.5f}, {0, 0, 0, 0, 1, 0}, "VEC3")};
  return b;
}

/// The same with the clip "stroll": "lower" goes 0.6 m along the file's -z (the show's y) within 0.4 s, and up and
/// down.
inline GltfBuilder strollingTube() {
  GltfBuilder b = riggedTube();
  const auto times = b.accessor(std::vector<float>{0, 0.2f, 0.4f}, GltfBuilder::kFloat, "SCALAR", 3);
  const auto values =
      b.accessor(std::vector<float>{0, 0, 0, 0, 0.2f, -0.3f, 0, 0, -0.6f}, GltfBuilder::kFloat, "VEC3", 3);
  b.json["animations"].push_back(
      {{"name", "stroll"},
       {"samplers", {{{"input", times}, {"output", values}}}},
       {"channels", {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "translation"}}}}}}});
  return b;
}

/// A square of 1 m that a morph target "open" stretches along the file's x by up to a metre. Its weight is 0.5 at
/// rest; the clip "swell" takes it from 0 to 1 within a second.
inline GltfBuilder morphingSquare() {
  GltfBuilder b;
  b.square();
  const auto target =
      b.accessor(std::vector<float>{0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0}, GltfBuilder::kFloat, "VEC3", 4);
  b.primitive()["targets"] = {{{"POSITION", target}}};
  b.json["meshes"][0]["extras"] = {{"targetNames", {"open"}}};
  b.json["meshes"][0]["weights"] = {0.5};
  const auto times = b.accessor(std::vector<float>{0, 1}, GltfBuilder::kFloat, "SCALAR", 2);
  const auto values = b.accessor(std::vector<float>{0, 1}, GltfBuilder::kFloat, "SCALAR", 2);
  b.json["animations"] = {{{"name", "swell"},
                           {"samplers", {{{"input", times}, {"output", values}}}},
                           {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}}}};
  return b;
}

}  // namespace stadion::test
