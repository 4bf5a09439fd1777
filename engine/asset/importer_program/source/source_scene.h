#pragma once
/// What a model file holds: the step between the readers of the formats and the mesh.
///
/// A reader fills a SourceScene and leaves nothing out that a show may want. `flatten`, `readMaterials` and
/// `takeInventory` work on it, whatever the format was.
///
/// Frames   Coordinates are those of the file; `toShow` maps them to metres, +Z up.
/// Units    Colours of materials are linear; those of vertices are linear if `linearColours`, else sRGB.
///          Texture coordinates count v from the bottom, as OBJ does.
/// Errors   Readers check every index before they store it; the other steps rely on that.

#include "engine/asset/inventory.h"
#include "engine/asset/material.h"
#include "engine/figure/skeleton.h"
#include "engine/maths/maths.h"

#include <array>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace stadion::importer {

/// The file is refused; the text completes "FILE ...".
struct Refusal : std::runtime_error {
  using std::runtime_error::runtime_error;
};

using Float2 = std::array<float, 2>;
using Float3 = std::array<float, 3>;
using Float4 = std::array<float, 4>;

/// A picture: a file, encoded bytes or pixels.
struct SourceImage {
  std::string name;                        ///< for messages
  std::string file;                        ///< relative to the model's folder; empty if the model holds it
  std::vector<std::uint8_t> bytes;         ///< encoded, or RGBA pixels if `width` is given
  std::uint32_t width = 0, height = 0;     ///< [pixels] 0: encoded
  std::vector<std::string> otherPlaces{};  ///< further files to try in this order
};

/// Maps texture coordinates with v from the top: uv' = offset + rotation · (scale · uv).
struct UvTransform {
  Float2 offset{0, 0}, scale{1, 1};
  float rotation = 0;  ///< [rad] as in KHR_texture_transform
  bool operator==(const UvTransform&) const = default;
};

/// An image as a material uses it.
struct SourceTexture {
  std::int32_t image = -1;  ///< into SourceScene::images, -1 = none
  std::uint32_t uvSet = 0;
  UvTransform transform;
  Sampler sampler;
  float strength = 1;  ///< scale of a normal map, strength of an occlusion map

  bool given() const { return image >= 0; }
};

/// A map that shows do not draw yet, by the name that authors know.
struct NamedTexture {
  std::string name;  ///< "clearcoat map"
  SourceTexture texture;
};

enum class AlphaMode : std::uint8_t { Opaque, Mask, Blend };

struct SourceMaterial {
  std::string name;
  Float4 baseColour{0.8f, 0.8f, 0.8f, 1};  ///< linear RGB, alpha
  Float3 emissive{0, 0, 0};                ///< linear RGB, with the strength
  float roughness = 0.7f, metallic = 0;
  AlphaMode alphaMode = AlphaMode::Blend;
  float alphaCutoff = 0.5f;
  std::optional<bool> doubleSided;  ///< unset if the format does not say
  bool unlit = false;
  bool specularGlossiness = false;  ///< the base colour is the diffuse part of this older model
  float clearcoat = 0, clearcoatRoughness = 0, transmission = 0;  ///< 0 .. 1
  SourceTexture baseMap, emissiveMap, opacityMap, metallicRoughnessMap, normalMap, occlusionMap;
  SourceTexture roughnessMap, metallicMap;  ///< instead of metallicRoughnessMap: red counts
  std::vector<NamedTexture> otherMaps;
};

/// Differences to a primitive's vertices; each list is empty or as long as the positions.
struct MorphTarget {
  std::vector<Float3> positions, normals, tangents;
};

/// Triangles with one material. Each list of vertex data is empty or as long as the positions.
struct SourcePrimitive {
  std::vector<Float3> positions, normals;
  std::vector<Float4> tangents;                      ///< w: sign of the bitangent
  std::array<std::vector<Float2>, 2> uvs;            ///< (u, v from the bottom)
  std::vector<Float4> colours;                       ///< RGB as in the file, alpha
  std::vector<std::array<std::uint16_t, 4>> joints;  ///< into the skin's joints
  std::vector<Float4> weights;
  std::vector<MorphTarget> targets;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::uint32_t material = 0;
  std::uint64_t points = 0, lines = 0;  ///< what it holds beside triangles
  std::vector<std::string> furtherAttributes;
};

struct SourceMesh {
  std::string name;
  std::int32_t skin = -1;  ///< that of its vertices; -1: that of the node
  std::vector<SourcePrimitive> primitives;
  std::vector<std::string> targetNames;
  std::vector<float> targetWeights;  ///< of the targets at rest; those that are missing are 0
};

struct SourceNode {
  std::string name;
  Affine X_PN = Affine::Identity();  ///< node to parent, or to the file's coordinates for a root
  std::optional<BonePlace> place;    ///< the same in the file's own parts, if it states these
  std::int32_t parent = -1, skin = -1, camera = -1, light = -1;
  std::vector<std::uint32_t> children, meshes;
  std::vector<float> targetWeights;  ///< instead of those of its meshes, if it has any
};

/// The weight of a mesh's morph target below a node where no clip moves it.
inline float weightAtRest(const SourceNode& node, const SourceMesh& mesh, std::size_t target) {
  const std::vector<float>& weights = node.targetWeights.empty() ? mesh.targetWeights : node.targetWeights;
  return target < weights.size() ? weights[target] : 0;
}

struct SourceSkin {
  std::string name;
  std::vector<std::uint32_t> joints;  ///< nodes
  std::vector<Affine> inverseBinds;   ///< mesh to joint; as many as joints
};

/// Keys of one property of a node. A cubic key has three values: tangent in, value, tangent out. A value of
/// weights has a number for each morph target of the node's mesh.
struct SourceChannel {
  std::uint32_t node = 0;
  ChannelTarget target = ChannelTarget::Translation;
  Interpolation interpolation = Interpolation::Linear;
  std::vector<float> times;   ///< [s]
  std::vector<float> values;  ///< rotations as (x, y, z, w)
};

struct SourceClip {
  std::string name;
  std::vector<SourceChannel> channels;
};

/// In the coordinates of its node. glTF's cameras and lights look down the node's -Z.
struct SourceCamera {
  std::string name;
  double verticalAngle = 0;  ///< [rad] 0: orthographic, or unknown
  double near = 0, far = 0;  ///< in the file's unit; 0: unknown
  Float3 position{0, 0, 0}, direction{0, 0, -1};
};

struct SourceLight {
  std::string name;
  std::string kind;  ///< "point", "spot", "directional", ...
  Float3 colour{1, 1, 1};
  float intensity = 1;                    ///< of colour 1: lights a white surface fully, at a distance of 1 m
  float range = 0;                        ///< in the file's unit; 0: without an end
  double innerAngle = 0, outerAngle = 0;  ///< half angles of the cone [rad]
  Float3 position{0, 0, 0}, direction{0, 0, -1};
};

struct SourceScene {
  Affine toShow = Affine::Identity();  ///< from the roots' coordinates to metres, +Z up
  bool linearColours = false;          ///< of the vertices
  bool keepNormals = true;             ///< false: the file's normals say nothing about smoothness
  std::vector<SourceNode> nodes;       ///< a forest: each has one parent at most
  std::vector<std::uint32_t> roots;    ///< of the scene that is shown
  std::vector<SourceMesh> meshes;
  std::vector<SourceMaterial> materials;
  std::vector<SourceImage> images;
  std::vector<SourceSkin> skins;
  std::vector<SourceClip> clips;
  std::vector<SourceCamera> cameras;
  std::vector<SourceLight> lights;
  std::vector<std::string> otherScenes;  ///< names of scenes that are not shown
  std::vector<ContentItem> notes;        ///< what the reader itself used, approximated or left out
};

/// Where a map takes its texture coordinates from.
struct UvSource {
  std::uint32_t set = 0;
  UvTransform transform;
  bool operator==(const UvSource&) const = default;
};

/// There are two sets: other numbers count as the first.
inline UvSource uvSourceOf(const SourceTexture& map) {
  return {map.uvSet == 1 ? 1u : 0u, map.transform};
}

/// The maps that are drawn, by MapKind; null: there is none. An unlit surface has its base colour alone.
std::array<const SourceTexture*, kMapKinds> drawnMaps(const SourceMaterial& m);

/// Where a material's maps take their texture coordinates from; nothing if they differ in that. Coordinates of
/// a mesh are those of its maps if all agree. Else they are the file's, and each map has its own transform.
std::optional<UvSource> commonUvSource(const SourceMaterial& m);

}  // namespace stadion::importer
