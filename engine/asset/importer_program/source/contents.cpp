#include "engine/asset/importer_program/source/contents.h"

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
    leaveOut(scene_.cameras, "camera");
    leaveOut(scene_.lights, "light");
    if (!scene_.otherScenes.empty()) add(ContentUse::LeftOut, listed(scene_.otherScenes, "further scene"));
    for (const ContentItem& note : scene_.notes) to_.add(note.use, note.text);
  }

private:
  void add(ContentUse use, std::string text) { to_.add(use, std::move(text)); }

  template <class Things>
  void leaveOut(const Things& things, const char* what) {
    if (!things.empty()) add(ContentUse::LeftOut, listed(namesOf(things), what));
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

  std::uint32_t uvSetOf(const SourcePrimitive& part) const {
    const std::uint32_t set =
        part.material < scene_.materials.size() ? uvSourceOf(scene_.materials[part.material]).set : 0;
    return set < 2 && !part.uvs[set].empty() ? set : 0;
  }

  void takeVertexData() {
    addMeshes(ContentUse::Used, "texture coordinates",
              [&](const SourcePrimitive& p) { return !p.uvs[uvSetOf(p)].empty(); });
    addMeshes(ContentUse::Used, "vertex colours",
              [](const SourcePrimitive& p) { return !p.colours.empty(); });
    addMeshes(ContentUse::LeftOut, "further texture coordinates",
              [&](const SourcePrimitive& p) { return !p.uvs[1 - uvSetOf(p)].empty(); });
    // They matter to a normal map alone.
    addMeshes(ContentUse::LeftOut, "tangents", [&](const SourcePrimitive& p) {
      return !p.tangents.empty() && p.material < scene_.materials.size() &&
             scene_.materials[p.material].normalMap.given();
    });
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
    addMaterials(ContentUse::Used, "emissive map", [](M m) { return m.emissiveMap.given() && sharesUvs(m); });
    addMaterials(ContentUse::Used, "opacity map", [](M m) { return m.opacityMap.given(); });
    addMaterials(
        ContentUse::Approximated, "specular-glossiness model", [](M m) { return m.specularGlossiness; },
        ": its diffuse part is drawn");
    addMaterials(ContentUse::LeftOut, "metallic-roughness map",
                 [](M m) { return m.metallicRoughnessMap.given(); });
    addMaterials(ContentUse::LeftOut, "normal map", [](M m) { return m.normalMap.given(); });
    addMaterials(ContentUse::LeftOut, "occlusion map", [](M m) { return m.occlusionMap.given(); });
    addMaterials(
        ContentUse::LeftOut, "unlit", [](M m) { return m.unlit; }, ": it is lit");
    std::map<std::string, std::vector<std::string>> others;
    for (const SourceMaterial& m : scene_.materials)
      for (const NamedTexture& map : m.otherMaps) others[map.name].push_back(m.name);
    for (const auto& [map, materials] : others)
      add(ContentUse::LeftOut, map + " of " + listed(materials, "material"));
  }

  static bool sharesUvs(const SourceMaterial& m) {
    return UvSource{m.emissiveMap.uvSet, m.emissiveMap.transform} == uvSourceOf(m);
  }

  /// Returns true if a map that is drawn has the property.
  static bool drawn(const SourceMaterial& m, const std::function<bool(const SourceTexture&)>& has) {
    return (m.baseMap.given() && has(m.baseMap)) || (m.emissiveMap.given() && has(m.emissiveMap));
  }

  void takeTextureUses() {
    using M = const SourceMaterial&;
    using T = const SourceTexture&;
    const auto transformed = [](T t) { return t.transform != UvTransform{}; };
    addMaterials(ContentUse::Used, "texture transform", [&](M m) { return drawn(m, transformed); });
    addMaterials(ContentUse::LeftOut, "emissive map with other texture coordinates than the base colour",
                 [](M m) { return m.emissiveMap.given() && !sharesUvs(m); });
    addMaterials(
        ContentUse::LeftOut, "third or later texture coordinates",
        [&](M m) { return drawn(m, [](T t) { return t.uvSet > 1; }); }, ": the first are used");
    const auto wraps = [](WrapMode mode) {
      return [=](M m) { return drawn(m, [=](T t) { return t.wrapU == mode || t.wrapV == mode; }); };
    };
    addMaterials(ContentUse::Approximated, "wrap mode \"clamp\"", wraps(WrapMode::Clamp), ": it repeats");
    addMaterials(ContentUse::Approximated, "wrap mode \"mirror\"", wraps(WrapMode::Mirror), ": it repeats");
    addMaterials(
        ContentUse::Approximated, "filter \"nearest\"",
        [&](M m) { return drawn(m, [](T t) { return t.nearest; }); }, ": it is linear");
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
    if (!targets.empty()) add(ContentUse::LeftOut, listed(targets, "morph target"));
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
