#pragma once
// A small writer of glTF files for tests.

#include <nlohmann/json.hpp>

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace stadion::test {

/// One binary buffer, and the JSON around it. A new builder has a scene with one node, which has mesh 0.
struct GltfBuilder {
  nlohmann::json json = nlohmann::json::parse(
      R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
          "buffers": [{}], "bufferViews": [], "accessors": [], "meshes": [{"primitives": [{"attributes": {}}]}]})");
  std::string bytes;

  static constexpr int kByte = 5120, kUnsignedByte = 5121, kShort = 5122, kUnsignedShort = 5123,
                       kUnsignedInt = 5125, kFloat = 5126;

  /// Appends bytes and returns the number of their view.
  std::size_t view(const void* data, std::size_t size, std::size_t stride = 0) {
    bytes.resize((bytes.size() + 3) / 4 * 4);
    nlohmann::json view{{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", size}};
    if (stride > 0) view["byteStride"] = stride;
    bytes.append(static_cast<const char*>(data), size);
    json["bufferViews"].push_back(view);
    return json["bufferViews"].size() - 1;
  }

  /// Adds an accessor without data.
  std::size_t emptyAccessor(int componentType, const char* type, std::size_t count) {
    json["accessors"].push_back({{"componentType", componentType}, {"type", type}, {"count", count}});
    return json["accessors"].size() - 1;
  }

  template <class T>
  std::size_t accessor(const std::vector<T>& data, int componentType, const char* type, std::size_t count) {
    const std::size_t from = view(data.data(), data.size() * sizeof(T));
    const std::size_t index = emptyAccessor(componentType, type, count);
    json["accessors"][index]["bufferView"] = from;
    return index;
  }

  nlohmann::json& primitive() { return json["meshes"][0]["primitives"][0]; }

  /// Adds an attribute of the first primitive.
  template <class T>
  std::size_t attribute(const char* name, const std::vector<T>& data, int componentType, const char* type,
                        std::size_t count) {
    const std::size_t index = accessor(data, componentType, type, count);
    primitive()["attributes"][name] = index;
    return index;
  }

  /// Corners of a square in the plane z = 0, one unit wide.
  void square() {
    attribute("POSITION", std::vector<float>{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, kFloat, "VEC3", 4);
    primitive()["indices"] =
        accessor(std::vector<std::uint16_t>{0, 1, 2, 0, 2, 3}, kUnsignedShort, "SCALAR", 6);
  }

  std::string glb() const {
    nlohmann::json whole = json;
    std::string binary = bytes;
    binary.resize((binary.size() + 3) / 4 * 4);
    whole["buffers"][0] = {{"byteLength", bytes.size()}};
    std::string text = whole.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const auto total = static_cast<std::uint32_t>(28 + text.size() + binary.size());
    return "glTF" + word(2) + word(total) + word(static_cast<std::uint32_t>(text.size())) + "JSON" + text +
           word(static_cast<std::uint32_t>(binary.size())) + std::string("BIN\0", 4) + binary;
  }

  /// The JSON with the buffer in a file of this URI.
  std::string gltf(const std::string& uri) const {
    nlohmann::json whole = json;
    whole["buffers"][0] = {{"byteLength", bytes.size()}, {"uri", uri}};
    return whole.dump();
  }

private:
  static std::string word(std::uint32_t value) {
    std::string text(4, '\0');
    std::memcpy(text.data(), &value, 4);
    return text;
  }
};

}  // namespace stadion::test
