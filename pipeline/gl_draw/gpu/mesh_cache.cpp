#include "pipeline/gl_draw/gpu/mesh_cache.h"

#include "engine/maths/srgb.h"
#include "pipeline/gl/finite.h"
#include "pipeline/gl/problem.h"
#include "pipeline/shader/uniform_blocks.h"
#include "pipeline/surface/mask_levels.h"
#include "pipeline/surface/mesh_check.h"
#include "pipeline/surface/painted_material.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>

namespace stadion {
namespace {

struct Vertex {
  std::array<float, 3> position, normal;
  std::array<float, 2> uv;
  std::array<std::uint16_t, 4> colour;
};

/// Of meshes that have more.
struct RichVertex {
  Vertex vertex;
  std::array<float, 2> secondUv;
  std::array<float, 4> tangent;
};

bool isRich(const Mesh& mesh) {
  return !mesh.secondUvs.empty() || !mesh.tangents.empty();
}

constexpr float kAnisotropy = 8;  // on the processor it makes textured scenes 2 to 3 times as slow

/// Returns the values of all bytes, in sixteen bits.
std::array<std::uint16_t, 256> colourTable(Look look) {
  std::array<std::uint16_t, 256> table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    const double c = static_cast<double>(i) / 255;
    table[i] = static_cast<std::uint16_t>(std::lround(65535 * (look == Look::Full ? linearFromSrgb(c) : c)));
  }
  return table;
}

std::vector<Vertex> interleave(const Mesh& mesh, Look look) {
  const std::array<std::uint16_t, 256> colours = colourTable(look);
  std::vector<Vertex> vertices(mesh.positions.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    Vertex& v = vertices[i];
    std::transform(mesh.positions[i].begin(), mesh.positions[i].end(), v.position.begin(), finite);
    std::transform(mesh.normals[i].begin(), mesh.normals[i].end(), v.normal.begin(), finite);
    v.uv = mesh.uvs.empty() ? std::array<float, 2>{0, 0} : mesh.uvs[i];
    v.colour = {65535, 65535, 65535, 65535};
    if (mesh.colours.empty()) continue;
    const auto& c = mesh.colours[i];
    v.colour = {colours[c[0]], colours[c[1]], colours[c[2]], static_cast<std::uint16_t>(257 * c[3])};
  }
  return vertices;
}

std::vector<RichVertex> enriched(const Mesh& mesh, const std::vector<Vertex>& vertices) {
  std::vector<RichVertex> rich(vertices.size());
  for (std::size_t i = 0; i < rich.size(); ++i) {
    rich[i] = {vertices[i], {0, 0}, {0, 0, 0, 1}};
    if (!mesh.secondUvs.empty()) rich[i].secondUv = mesh.secondUvs[i];
    if (!mesh.tangents.empty()) rich[i].tangent = mesh.tangents[i];
  }
  return rich;
}

/// Makes the parts of a mesh.
struct PartMaker {
  const Mesh& mesh;
  const GlMesh& out;
  const std::vector<MapTexture>& textures;
  std::size_t stride;  ///< between two materials [bytes]
  bool open;           ///< the mesh shows its back faces

  /// 0: it is not uploaded.
  GLuint nameOf(const MaterialMap& map, std::size_t kind) const {
    for (const MapTexture& t : textures)
      if (map.texture == t.picture && map.sampler == t.sampler && holdsColours(kind) == t.colours)
        return t.gl.name();
    return 0;
  }
  MapTextures mapsOf(const Material& material) const {
    MapTextures maps{};
    for (std::size_t kind = 0; kind < kMapKinds; ++kind)
      if (isDrawn(mesh, material, kind)) maps[kind] = nameOf(material.maps[kind], kind);
    return maps;
  }

  /// `before`: number of indices of the levels before that of `indices`.
  GlSubmesh partOf(const Submesh& part, std::span<const std::uint32_t> indices, std::size_t before) const {
    const Material& material = mesh.materials[part.material];
    const auto own = indices.subspan(part.firstIndex, part.indexCount);
    const auto [least, most] = std::ranges::minmax_element(own);
    const std::uint32_t first = own.empty() ? 0 : *least, end = own.empty() ? 0 : *most + 1;
    return {
        static_cast<GLsizei>(part.indexCount),
        (out.place.first.indices + before + part.firstIndex) * sizeof(std::uint32_t),
        static_cast<GLintptr>(part.material * stride),
        mapsOf(material),
        !mesh.tangents.empty(),
        std::ranges::any_of(material.maps, [](const MaterialMap& m) { return m.given() && m.movesUvs(); }),
        material.unlit,
        material.transparent(),
        material.masked(),
        material.doubleSided || open,
        static_cast<std::uint32_t>(part.material),
        first,
        end};
  }
};

/// Below which alpha the texture itself leaves holes; 0 if it leaves none.
float textureCutoff(const Mesh& mesh, std::size_t texture) {
  for (const Material& m : mesh.materials)
    if (m.masked() && m.maps[kBaseMap].texture == static_cast<std::int64_t>(texture) && m.baseColour[3] > 0)
      return m.alphaCutoff / m.baseColour[3];
  return 0;
}

}  // namespace

void bindMaps(const GlTable& gl, const MapTextures& maps) {
  for (std::size_t kind = kMapKinds; kind-- > 0;) {
    if (maps[kind] == 0) continue;
    if (kind != kBaseMap) gl.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(kMapUnits[kind]));
    gl.BindTexture(GL_TEXTURE_2D, maps[kind]);
    if (kind != kBaseMap) gl.ActiveTexture(GL_TEXTURE0);
  }
}

MeshParts partsOf(const GlMesh& mesh, std::uint32_t level) {
  const std::vector<GlSubmesh>& parts = mesh.partsAt(level);
  std::uint32_t triangles = 0;
  for (const GlSubmesh& part : parts) triangles += part.triangles();
  return {&mesh, parts, triangles};
}

void pointAtInstances(const GlTable& gl, const FrameData& instances, std::uint32_t first) {
  constexpr std::size_t kRow = 4 * sizeof(float), kMatrix = 3 * kRow;
  gl.BindBuffer(GL_ARRAY_BUFFER, instances.buffer());
  for (GLuint row = 0; row < 3; ++row)
    gl.VertexAttribPointer(kModelX + row, 4, GL_FLOAT, GL_FALSE, kMatrix,
                           inBuffer(instances.offset() + first * kMatrix + row * kRow));
}

MeshCache::MeshCache(const GlTable& gl, const MeshStore& meshes, Look look, Layout layout)
    : gl_(gl), store_(meshes), look_(look), culls_(layout.culled),
      pages_(gl, sizeof(Vertex), layout.sharesPages), richPages_(gl, sizeof(RichVertex), layout.sharesPages),
      anisotropy_(!isSoftware(gl) && (hasGlExtension(gl, "GL_EXT_texture_filter_anisotropic") ||
                                      hasGlExtension(gl, "GL_ARB_texture_filter_anisotropic"))) {
  gl_.GetIntegerv(GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT, &uniformAlignment_);
}

const GlMesh* MeshCache::find(MeshId id) {
  auto at = meshes_.find(id);
  if (at == meshes_.end()) {
    const SpanScope span(probe_, Span::Upload);
    const Mesh* mesh = store_.find(id);
    if (!mesh) report("mesh " + std::to_string(id) + " is to be drawn but no longer there");
    at = meshes_.emplace(id, mesh ? Cached{mesh->hash, upload(*mesh)} : Cached{}).first;
  }
  return at->second.gl ? &*at->second.gl : nullptr;
}

bool MeshCache::holds(MeshId id) const {
  return meshes_.contains(id);
}

void MeshCache::freeUnused() {
  const std::uint64_t freed = store_.freedCount();
  if (freed == freedCount_) return;
  freedCount_ = freed;
  std::erase_if(meshes_, [this](const auto& entry) { return !store_.holds(entry.first, entry.second.hash); });
}

std::optional<Diagnostic> MeshCache::takeProblem() {
  return std::exchange(problem_, std::nullopt);
}

void MeshCache::report(std::string what) {
  if (!problem_) problem_ = problem(std::move(what));
}

std::optional<GlMesh> MeshCache::upload(const Mesh& mesh) {
  if (const std::string fault = drawingFault(mesh); !fault.empty()) {
    report("\"" + mesh.name + "\" cannot be drawn: " + fault);
    return {};
  }
  GlMesh out{{}, GlBuffer(gl_), {}, {}, {}, 0, {}, mesh.bounds, {}};
  uploadVertices(mesh, out);
  uploadTextures(mesh, out);
  uploadMaterials(mesh.materials, out);
  listParts(mesh, out.textures, out);
  if (const GLenum error = gl_.GetError(); error != GL_NO_ERROR) {
    report("\"" + mesh.name + "\" cannot be drawn: OpenGL says " + glErrorName(error));
    return {};
  }
  return out;
}

std::optional<GlMesh> MeshCache::copyOf(const Mesh& mesh, const GlMesh& original) {
  GlMesh out{{}, GlBuffer(gl_), {}, {}, {}, 0, {}, mesh.bounds, {}};
  uploadVertices(mesh, out);
  uploadMaterials(mesh.materials, out);
  listParts(mesh, original.textures, out);
  // They know the original's form.
  out.culler.reset();
  out.shading.reset();
  if (const GLenum error = gl_.GetError(); error != GL_NO_ERROR) {
    report("\"" + mesh.name + "\" cannot be drawn in another form: OpenGL says " + glErrorName(error));
    return {};
  }
  return out;
}

/// Without a culler and without shading: few objects are painted.
GlMesh MeshCache::paintedCopyOf(const Mesh& mesh, const GlMesh& original, const PaintRecord& paint) {
  GlMesh out{MeshPages::shared(original.place),
             GlBuffer(gl_),
             {},
             original.parts,
             original.levels,
             0,
             {},
             original.bounds,
             {}};
  if (pages_.areShared()) out.paintedMaterials.emplace(gl_);
  setPaint(mesh, paint, out);
  return out;
}

void MeshCache::setPaint(const Mesh& mesh, const PaintRecord& paint, GlMesh& copy) {
  const SpanScope span(probe_, Span::Upload);
  std::vector<Material> materials;
  for (const Material& m : mesh.materials) materials.push_back(painted(m, paint));
  uploadMaterials(materials, copy);
  const auto setFlags = [&](GlSubmesh& part) {
    part.transparent = materials[part.material].transparent() || paint.isSeeThrough();
    part.masked = materials[part.material].masked();
  };
  std::ranges::for_each(copy.parts, setFlags);
  for (auto& level : copy.levels) std::ranges::for_each(level, setFlags);
  copy.transparentParts = static_cast<std::size_t>(
      std::ranges::count_if(copy.parts, [](const GlSubmesh& part) { return part.transparent; }));
}

void MeshCache::setVertices(const Mesh& mesh, const MovedVertices& moved, const GlMesh& copy) {
  const SpanScope span(probe_, Span::Upload);
  gl_.BindBuffer(GL_ARRAY_BUFFER, copy.place.page->vertices.name());
  writeVertices(mesh, copy.place, moved);
}

/// Into the bound vertex buffer.
void MeshCache::writeVertices(const Mesh& mesh, const MeshPlace& place, const MovedVertices& moved) {
  std::vector<Vertex> vertices = interleave(mesh, look_);
  for (std::size_t i = 0; i < moved.vertices.size(); ++i) {
    std::ranges::transform(moved.vertices[i].position, vertices[i].position.begin(), finite);
    std::ranges::transform(moved.vertices[i].normal, vertices[i].normal.begin(), finite);
  }
  const auto write = [&](const auto& all) {
    gl_.BufferSubData(GL_ARRAY_BUFFER, static_cast<GLintptr>(place.first.vertices * sizeof all[0]),
                      static_cast<GLsizeiptr>(all.size() * sizeof all[0]), all.data());
  };
  if (!isRich(mesh)) return write(vertices);
  std::vector<RichVertex> rich = enriched(mesh, vertices);
  for (std::size_t i = 0; i < moved.tangents.size(); ++i) rich[i].tangent = moved.tangents[i];
  write(rich);
}

void MeshCache::uploadVertices(const Mesh& mesh, GlMesh& out) {
  std::vector<std::uint32_t> ofLevels;
  if (!mesh.levels.empty()) {
    ofLevels = mesh.indices;
    for (const MeshLevel& level : mesh.levels)
      ofLevels.insert(ofLevels.end(), level.indices.begin(), level.indices.end());
  }
  const std::span<const std::uint32_t> all = mesh.levels.empty() ? std::span(mesh.indices) : ofLevels;
  MeshPages& pages = isRich(mesh) ? richPages_ : pages_;
  out.place = pages.placeFor({mesh.positions.size(), all.size(), mesh.materials.size()});
  writeVertices(mesh, out.place, {});
  if (out.place.opensPage) describeVertices(isRich(mesh));
  uploadIndices(mesh, all, out);
}

/// Of the bound vertex array and vertex buffer.
void MeshCache::describeVertices(bool rich) const {
  const auto stride = static_cast<GLsizei>(rich ? sizeof(RichVertex) : sizeof(Vertex));
  const auto attribute = [&](GLuint at, GLint size, GLenum type, GLboolean normalised, std::size_t from) {
    gl_.EnableVertexAttribArray(at);
    gl_.VertexAttribPointer(at, size, type, normalised, stride, inBuffer(from));
  };
  attribute(kPosition, 3, GL_FLOAT, GL_FALSE, offsetof(Vertex, position));
  attribute(kNormal, 3, GL_FLOAT, GL_FALSE, offsetof(Vertex, normal));
  attribute(kUv, 2, GL_FLOAT, GL_FALSE, offsetof(Vertex, uv));
  attribute(kColour, 4, GL_UNSIGNED_SHORT, GL_TRUE, offsetof(Vertex, colour));
  if (rich) {
    attribute(kSecondUv, 2, GL_FLOAT, GL_FALSE, offsetof(RichVertex, secondUv));
    attribute(kTangent, 4, GL_FLOAT, GL_FALSE, offsetof(RichVertex, tangent));
  }
  for (const GLuint row : {kModelX, kModelY, kModelZ}) {  // the renderer points them at its instances
    gl_.EnableVertexAttribArray(row);
    gl_.VertexAttribDivisor(row, 1);
  }
}

/// Uploads the indices of all levels, one after the other. They count from the start of the page.
void MeshCache::uploadIndices(const Mesh& mesh, std::span<const std::uint32_t> all, GlMesh& out) {
  std::vector<std::uint32_t> moved;
  std::span<const std::uint32_t> inPage = all;
  if (const auto first = static_cast<std::uint32_t>(out.place.first.vertices); first > 0) {
    moved.assign(all.begin(), all.end());
    for (std::uint32_t& index : moved) index += first;
    inPage = moved;
  }
  gl_.BufferSubData(GL_ELEMENT_ARRAY_BUFFER,
                    static_cast<GLintptr>(out.place.first.indices * sizeof(std::uint32_t)),
                    static_cast<GLsizeiptr>(inPage.size_bytes()), inPage.data());
  if (culls_) out.culler.emplace(mesh, all);
}

/// Returns the distance between two materials in their buffer [bytes].
std::size_t MeshCache::materialStride() const {
  const auto alignment = static_cast<std::size_t>(std::max(uniformAlignment_, 1));
  return (sizeof(MaterialBlock) + alignment - 1) / alignment * alignment;
}

void MeshCache::uploadMaterials(std::span<const Material> materials, GlMesh& out) {
  const std::size_t stride = materialStride();
  std::vector<std::byte> blocks(stride * materials.size());
  std::vector<MaterialBlock> packed(materials.size());
  for (std::size_t i = 0; i < materials.size(); ++i) {
    packed[i] = fillMaterial(materials[i], look_);
    std::memcpy(blocks.data() + i * stride, &packed[i], sizeof packed[i]);
  }
  gl_.BindBuffer(GL_UNIFORM_BUFFER, out.materials.name());
  gl_.BufferData(GL_UNIFORM_BUFFER, static_cast<GLsizeiptr>(blocks.size()), blocks.data(), GL_STATIC_DRAW);
  if (!pages_.areShared()) return;
  const auto bytes = static_cast<GLsizeiptr>(packed.size() * sizeof(MaterialBlock));
  gl_.BindBuffer(GL_SHADER_STORAGE_BUFFER, out.packedMaterials());
  if (out.paintedMaterials)
    gl_.BufferData(GL_SHADER_STORAGE_BUFFER, bytes, packed.data(), GL_STATIC_DRAW);
  else
    gl_.BufferSubData(GL_SHADER_STORAGE_BUFFER,
                      static_cast<GLintptr>(out.place.first.materials * sizeof(MaterialBlock)), bytes,
                      packed.data());
}

/// Lists the parts of all levels. Expects the textures.
void MeshCache::listParts(const Mesh& mesh, const std::vector<MapTexture>& textures, GlMesh& out) const {
  const PartMaker make{mesh, out, textures, materialStride(), !isClosed(mesh)};
  for (const Submesh& part : mesh.submeshes) {
    out.parts.push_back(make.partOf(part, mesh.indices, 0));
    out.transparentParts += mesh.materials[part.material].transparent();
  }
  std::size_t first = mesh.indices.size();
  for (const MeshLevel& level : mesh.levels) {
    std::vector<GlSubmesh>& parts = out.levels.emplace_back();
    for (const Submesh& part : level.submeshes) parts.push_back(make.partOf(part, level.indices, first));
    first += level.indices.size();
  }
  const auto isPlain = [](const GlSubmesh& part) {
    const auto isNone = [](GLuint map) { return map == 0; };
    return std::ranges::all_of(part.maps, isNone) && !part.transparent && !part.masked && !part.unlit;
  };
  if (culls_ && look_ == Look::Plain && std::ranges::all_of(out.parts, isPlain)) out.shading.emplace(mesh);
}

/// Uploads those that the look reads.
void MeshCache::uploadTextures(const Mesh& mesh, GlMesh& out) {
  for (const Material& material : mesh.materials)
    for (std::size_t kind = 0; kind < kMapKinds; ++kind) {
      const MaterialMap& map = material.maps[kind];
      const bool colours = holdsColours(kind);
      if (!map.given() || (look_ == Look::Plain && !colours)) continue;
      const auto isSame = [&](const MapTexture& t) {
        return t.picture == map.texture && t.sampler == map.sampler && t.colours == colours;
      };
      if (std::ranges::any_of(out.textures, isSame)) continue;
      const auto picture = static_cast<std::size_t>(map.texture);
      const float cutoff = colours ? textureCutoff(mesh, picture) : 0;
      out.textures.push_back({map.texture, map.sampler, colours,
                              uploadTexture(mesh.textures[picture], cutoff, map.sampler, colours)});
    }
}

GlTexture MeshCache::uploadTexture(const Texture& texture, float alphaCutoff, const Sampler& sampler,
                                   bool colours) {
  GlTexture out(gl_);
  const std::vector<Texture> smaller =
      alphaCutoff > 0 ? maskLevels(texture, alphaCutoff, look_) : std::vector<Texture>();
  gl_.BindTexture(GL_TEXTURE_2D, out.name());
  gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  const GLint format = look_ == Look::Full && colours ? GL_SRGB8_ALPHA8 : GL_RGBA8;
  const auto level = [&](GLint number, const Texture& of) {
    gl_.TexImage2D(GL_TEXTURE_2D, number, format, static_cast<GLsizei>(of.width),
                   static_cast<GLsizei>(of.height), 0, GL_RGBA, GL_UNSIGNED_BYTE, of.rgba.data());
  };
  level(0, texture);
  for (std::size_t i = 0; i < smaller.size(); ++i) level(static_cast<GLint>(i + 1), smaller[i]);
  if (alphaCutoff > 0)
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, static_cast<GLint>(smaller.size()));
  else
    gl_.GenerateMipmap(GL_TEXTURE_2D);
  setSampler(sampler);
  return out;
}

/// Of the bound texture.
void MeshCache::setSampler(const Sampler& sampler) const {
  constexpr GLint kWraps[]{GL_REPEAT, GL_MIRRORED_REPEAT, GL_CLAMP_TO_EDGE};
  constexpr GLint kReduced[3][2]{{GL_LINEAR_MIPMAP_LINEAR, GL_NEAREST_MIPMAP_LINEAR},
                                 {GL_LINEAR_MIPMAP_NEAREST, GL_NEAREST_MIPMAP_NEAREST},
                                 {GL_LINEAR, GL_NEAREST}};
  const auto set = [&](GLenum what, GLint value) { gl_.TexParameteri(GL_TEXTURE_2D, what, value); };
  set(GL_TEXTURE_WRAP_S, kWraps[static_cast<std::size_t>(sampler.wrapU)]);
  set(GL_TEXTURE_WRAP_T, kWraps[static_cast<std::size_t>(sampler.wrapV)]);
  set(GL_TEXTURE_MIN_FILTER, kReduced[static_cast<std::size_t>(sampler.mipmaps)][sampler.minifiesNearest]);
  set(GL_TEXTURE_MAG_FILTER, sampler.magnifiesNearest ? GL_NEAREST : GL_LINEAR);
  const bool blends = !sampler.minifiesNearest && sampler.mipmaps != MipmapUse::None;
  if (anisotropy_ && blends) gl_.TexParameterf(GL_TEXTURE_2D, GL_TEXTURE_MAX_ANISOTROPY, kAnisotropy);
}

}  // namespace stadion
