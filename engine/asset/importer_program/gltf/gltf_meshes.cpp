#include "engine/asset/importer_program/gltf/draco_mesh.h"
#include "engine/asset/importer_program/gltf/gltf_parts.h"
#include "engine/asset/importer_program/source/name_list.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace stadion::importer {
namespace {

constexpr std::uint64_t kPoints = 0, kLines = 1, kLineLoop = 2, kTriangles = 4, kStrip = 5, kFan = 6;

/// The corners of triangles in a list, a strip or a fan.
std::vector<std::array<std::uint32_t, 3>> trianglesOf(const std::vector<std::uint32_t>& corners,
                                                      std::uint64_t mode) {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  if (mode == kTriangles) {
    triangles.reserve(corners.size() / 3);
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
      triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
  }
  for (std::size_t i = 0; (mode == kStrip || mode == kFan) && i + 2 < corners.size(); ++i) {
    const std::size_t odd = mode == kStrip ? i % 2 : 0, first = mode == kStrip ? i + odd : 0;
    triangles.push_back({corners[first], corners[i + 1 - odd], corners[i + 2]});
  }
  return triangles;
}

/// Reads one primitive.
class GltfPrimitive {
public:
  GltfPrimitive(GltfDocument& document, const GltfValue& from, std::size_t materials)
      : document_(document), from_(from), limits_(document.request().head.mesh),
        attributes_(from.object("attributes")) {
    const auto material = from.index("material", materials - 1);
    to_.material = material.value_or(static_cast<std::uint32_t>(materials - 1));  // the last is the default
  }

  /// How many triangles `read` has left out.
  std::size_t missing() const { return missing_; }

  SourcePrimitive read() {
    if (from_.hasExtension("KHR_draco_mesh_compression")) unpackDraco();
    const auto position = attributes_.index("POSITION", document_.accessors().size());
    if (!position) return std::move(to_);  // nothing to draw
    points_ = isPacked("POSITION") ? draco_.points() : document_.countOf(*position);
    if (points_ > limits_.vertices)
      from_.refuse("it has more than " + std::to_string(limits_.vertices) + " vertices");
    readAttributes();
    readTopology();
    readTargets();
    return std::move(to_);
  }

private:
  void unpackDraco() {
    const GltfValue packed = from_.extension("KHR_draco_mesh_compression");
    const auto view = packed.index("bufferView", document_.viewCount());
    if (!view) from_.refuse("its compression names no buffer view");
    std::string why;
    if (!draco_.unpack(document_.view(*view).bytes, limits_.vertices, limits_.triangles, why))
      from_.refuse(why);
    const GltfValue attributes = packed.object("attributes");
    for (const std::string& name : attributes.keys())
      packed_[name] =
          static_cast<std::uint32_t>(std::min<std::uint64_t>(attributes.count(name.c_str(), 0), 1u << 31));
    isDraco_ = true;
  }

  bool isPacked(const char* name) const { return packed_.contains(name); }

  /// The numbers of an attribute; none if the primitive lacks it.
  GltfNumbers numbers(const GltfValue& attributes, const char* name) {
    const auto accessor = attributes.index(name, document_.accessors().size());
    if (!accessor) return {};
    GltfNumbers numbers = isPacked(name) && &attributes == &attributes_ ? unpacked(*accessor, name)
                                                                        : document_.numbers(*accessor);
    if (numbers.count() != points_)
      from_.refuse(std::string("\"") + name + "\" has " + std::to_string(numbers.count()) +
                   " elements, but there are " + std::to_string(points_) + " vertices");
    return numbers;
  }

  GltfNumbers unpacked(std::uint32_t accessor, const char* name) {
    const GltfValue& described = document_.accessors()[accessor];
    GltfNumbers numbers;
    numbers.components = document_.componentsIn(accessor);
    numbers.values = draco_.values(packed_[name], numbers.components, described.flag("normalized", false));
    return numbers;
  }

  template <std::size_t N>
  std::vector<std::array<float, N>> elements(const GltfValue& attributes, const char* name, float fill = 0) {
    const GltfNumbers from = numbers(attributes, name);
    std::vector<std::array<float, N>> to(from.count());
    for (std::size_t i = 0; i < to.size(); ++i) {
      to[i] = from.element<N>(i);
      for (std::size_t k = from.components; k < N; ++k) to[i][k] = fill;
    }
    return to;
  }

  void readAttributes() {
    to_.positions = elements<3>(attributes_, "POSITION");
    to_.normals = elements<3>(attributes_, "NORMAL");
    to_.tangents = elements<4>(attributes_, "TANGENT", 1);
    for (std::size_t set = 0; set < 2; ++set) {
      to_.uvs[set] = elements<2>(attributes_, set == 0 ? "TEXCOORD_0" : "TEXCOORD_1");
      for (Float2& uv : to_.uvs[set]) uv[1] = 1 - uv[1];
    }
    to_.colours = elements<4>(attributes_, "COLOR_0", 1);
    to_.weights = elements<4>(attributes_, "WEIGHTS_0");
    for (const Float4& j : elements<4>(attributes_, "JOINTS_0"))
      to_.joints.push_back({joint(j[0]), joint(j[1]), joint(j[2]), joint(j[3])});
    static const std::set<std::string> kRead{"POSITION",   "NORMAL",  "TANGENT",  "TEXCOORD_0",
                                             "TEXCOORD_1", "COLOR_0", "JOINTS_0", "WEIGHTS_0"};
    for (const std::string& name : attributes_.keys())
      if (!kRead.contains(name)) to_.furtherAttributes.push_back(name);
  }

  std::uint16_t joint(float number) const {
    if (!(number >= 0 && number <= 65535)) from_.refuse("\"JOINTS_0\" holds what is no joint");
    return static_cast<std::uint16_t>(number);
  }

  void readTopology() {
    const std::uint64_t mode = from_.count("mode", kTriangles);
    if (isDraco_) {
      to_.triangles = draco_.triangles();
      return checkCorners();
    }
    const std::vector<std::uint32_t> corners = cornersOf();
    if (mode == kPoints) to_.points = corners.size();
    if (mode == kLines) to_.lines = corners.size() / 2;
    if (mode > kLines && mode < kTriangles && corners.size() > 1)
      to_.lines = corners.size() - (mode != kLineLoop);
    if (mode > kFan) from_.refuse("its mode is unknown");
    to_.triangles = trianglesOf(corners, mode);
    checkCorners();
  }

  std::vector<std::uint32_t> cornersOf() {
    if (const auto indices = from_.index("indices", document_.accessors().size()))
      return document_.indices(*indices);
    std::vector<std::uint32_t> corners(points_);
    for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = static_cast<std::uint32_t>(i);
    return corners;
  }

  /// Leaves out triangles with a vertex that does not exist.
  void checkCorners() {
    if (to_.triangles.size() > limits_.triangles)
      from_.refuse("it has more than " + std::to_string(limits_.triangles) + " triangles");
    missing_ = std::erase_if(to_.triangles, [&](const auto& triangle) {
      return std::ranges::any_of(triangle, [&](std::uint32_t corner) { return corner >= points_; });
    });
  }

  void readTargets() {
    for (const GltfValue& target : from_.objects("targets", "morph target"))
      to_.targets.push_back(
          {elements<3>(target, "POSITION"), elements<3>(target, "NORMAL"), elements<3>(target, "TANGENT")});
  }

  GltfDocument& document_;
  const GltfValue& from_;
  MeshLimits limits_;
  GltfValue attributes_;
  SourcePrimitive to_;
  std::uint64_t points_ = 0;
  std::size_t missing_ = 0;
  bool isDraco_ = false;
  DracoMesh draco_;
  std::map<std::string, std::uint32_t> packed_;  ///< Draco's numbers of attributes, by name
};

}  // namespace

std::vector<float> weightsOf(const GltfValue& from) {
  std::vector<float> weights;
  for (const double w : from.numbers("weights"))
    weights.push_back(std::isfinite(w) ? static_cast<float>(std::clamp(w, -1e6, 1e6)) : 0);
  return weights;
}

void readGltfMeshes(GltfDocument& document, SourceScene& to) {
  for (const GltfValue& from : document.root().objects("meshes", "mesh")) {
    SourceMesh mesh;
    mesh.name = nameOf(from);
    mesh.targetNames = from.object("extras").texts("targetNames");
    mesh.targetWeights = weightsOf(from);
    for (const GltfValue& part : from.objects("primitives", "primitive")) {
      GltfPrimitive primitive(document, part, to.materials.size());
      mesh.primitives.push_back(primitive.read());
      if (primitive.missing() > 0)
        to.notes.push_back({ContentUse::LeftOut, counted(primitive.missing(), "triangle") + " of " +
                                                     part.place() + " with a vertex that does not exist"});
    }
    to.meshes.push_back(std::move(mesh));
  }
}

}  // namespace stadion::importer
