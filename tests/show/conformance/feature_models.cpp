#include "tests/show/conformance/feature_models.h"

#include "pipeline/picture/picture.h"
#include "tests/engine/asset/rigged_model.h"
#include "tests/programs/program.h"

#include <array>
#include <cmath>
#include <functional>
#include <numbers>

namespace stadion::test {
namespace {

using nlohmann::json;

/// The bytes of a PNG of 64 x 64 pixels; `colour`: of a place, 0 .. 1 from the left and the top.
std::string pictureOf(const std::function<std::array<double, 4>(double, double)>& colour) {
  constexpr std::uint32_t kSide = 64;
  Picture picture(kSide, kSide);
  for (std::uint32_t y = 0; y < kSide; ++y)
    for (std::uint32_t x = 0; x < kSide; ++x) {
      const auto c = colour((x + 0.5) / kSide, (y + 0.5) / kSide);
      for (std::size_t k = 0; k < 4; ++k)
        picture.at(x, y)[k] = static_cast<std::uint8_t>(std::lround(255 * std::clamp(c[k], 0.0, 1.0)));
    }
  const TestFolder folder;
  const std::string file = (folder.path() / "picture.png").string();
  writePng(file, picture);
  return fileContent(file);
}

/// Adds a texture and returns its number.
std::size_t addTexture(GltfBuilder& b, const std::string& png, const json& sampler = json::object()) {
  b.json["images"].push_back({{"mimeType", "image/png"}, {"bufferView", b.view(png.data(), png.size())}});
  b.json["samplers"].push_back(sampler);
  b.json["textures"].push_back(
      {{"source", b.json["images"].size() - 1}, {"sampler", b.json["samplers"].size() - 1}});
  return b.json["textures"].size() - 1;
}

std::string tiles() {
  return pictureOf([](double x, double y) -> std::array<double, 4> {
    const bool odd = (static_cast<int>(4 * x) + static_cast<int>(4 * y)) % 2 != 0;
    return {odd ? 0.8 : 0.3, 0.2 + 0.6 * x, 0.2 + 0.6 * y, 1};
  });
}

std::string finish() {
  return pictureOf([](double x, double y) -> std::array<double, 4> { return {0, 0.5 + 0.5 * x, y, 1}; });
}

std::string waves() {
  return pictureOf([](double x, double y) -> std::array<double, 4> {
    const double slopeX = 0.4 * std::cos(6 * std::numbers::pi * x),
                 slopeY = 0.4 * std::cos(6 * std::numbers::pi * y);
    const double length = std::sqrt(1 + slopeX * slopeX + slopeY * slopeY);
    return {0.5 - 0.5 * slopeX / length, 0.5 + 0.5 * slopeY / length, 0.5 + 0.5 / length, 1};
  });
}

std::string shade() {
  return pictureOf([](double x, double) -> std::array<double, 4> { return {x, 0.5, 0.5, 1}; });
}

std::string dots() {
  return pictureOf([](double x, double y) -> std::array<double, 4> {
    return {0.7, 0.5, 0.3, std::hypot(x - 0.5, y - 0.5) < 0.45 ? 0.9 : 0.1};
  });
}

constexpr std::uint32_t kAround = 96, kUp = 48;

/// A ball of radius 1.
GltfBuilder ball(bool tangents = false) {
  GltfBuilder b;
  std::vector<float> positions, uvs, tangent;
  std::vector<std::uint16_t> indices;
  for (std::uint32_t j = 0; j <= kUp; ++j)
    for (std::uint32_t i = 0; i <= kAround; ++i) {
      const double u = double(i) / kAround, v = double(j) / kUp, a = 2 * std::numbers::pi * u,
                   h = std::numbers::pi * v;
      for (const double x : {-std::cos(a) * std::sin(h), std::cos(h), std::sin(a) * std::sin(h)})
        positions.push_back(static_cast<float>(x));
      uvs.insert(uvs.end(), {static_cast<float>(u), static_cast<float>(v)});
      for (const double x : {std::sin(a), 0.0, std::cos(a), 1.0}) tangent.push_back(static_cast<float>(x));
    }
  for (std::uint32_t j = 0; j < kUp; ++j)
    for (std::uint32_t i = 0; i < kAround; ++i) {
      const std::uint32_t at = j * (kAround + 1) + i, below = at + kAround + 1;
      for (const std::uint32_t k : {at, below, below + 1, at, below + 1, at + 1})
        indices.push_back(static_cast<std::uint16_t>(k));
    }
  const std::size_t count = positions.size() / 3;
  b.attribute("POSITION", positions, GltfBuilder::kFloat, "VEC3", count);
  b.attribute("NORMAL", positions, GltfBuilder::kFloat, "VEC3", count);
  b.attribute("TEXCOORD_0", uvs, GltfBuilder::kFloat, "VEC2", count);
  if (tangents) b.attribute("TANGENT", tangent, GltfBuilder::kFloat, "VEC4", count);
  b.primitive()["indices"] = b.accessor(indices, GltfBuilder::kUnsignedShort, "SCALAR", indices.size());
  return b;
}

/// A square of 2 m that faces the viewer.
GltfBuilder panel() {
  GltfBuilder b;
  b.attribute("POSITION", std::vector<float>{-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0}, GltfBuilder::kFloat,
              "VEC3", 4);
  b.attribute("NORMAL", std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, GltfBuilder::kFloat, "VEC3",
              4);
  b.attribute("TEXCOORD_0", std::vector<float>{0, 1, 1, 1, 1, 0, 0, 0}, GltfBuilder::kFloat, "VEC2", 4);
  b.primitive()["indices"] =
      b.accessor(std::vector<std::uint16_t>{0, 1, 2, 0, 2, 3}, GltfBuilder::kUnsignedShort, "SCALAR", 6);
  return b;
}

/// A box with sides of 1 m, each with corners of its own.
struct Box {
  std::vector<float> positions, normals;
  std::vector<std::uint16_t> indices;
  Box() {
    for (int axis = 0; axis < 3; ++axis)
      for (const float side : {-0.5f, 0.5f}) {
        const auto first = static_cast<std::uint16_t>(positions.size() / 3);
        for (int corner = 0; corner < 4; ++corner) {
          std::array<float, 3> p{}, n{};
          p[std::size_t(axis)] = side, n[std::size_t(axis)] = 2 * side;
          p[std::size_t((axis + 1) % 3)] = corner == 1 || corner == 2 ? 0.5f : -0.5f;
          p[std::size_t((axis + 2) % 3)] = (corner >= 2) == (side > 0) ? 0.5f : -0.5f;
          positions.insert(positions.end(), p.begin(), p.end());
          normals.insert(normals.end(), n.begin(), n.end());
        }
        for (const int k : {0, 1, 2, 0, 2, 3}) indices.push_back(static_cast<std::uint16_t>(first + k));
      }
  }
};

GltfBuilder box(bool normals = true) {
  const Box shape;
  GltfBuilder b;
  b.attribute("POSITION", shape.positions, GltfBuilder::kFloat, "VEC3", 24);
  if (normals) b.attribute("NORMAL", shape.normals, GltfBuilder::kFloat, "VEC3", 24);
  b.primitive()["indices"] = b.accessor(shape.indices, GltfBuilder::kUnsignedShort, "SCALAR", 36);
  return b;
}

/// A matt material without highlights, so that diffuse light alone counts.
json matt(const json& colour) {
  return {
      {"pbrMetallicRoughness", {{"baseColorFactor", colour}, {"metallicFactor", 0}, {"roughnessFactor", 1}}},
      {"extensions", {{"KHR_materials_specular", {{"specularFactor", 0}}}}}};
}

class Models {
public:
  std::vector<FeatureModel> all;

  GltfBuilder& add(const std::string& name, GltfBuilder model, const json& material) {
    if (!material.is_null()) {
      model.json["materials"].push_back(material);
      model.primitive()["material"] = 0;
      if (material.contains("extensions"))
        for (const auto& [extension, unused] : material["extensions"].items())
          model.json["extensionsUsed"].push_back(extension);
    }
    all.push_back({name, std::move(model)});
    return all.back().model;
  }
  FeatureModel& last() { return all.back(); }
  json& material() { return all.back().model.json["materials"][0]; }
  json& finishOf() { return material()["pbrMetallicRoughness"]; }
};

const json kGrey = {0.5, 0.5, 0.5, 1};

void addColours(Models& m) {
  m.add("colour-diffuse", ball(), matt({0.6, 0.3, 0.2, 1}));
  auto* b = &m.add("colour-map", panel(), matt({1, 1, 1, 1}));
  m.finishOf()["baseColorTexture"] = {{"index", addTexture(*b, tiles())}};
  b = &m.add("colour-map-times-factor", ball(), matt({0.9, 0.6, 0.4, 1}));
  m.finishOf()["baseColorTexture"] = {{"index", addTexture(*b, tiles())}};
  b = &m.add("colour-of-vertices", panel(), matt({1, 1, 1, 1}));
  b->attribute("COLOR_0", std::vector<float>{0.8f, 0, 0, 0, 0.8f, 0, 0, 0, 0.8f, 0.8f, 0.8f, 0.1f},
               GltfBuilder::kFloat, "VEC3", 4);
  b = &m.add("colour-of-vertices-in-bytes", panel(), matt({1, 1, 1, 1}));
  const auto bytes = b->attribute(
      "COLOR_0",
      std::vector<std::uint8_t>{200, 40, 0, 255, 40, 200, 0, 255, 0, 40, 200, 255, 90, 90, 90, 255},
      GltfBuilder::kUnsignedByte, "VEC4", 4);
  b->json["accessors"][bytes]["normalized"] = true;
  b = &m.add("colour-of-vertices-times-map", panel(), matt({1, 1, 1, 1}));
  b->attribute("COLOR_0", std::vector<float>{0.8f, 0.4f, 0.4f, 0.4f, 0.8f, 0.4f, 0.4f, 0.4f, 0.8f, 1, 1, 1},
               GltfBuilder::kFloat, "VEC3", 4);
  m.finishOf()["baseColorTexture"] = {{"index", addTexture(*b, tiles())}};
}

void addSamplers(Models& m) {
  const auto add = [&](const char* name, const json& sampler, double scale) {
    GltfBuilder& b = m.add(name, panel(), matt({1, 1, 1, 1}));
    m.finishOf()["baseColorTexture"] = {
        {"index", addTexture(b, tiles(), sampler)},
        {"extensions", {{"KHR_texture_transform", {{"scale", {scale, scale}}, {"offset", {-0.7, -0.6}}}}}}};
    b.json["extensionsUsed"].push_back("KHR_texture_transform");
  };
  constexpr int kRepeat = 10497, kMirror = 33648, kClamp = 33071, kNearest = 9728, kLinear = 9729;
  add("sampler-repeat", {{"wrapS", kRepeat}, {"wrapT", kRepeat}}, 2.5);
  add("sampler-mirror", {{"wrapS", kMirror}, {"wrapT", kMirror}}, 2.5);
  add("sampler-clamp", {{"wrapS", kClamp}, {"wrapT", kClamp}}, 2.5);
  add("sampler-clamp-and-mirror", {{"wrapS", kClamp}, {"wrapT", kMirror}}, 2.5);
  add("sampler-nearest", {{"magFilter", kNearest}, {"minFilter", kNearest}}, 0.3);
  add("sampler-linear-without-mipmaps", {{"magFilter", kLinear}, {"minFilter", kLinear}}, 0.4);
}

void addCoordinates(Models& m) {
  const auto add = [&](const char* name, const json& transform) {
    GltfBuilder& b = m.add(name, panel(), matt({1, 1, 1, 1}));
    m.finishOf()["baseColorTexture"] = {{"index", addTexture(b, tiles())},
                                        {"extensions", {{"KHR_texture_transform", transform}}}};
    b.json["extensionsUsed"].push_back("KHR_texture_transform");
  };
  add("transform-offset", {{"offset", {0.3, 0.1}}});
  add("transform-scale", {{"scale", {0.5, 2}}});
  add("transform-rotation", {{"rotation", 0.7}});
  add("transform-all", {{"offset", {0.2, 0.4}}, {"scale", {1.5, 0.7}}, {"rotation", -0.4}});
  GltfBuilder* b = &m.add("coordinates-second", panel(), matt({1, 1, 1, 1}));
  b->attribute("TEXCOORD_1", std::vector<float>{1, 1, 1, 0, 0, 0, 0, 1}, GltfBuilder::kFloat, "VEC2", 4);
  m.finishOf()["baseColorTexture"] = {{"index", addTexture(*b, tiles())}, {"texCoord", 1}};
  b = &m.add("coordinates-of-two-maps", panel(), matt({1, 1, 1, 1}));
  b->attribute("TEXCOORD_1", std::vector<float>{1, 1, 1, 0, 0, 0, 0, 1}, GltfBuilder::kFloat, "VEC2", 4);
  m.finishOf()["baseColorTexture"] = {{"index", addTexture(*b, tiles())}};
  m.material()["occlusionTexture"] = {{"index", addTexture(*b, shade())}, {"texCoord", 1}};
  b = &m.add("coordinates-in-bytes", panel(), matt({1, 1, 1, 1}));
  const auto at = b->attribute("TEXCOORD_0", std::vector<std::uint8_t>{0, 255, 255, 255, 255, 0, 0, 0},
                               GltfBuilder::kUnsignedByte, "VEC2", 4);
  b->json["accessors"][at]["normalized"] = true;
  b->json["bufferViews"][b->json["accessors"][at]["bufferView"].get<std::size_t>()].erase("byteStride");
  m.finishOf()["baseColorTexture"] = {{"index", addTexture(*b, tiles())}};
}

void addAlpha(Models& m) {
  for (const double cutoff : {0.3, 0.5, 0.8}) {
    GltfBuilder& b = m.add("mask-" + std::to_string(int(10 * cutoff)), panel(), matt({1, 1, 1, 1}));
    m.finishOf()["baseColorTexture"] = {{"index", addTexture(b, dots())}};
    m.material()["alphaMode"] = "MASK", m.material()["alphaCutoff"] = cutoff;
  }
  m.add("blend-factor", panel(), matt({0.6, 0.3, 0.2, 0.4}));
  m.material()["alphaMode"] = "BLEND";
  GltfBuilder* b = &m.add("blend-map", panel(), matt({1, 1, 1, 0.8}));
  m.finishOf()["baseColorTexture"] = {{"index", addTexture(*b, dots())}};
  m.material()["alphaMode"] = "BLEND";
  b = &m.add("blend-vertices", panel(), matt({1, 1, 1, 1}));
  b->attribute("COLOR_0", std::vector<float>{1, 0, 0, 0.2f, 0, 1, 0, 0.4f, 0, 0, 1, 0.6f, 1, 1, 1, 0.8f},
               GltfBuilder::kFloat, "VEC4", 4);
  m.material()["alphaMode"] = "BLEND";
  const json back = json::parse(R"({"mesh": 0, "rotation": [0, 0.9659258, 0, 0.2588190]})");
  b = &m.add("double-sided-from-behind", panel(), matt({0.6, 0.6, 0.6, 1}));
  m.material()["doubleSided"] = true;
  b->json["nodes"][0] = back;
}

void addFinish(Models& m) {
  const auto add = [&](const char* name, double roughness, double metallic) {
    m.add(name, ball(),
          {{"pbrMetallicRoughness",
            {{"baseColorFactor", {0.5, 0.35, 0.2, 1}},
             {"roughnessFactor", roughness},
             {"metallicFactor", metallic}}}});
    // Highlights beyond white are bent down to it here and cut off there. Metals reflect light from all sides with
    // other approximations of how rough surfaces do.
    m.last().reflects = true, m.last().mean = 3, m.last().worst = 25;
  };
  add("finish-rough", 0.9, 0);
  add("finish-satin", 0.5, 0);
  add("finish-smooth", 0.3, 0);
  add("finish-metal-rough", 0.8, 1);
  add("finish-metal-satin", 0.5, 1);
  add("finish-half-metal", 0.6, 0.5);
  add("finish-map", 1, 1);
  m.finishOf()["metallicRoughnessTexture"] = {{"index", addTexture(m.last().model, finish())}};
  add("finish-map-times-factors", 0.8, 0.5);
  m.finishOf()["metallicRoughnessTexture"] = {{"index", addTexture(m.last().model, finish())}};
}

void addNormals(Models& m) {
  const auto add = [&](const char* name, GltfBuilder model, double scale) {
    GltfBuilder& b = m.add(name, std::move(model), matt({0.6, 0.6, 0.6, 1}));
    m.material()["normalTexture"] = {{"index", addTexture(b, waves())}, {"scale", scale}};
  };
  add("normal-map-panel", panel(), 1);
  add("normal-map-tangents", ball(true), 1);
  add("normal-map-without-tangents", ball(), 1);
  m.last().mean = 2, m.last().worst = 16;  // each triangle has a tangent of its own
  add("normal-map-half", ball(true), 0.5);
  add("normal-map-against", ball(true), -1);
}

void addOther(Models& m) {
  for (const double strength : {1.0, 0.5}) {
    GltfBuilder& b = m.add(strength < 1 ? "occlusion-half" : "occlusion", panel(), matt({0.8, 0.8, 0.8, 1}));
    m.material()["occlusionTexture"] = {{"index", addTexture(b, shade())}, {"strength", strength}};
  }
  m.add("emission", ball(), matt({0.1, 0.1, 0.1, 1}));
  m.material()["emissiveFactor"] = {0.3, 0.1, 0.05};
  GltfBuilder* b = &m.add("emission-map", panel(), matt({0.1, 0.1, 0.1, 1}));
  m.material()["emissiveFactor"] = {0.5, 0.5, 0.5};
  m.material()["emissiveTexture"] = {{"index", addTexture(*b, tiles())}};
  b = &m.add("emission-strength", ball(), matt({0.1, 0.1, 0.1, 1}));
  m.material()["emissiveFactor"] = {0.1, 0.05, 0.02};
  m.material()["extensions"]["KHR_materials_emissive_strength"] = {{"emissiveStrength", 4}};
  b->json["extensionsUsed"].push_back("KHR_materials_emissive_strength");
  const json unlit = {{"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 0.3, 0.1, 1}}}},
                      {"extensions", {{"KHR_materials_unlit", json::object()}}}};
  m.add("unlit", ball(), unlit);
  b = &m.add("unlit-map", panel(), unlit);
  m.finishOf()["baseColorTexture"] = {{"index", addTexture(*b, tiles())}};
  b = &m.add("unlit-vertices", panel(), unlit);
  b->attribute("COLOR_0", std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1}, GltfBuilder::kFloat, "VEC3",
               4);
}

void addForms(Models& m) {
  const json grey = matt(kGrey);
  const json turned = json::parse(R"({"mesh": 0, "rotation": [0.1830127, 0.3535534, 0.0669873, 0.9148705]})");
  const auto addBox = [&](const char* name, bool normals = true) -> GltfBuilder& {
    GltfBuilder& b = m.add(name, box(normals), grey);
    b.json["nodes"][0] = turned;
    return b;
  };
  addBox("form-box");
  addBox("form-without-normals", false);
  const Box shape;
  GltfBuilder* b = &addBox("form-long-indices");
  b->primitive()["indices"] =
      b->accessor(std::vector<std::uint32_t>(shape.indices.begin(), shape.indices.end()),
                  GltfBuilder::kUnsignedInt, "SCALAR", 36);
  b = &addBox("form-byte-indices");
  b->primitive()["indices"] =
      b->accessor(std::vector<std::uint8_t>(shape.indices.begin(), shape.indices.end()),
                  GltfBuilder::kUnsignedByte, "SCALAR", 36);
  b = &addBox("form-without-indices");
  std::vector<float> positions, normals;
  for (const std::uint16_t i : shape.indices)
    for (std::size_t k = 0; k < 3; ++k)
      positions.push_back(shape.positions[3U * i + k]), normals.push_back(shape.normals[3U * i + k]);
  b->primitive().erase("indices");
  b->attribute("POSITION", positions, GltfBuilder::kFloat, "VEC3", 36);
  b->attribute("NORMAL", normals, GltfBuilder::kFloat, "VEC3", 36);
  b = &m.add("form-strip", panel(), grey);
  b->primitive()["mode"] = 5;
  b->primitive()["indices"] =
      b->accessor(std::vector<std::uint16_t>{0, 1, 3, 2}, GltfBuilder::kUnsignedShort, "SCALAR", 4);
  b = &m.add("form-fan", panel(), grey);
  b->primitive()["mode"] = 6;
  b->primitive()["indices"] =
      b->accessor(std::vector<std::uint16_t>{0, 1, 2, 3}, GltfBuilder::kUnsignedShort, "SCALAR", 4);
  b = &m.add("form-quantized", panel(), grey);
  const auto at = b->attribute("POSITION",
                               std::vector<std::int16_t>{-32767, -32767, 0, 0, 32767, -32767, 0, 0, 32767,
                                                         32767, 0, 0, -32767, 32767, 0, 0},
                               GltfBuilder::kShort, "VEC3", 4);
  b->json["accessors"][at]["normalized"] = true;
  b->json["bufferViews"][b->json["accessors"][at]["bufferView"].get<std::size_t>()]["byteStride"] = 8;
  for (const char* list : {"extensionsUsed", "extensionsRequired"})
    b->json[list].push_back("KHR_mesh_quantization");
}

void addTrees(Models& m) {
  const json grey = matt(kGrey);
  GltfBuilder* b = &m.add("tree-nested", box(), grey);
  b->json["nodes"] = json::parse(
      R"([{"children": [1], "translation": [0.3, 0.2, 0], "rotation": [0, 0, 0.258819, 0.9659258]},
      {"mesh": 0, "rotation": [0, 0.3826834, 0, 0.9238795], "scale": [1.2, 0.6, 0.8]}])");
  b = &m.add("tree-instances", box(), grey);
  b->json["nodes"] = json::parse(R"([{"mesh": 0, "translation": [-0.7, 0, 0], "scale": [0.7, 0.7, 0.7]},
      {"mesh": 0, "translation": [0.7, 0.2, -0.5], "rotation": [0, 0.3826834, 0, 0.9238795], "scale": [0.7, 0.7, 0.7]}])");
  b->json["scenes"][0]["nodes"] = {0, 1};
  b = &m.add("tree-mirrored", box(), grey);
  b->json["nodes"][0] =
      json::parse(R"({"mesh": 0, "scale": [-1, 1.3, 1], "rotation": [0, 0.3826834, 0, 0.9238795]})");
  b = &m.add("tree-matrix", box(), grey);
  b->json["nodes"][0] = json::parse(
      R"({"mesh": 0, "matrix": [1.0392305, 0.6, 0, 0, -0.35, 0.6062178, 0, 0, 0, 0, 0.9, 0, 0.1, 0, 0, 1]})");
  b = &m.add("tree-two-materials", box(), grey);
  json second = b->primitive();
  const Box shape;
  std::vector<std::uint16_t> half(shape.indices.begin(), shape.indices.begin() + 18),
      rest(shape.indices.begin() + 18, shape.indices.end());
  b->primitive()["indices"] = b->accessor(half, GltfBuilder::kUnsignedShort, "SCALAR", 18);
  second["indices"] = b->accessor(rest, GltfBuilder::kUnsignedShort, "SCALAR", 18);
  second["material"] = 1;
  b->json["meshes"][0]["primitives"].push_back(second);
  b->json["materials"].push_back(matt({0.2, 0.5, 0.3, 1}));
  b->json["nodes"][0]["rotation"] = {0.1830127, 0.3535534, 0.0669873, 0.9148705};
}

void addMotion(Models& m) {
  const auto addClip = [&](const std::string& name, GltfBuilder model, const char* path, const char* how,
                           const std::vector<float>& times, const std::vector<float>& values,
                           const char* type, double time) {
    GltfBuilder& b = m.add(name, std::move(model), matt(kGrey));
    const std::size_t rows = values.size() / (std::string(type) == "VEC4"   ? 4
                                              : std::string(type) == "VEC3" ? 3
                                                                            : 1);
    b.json["animations"] = {{{"name", "move"},
                             {"samplers",
                              {{{"input", b.accessor(times, GltfBuilder::kFloat, "SCALAR", times.size())},
                                {"output", b.accessor(values, GltfBuilder::kFloat, type, rows)},
                                {"interpolation", how}}}},
                             {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", path}}}}}}}};
    m.last().clip = "move", m.last().time = time;
  };
  const std::vector<float> seconds{0, 1};
  const float half = 0.70710678f;
  addClip("clip-translation", box(), "translation", "LINEAR", seconds, {-0.5f, 0, 0, 0.7f, 0.4f, 0}, "VEC3",
          0.75);
  addClip("clip-rotation", box(), "rotation", "LINEAR", seconds, {0, 0, 0, 1, 0, half, 0, half}, "VEC4", 0.4);
  addClip("clip-scale", box(), "scale", "LINEAR", seconds, {1, 1, 1, 1.5f, 0.5f, 1}, "VEC3", 0.5);
  addClip("clip-step", box(), "translation", "STEP", seconds, {-0.5f, 0, 0, 0.7f, 0.4f, 0}, "VEC3", 0.75);
  addClip("clip-cubic", box(), "translation", "CUBICSPLINE", seconds,
          {0, 0, 0, -0.5f, 0, 0, 0, 2, 0, 0, -1, 0, 0.7f, 0.4f, 0, 0, 0, 0}, "VEC3", 0.5);
  addClip("clip-cubic-rotation", box(), "rotation", "CUBICSPLINE", seconds,
          {0, 0, 0, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 1, 0, 0, 0, half, 0, half, 0, 0, 0, 0}, "VEC4", 0.3);
  const auto withTarget = [] {
    GltfBuilder b = box();
    std::vector<float> differences;
    const Box shape;
    for (std::size_t i = 0; i < 24; ++i) {
      const bool top = shape.positions[3 * i + 1] > 0;
      differences.insert(differences.end(), {top ? 0.6f : 0, top ? 0.3f : 0, 0});
    }
    b.primitive()["targets"] = {{{"POSITION", b.accessor(differences, GltfBuilder::kFloat, "VEC3", 24)}}};
    return b;
  };
  addClip("clip-morph", withTarget(), "weights", "LINEAR", seconds, {0, 1}, "SCALAR", 0.6);
  m.add("morph-at-rest", withTarget(), matt(kGrey)).json["meshes"][0]["weights"] = {0.7};
  for (const auto& [clip, time] : {std::pair{"bend", 0.6}, std::pair{"lift", 0.3}}) {
    GltfBuilder& b = m.add(std::string("skin-") + clip, riggedTube(), matt(kGrey));
    b.json["nodes"].push_back(json::parse(
        R"({"children": [0, 1], "translation": [0, -1, 0], "rotation": [0, 0.258819, 0, 0.9659258]})"));
    b.json["scenes"][0]["nodes"] = json::array({3});
    m.last().clip = clip, m.last().time = time;
  }
}

}  // namespace

std::vector<FeatureModel> featureModels() {
  Models m;
  m.all.reserve(100);
  addColours(m);
  addSamplers(m);
  addCoordinates(m);
  addAlpha(m);
  addFinish(m);
  addNormals(m);
  addOther(m);
  addForms(m);
  addTrees(m);
  addMotion(m);
  return std::move(m.all);
}

std::vector<FeatureModel> surroundedBalls() {
  Models m;
  m.all.reserve(100);
  for (const int roughness : {30, 50, 70, 100})
    for (const int metallic : {0, 50, 100}) {
      m.add("ball-" + std::to_string(roughness) + "-" + std::to_string(metallic), ball(),
            {{"pbrMetallicRoughness",
              {{"baseColorFactor", {0.7, 0.5, 0.3, 1}},
               {"roughnessFactor", roughness / 100.0},
               {"metallicFactor", metallic / 100.0}}}});
      // The worst differences are at the rim of smooth balls. There, theirs are up to 11 levels from the integral of
      // the light, ours up to 5. Elsewhere both are up to 10 levels off it, mostly to the same side.
      m.last().mean = 0.8, m.last().worst = roughness < 50 ? 12 : 8;
    }
  return std::move(m.all);
}

}  // namespace stadion::test
