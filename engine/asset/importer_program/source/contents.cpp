#include "engine/asset/importer_program/source/contents.h"

#include "engine/asset/importer_program/source/light_kind.h"
#include "engine/asset/importer_program/source/name_list.h"

#include <algorithm>
#include <functional>
#include <map>
#include <set>

namespace stadion::importer {
namespace {

template <class Things>
std::vector<std::string> namesOf(const Things& things) {
  std::vector<std::string> names;
  for (const auto& thing : things) names.push_back(thing.name);
  return names;
}

class Contents {
public:
  Contents(const SourceScene& scene, bool figure, ModelInventory& inventory)
      : scene_(scene), figure_(figure), to_(inventory) {}

  void take() {
    takeGeometry();
    takeVertexData();
    takeMaterials();
    takeTextureUses();
    takeNodes();
    takeMotion();
    takeCamerasAndLights();
    if (!scene_.otherScenes.empty())
      add(ContentUse::LeftOut,
          listed(scene_.otherScenes, "further scene") + ": part=NODE of an object shows a node of one");
    for (const ContentItem& note : scene_.notes) to_.add(note.use, note.text);
  }

private:
  void add(ContentUse use, std::string text) { to_.add(use, std::move(text)); }

  void takeCamerasAndLights() {
    std::vector<std::string> cameras, lights, others;
    std::vector<bool> heldCameras(scene_.cameras.size()), heldLights(scene_.lights.size());
    for (const SourceNode& node : scene_.nodes) {
      if (const auto at = static_cast<std::size_t>(node.camera); node.camera >= 0) {
        heldCameras[at] = true;
        cameras.push_back(nameOf(node, scene_.cameras[at].name));
      }
      if (node.light < 0) continue;
      const auto at = static_cast<std::size_t>(node.light);
      heldLights[at] = true;
      (lightKind(scene_.lights[at].kind) ? lights : others).push_back(nameOf(node, scene_.lights[at].name));
    }
    leaveOutUnheld(scene_.cameras, heldCameras, "camera");
    leaveOutUnheld(scene_.lights, heldLights, "light");
    if (!cameras.empty())
      add(ContentUse::Used, listed(cameras, "camera") + ": rig( model=, camera=NAME ) starts at one");
    if (!lights.empty())
      add(ContentUse::Used,
          listed(lights, "light") + ": light( parent=, source=NAME ) lights the show with one");
    if (!others.empty()) add(ContentUse::LeftOut, listed(others, "light") + ": shows have none of this kind");
  }
  template <class Things>
  void leaveOutUnheld(const Things& things, const std::vector<bool>& held, const char* what) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < things.size(); ++i)
      if (!held[i]) names.push_back(things[i].name);
    if (!names.empty())
      add(ContentUse::LeftOut,
          listed(names, what) + (names.size() > 1 ? ": no node holds them" : ": no node holds it"));
  }
  static std::string nameOf(const SourceNode& node, const std::string& otherwise) {
    return node.name.empty() ? otherwise : node.name;
  }

  void takeGeometry() {
    std::uint64_t triangles = 0, points = 0, lines = 0;
    for (const SourceMesh& mesh : scene_.meshes)
      for (const SourcePrimitive& part : mesh.primitives) {
        triangles += part.triangles.size();
        points += part.points;
        lines += part.lines;
      }
    add(ContentUse::Used,
        counted(triangles, "triangle") + " of " + listed(namesOf(scene_.meshes), "mesh", "meshes"));
    if (lines > 0) add(ContentUse::LeftOut, counted(lines, "line"));
    if (points > 0) add(ContentUse::LeftOut, counted(points, "point"));
  }

  /// Adds a line with the meshes that have something.
  void addMeshes(ContentUse use, const std::string& what,
                 const std::function<bool(const SourcePrimitive&)>& has) {
    std::vector<std::string> names;
    for (const SourceMesh& mesh : scene_.meshes)
      if (std::ranges::any_of(mesh.primitives, has)) names.push_back(mesh.name);
    if (!names.empty()) add(use, what + " of " + listed(names, "mesh", "meshes"));
  }

  const SourceMaterial* materialOf(const SourcePrimitive& part) const {
    return part.material < scene_.materials.size() ? &scene_.materials[part.material] : nullptr;
  }
  /// Returns true if a map reads the set.
  bool reads(const SourcePrimitive& part, std::uint32_t set) const {
    const SourceMaterial* material = materialOf(part);
    return material && drawn(*material, [&](const SourceTexture& t) { return uvSourceOf(t).set == set; });
  }
  /// Returns true if a set is there that no map reads. Without maps, the first one does not count.
  bool hasUnread(const SourcePrimitive& part) const {
    return (!part.uvs[1].empty() && !reads(part, 1)) ||
           (!part.uvs[0].empty() && reads(part, 1) && !reads(part, 0));
  }
  /// Returns true if a map reads a set that is not there.
  bool lacksUvs(const SourcePrimitive& part) const {
    return (part.uvs[0].empty() && reads(part, 0)) || (part.uvs[1].empty() && reads(part, 1));
  }
  bool hasNormalMap(const SourcePrimitive& part) const {
    const SourceMaterial* material = materialOf(part);
    return material && drawnMaps(*material)[kNormalMap];
  }

  void takeVertexData() {
    addMeshes(ContentUse::Used, "texture coordinates",
              [&](const SourcePrimitive& p) { return !p.uvs[0].empty() || !p.uvs[1].empty(); });
    addMeshes(ContentUse::Used, "vertex colours",
              [](const SourcePrimitive& p) { return !p.colours.empty(); });
    addMeshes(ContentUse::LeftOut, "further texture coordinates",
              [&](const SourcePrimitive& p) { return hasUnread(p); });
    addMeshes(ContentUse::LeftOut, "maps that lack texture coordinates",
              [&](const SourcePrimitive& p) { return lacksUvs(p); });
    // They matter to a normal map alone.
    addMeshes(ContentUse::Used, "tangents",
              [&](const SourcePrimitive& p) { return !p.tangents.empty() && hasNormalMap(p); });
    std::set<std::string> further;
    for (const SourceMesh& mesh : scene_.meshes)
      for (const SourcePrimitive& part : mesh.primitives)
        further.insert(part.furtherAttributes.begin(), part.furtherAttributes.end());
    if (!further.empty())
      add(ContentUse::LeftOut, listed({further.begin(), further.end()}, "further vertex attribute"));
  }

  std::vector<std::string> materialsWith(const std::function<bool(const SourceMaterial&)>& has) const {
    std::vector<std::string> names;
    for (const SourceMaterial& m : scene_.materials)
      if (has(m)) names.push_back(m.name);
    return names;
  }

  /// Adds a line with the materials that have something.
  void addMaterials(ContentUse use, const std::string& what,
                    const std::function<bool(const SourceMaterial&)>& has, const std::string& effect = {}) {
    const std::vector<std::string> names = materialsWith(has);
    if (!names.empty()) add(use, what + " of " + listed(names, "material") + effect);
  }

  void takeMaterials() {
    using M = const SourceMaterial&;
    addMaterials(ContentUse::Used, "base colour map", [](M m) { return m.baseMap.given(); });
    const auto draws = [](MapKind kind) { return [=](M m) { return drawnMaps(m)[kind] != nullptr; }; };
    addMaterials(ContentUse::Used, "emissive map", draws(kEmissiveMap));
    addMaterials(ContentUse::Used, "opacity map", [](M m) { return m.opacityMap.given(); });
    addMaterials(
        ContentUse::Approximated, "specular-glossiness model", [](M m) { return m.specularGlossiness; },
        ": its diffuse part is drawn");
    addMaterials(
        ContentUse::Approximated, "clearcoat", [](M m) { return m.clearcoat > 0; },
        ": the surface itself is as smooth as its coat, where it is no metal");
    addMaterials(
        ContentUse::Approximated, "transmission", [](M m) { return m.transmission > 0; },
        ": what lies behind is blended in, without refraction and tint");
    addMaterials(ContentUse::Used, "metallic-roughness map",
                 [](M m) { return !m.unlit && m.metallicRoughnessMap.given(); });
    addMaterials(ContentUse::Used, "roughness map", [](M m) { return !m.unlit && m.roughnessMap.given(); });
    addMaterials(ContentUse::Used, "metallic map", [](M m) { return !m.unlit && m.metallicMap.given(); });
    addMaterials(ContentUse::Used, "normal map", draws(kNormalMap));
    addMaterials(ContentUse::Used, "occlusion map", draws(kOcclusionMap));
    addMaterials(ContentUse::Used, "unlit surface", [](M m) { return m.unlit; });
    std::map<std::string, std::vector<std::string>> others;
    for (const SourceMaterial& m : scene_.materials)
      for (const NamedTexture& map : m.otherMaps) others[map.name].push_back(m.name);
    for (const auto& [map, materials] : others)
      add(ContentUse::LeftOut, map + " of " + listed(materials, "material"));
  }

  /// Returns true if a map that is drawn has the property.
  static bool drawn(const SourceMaterial& m, const std::function<bool(const SourceTexture&)>& has) {
    return std::ranges::any_of(drawnMaps(m), [&](const SourceTexture* map) { return map && has(*map); });
  }

  void takeTextureUses() {
    using M = const SourceMaterial&;
    using T = const SourceTexture&;
    const auto transformed = [](T t) { return t.transform != UvTransform{}; };
    addMaterials(ContentUse::Used, "texture transform", [&](M m) { return drawn(m, transformed); });
    addMaterials(
        ContentUse::LeftOut, "third or later texture coordinates",
        [&](M m) { return drawn(m, [](T t) { return t.uvSet > 1; }); }, ": the first are used");
    const auto wraps = [](WrapMode mode) {
      return [=](M m) {
        return drawn(m, [=](T t) { return t.sampler.wrapU == mode || t.sampler.wrapV == mode; });
      };
    };
    addMaterials(ContentUse::Used, "wrap mode \"clamp\"", wraps(WrapMode::Clamp));
    addMaterials(ContentUse::Used, "wrap mode \"mirror\"", wraps(WrapMode::Mirror));
    addMaterials(ContentUse::Used, "filter \"nearest\"", [&](M m) {
      return drawn(m, [](T t) { return t.sampler.magnifiesNearest || t.sampler.minifiesNearest; });
    });
  }

  void takeNodes() {
    std::vector<std::string> names;
    for (const SourceNode& node : scene_.nodes)
      if (!node.meshes.empty()) names.push_back(node.name);
    if (names.size() > 1)
      add(ContentUse::Used, listed(names, "node with a mesh", "nodes with a mesh") + ", as one model");
  }

  void takeMotion() {
    std::size_t bones = 0;
    for (const SourceSkin& skin : scene_.skins) bones += skin.joints.size();
    if (!scene_.skins.empty())
      add(figure_ ? ContentUse::Used : ContentUse::LeftOut,
          listed(namesOf(scene_.skins), "skin") + " of " + counted(bones, "bone") +
              (figure_ ? "" : ": an object stands as its meshes are stored, use figure( )"));
    if (!scene_.clips.empty())
      add(figure_ ? ContentUse::Used : ContentUse::LeftOut,
          listed(namesOf(scene_.clips), "clip") + (figure_ ? "" : ": an object plays none, use figure( )"));
    std::vector<std::string> targets;
    for (const SourceMesh& mesh : scene_.meshes) {
      std::size_t most = mesh.targetNames.size();
      for (const SourcePrimitive& part : mesh.primitives) most = std::max(most, part.targets.size());
      targets.insert(targets.end(), mesh.targetNames.begin(), mesh.targetNames.end());
      targets.resize(targets.size() + most - mesh.targetNames.size());
    }
    if (targets.empty()) return;
    const auto turnsTangents = [](const SourcePrimitive& part) {
      return std::ranges::any_of(part.targets, [](const MorphTarget& t) { return !t.tangents.empty(); });
    };
    add(figure_ ? ContentUse::Used : ContentUse::LeftOut,
        listed(targets, "morph target") +
            (figure_ ? "" : ": an object keeps the shape of their weights at rest, use figure( )"));
    if (figure_ && std::ranges::any_of(scene_.meshes, [&](const SourceMesh& mesh) {
          return std::ranges::any_of(mesh.primitives, turnsTangents);
        }))
      add(ContentUse::LeftOut, "tangents of morph targets: those of the mesh are used");
  }

  const SourceScene& scene_;
  bool figure_;
  ModelInventory& to_;
};

}  // namespace

void takeInventory(const SourceScene& scene, bool figure, ModelInventory& inventory) {
  Contents(scene, figure, inventory).take();
}

}  // namespace stadion::importer
