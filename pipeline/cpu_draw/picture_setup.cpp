#include "pipeline/cpu_draw/picture_setup.h"

#include "pipeline/cpu_draw/triangle_clipper.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr std::uint32_t kVerticesAPiece = 8192, kTrianglesAPiece = 4096;
constexpr std::uint32_t kPlacedRounding = 16;  ///< vertices of an instance and of a piece begin at a multiple

/// The cofactors of the model matrix, with the sign of its determinant.
std::array<float, 9> normalsBy(const std::array<float, 12>& m) {
  std::array<float, 9> out;
  for (std::size_t row = 0; row < 3; ++row) {
    const float *u = &m[4 * ((row + 1) % 3)], *v = &m[4 * ((row + 2) % 3)];
    for (std::size_t k = 0; k < 3; ++k)
      out[3 * row + k] = u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3];
  }
  if (m[0] * out[0] + m[1] * out[1] + m[2] * out[2] < 0)
    for (float& x : out) x = -x;
  return out;
}

bool isFinite(const std::array<float, 12>& m) {
  return std::ranges::all_of(m, [](float x) { return std::isfinite(x); });
}

bool turnsLeftIntoRight(const std::array<float, 12>& m) {
  const auto at = [&](std::size_t i) { return static_cast<double>(m[i]); };
  return at(0) * (at(5) * at(10) - at(6) * at(9)) - at(1) * (at(4) * at(10) - at(6) * at(8)) +
             at(2) * (at(4) * at(9) - at(5) * at(8)) <
         0;
}

}  // namespace

void PictureSetup::begin(const ViewGeometry& geometry, int samples, float slopeOffset, float stepOffset) {
  geometry_ = geometry;
  samples_ = samples;
  slopeOffset_ = slopeOffset;
  stepOffset_ = stepOffset;
  bands_ = static_cast<std::size_t>((geometry.height + kBandRows - 1) / kBandRows);
  instances_.clear();
  stretches_.clear();
  materials_.clear();
  placements_.clear();
  vertices_ = 0;
  partsAdded_ = 0;
  trianglesAdded_ = 0;
  hasExtras_ = false;
}

bool PictureSetup::add(const std::shared_ptr<const CpuMesh>& mesh, std::uint32_t level,
                       const std::array<float, 12>& model, Transparency which,
                       const std::shared_ptr<const MeshPaint>& paint) {
  if (!isFinite(model)) return false;
  const auto number = static_cast<std::uint32_t>(instances_.size());
  bool any = false;
  for (const CpuPart& part : mesh->partsAt(level)) {
    const bool transparent = part.transparent || (paint && paint->seeThrough);
    if (transparent != (which == Transparency::Transparent) || part.triangles == 0) continue;
    if (!any)
      instances_.push_back({mesh, paint, model, normalsBy(model), geometry_.placing(model), vertices_,
                            turnsLeftIntoRight(model)});
    any = true;
    addPart(number, part,
            materialNumber(paint ? paint->materials[part.material] : mesh->material(part.material)));
  }
  if (any) addPlacements(number);
  hasExtras_ |= any && mesh->extras();
  return true;
}

void PictureSetup::addPart(std::uint32_t instance, const CpuPart& part, std::uint32_t material) {
  const PixelMatrix& by = instances_[instance].matrix;
  const bool posed = instances_[instance].mesh->isPosed();
  const MeshPaint* paint = instances_[instance].paint.get();
  const bool seeThrough = paint && paint->seeThrough;
  const std::size_t before = stretches_.size();
  for (const MeshSection& s : part.sections) {
    if (!posed && !mayBeSeen(s, by, geometry_.parallel, geometry_.width, geometry_.height)) continue;
    wanted_.push_back({s.firstVertex / kPlacedRounding * kPlacedRounding,
                       (s.endVertex + kPlacedRounding - 1) / kPlacedRounding * kPlacedRounding});
    TriangleStretch* last = stretches_.size() > before ? &stretches_.back() : nullptr;
    if (last && last->first + last->count == s.firstTriangle && last->count + s.triangles <= kTrianglesAPiece)
      last->count += s.triangles;
    else
      stretches_.push_back({instance, s.firstTriangle, s.triangles, &part, material,
                            part.transparent || seeThrough, part.masked && !seeThrough});
  }
  ++partsAdded_;
  trianglesAdded_ += part.triangles;
}

/// Places the vertices of the sections that may be seen, each once.
void PictureSetup::addPlacements(std::uint32_t instance) {
  std::ranges::sort(wanted_, {}, &VertexRange::first);
  std::uint32_t placed = 0;  // all before it
  for (const VertexRange& range : wanted_)
    for (placed = std::max(placed, range.first); placed < range.end;) {
      const std::uint32_t count = std::min(range.end - placed, kVerticesAPiece);
      placements_.push_back({instance, placed, count});
      placed += count;
    }
  wanted_.clear();
  const std::uint32_t count = instances_[instance].mesh->vertexCount();
  vertices_ += (count + kPlacedRounding - 1) / kPlacedRounding * kPlacedRounding;
}

std::uint32_t PictureSetup::materialNumber(const MaterialParameters& material) {
  // Neighbours are often of one mesh.
  const auto last = materials_.rbegin();
  if (last != materials_.rend() && *last == &material)
    return static_cast<std::uint32_t>(materials_.size() - 1);
  const auto at = std::ranges::find(materials_, &material);
  if (at != materials_.end()) return static_cast<std::uint32_t>(at - materials_.begin());
  materials_.push_back(&material);
  return static_cast<std::uint32_t>(materials_.size() - 1);
}

void PictureSetup::divide() {
  if (const std::size_t size = 4 * (vertices_ + kKernelPadding); placed_.size() < size) placed_.resize(size);
  chunksUsed_ = 0;
  Chunk* chunk = nullptr;
  for (std::uint32_t i = 0; i < stretches_.size(); ++i) {
    const TriangleStretch& s = stretches_[i];
    const Transparency which = s.transparent ? Transparency::Transparent : Transparency::Opaque;
    if (!chunk || chunk->which != which || chunk->masked != s.masked ||
        chunk->triangles + s.count > kTrianglesAPiece) {
      if (chunksUsed_ == chunks_.size()) chunks_.emplace_back();
      chunk = &chunks_[chunksUsed_++];
      chunk->which = which;
      chunk->masked = s.masked;
      chunk->firstStretch = i;
      chunk->triangles = 0;
    }
    chunk->endStretch = i + 1;
    chunk->triangles += s.count;
  }
}

void PictureSetup::place(std::size_t piece) {
  const Placement& p = placements_[piece];
  const PictureInstance& instance = instances_[p.instance];
  const MeshPositions from = instance.mesh->positions();
  kernels_.place({from.x + p.first, from.y + p.first, from.z + p.first}, p.count, instance.matrix,
                 geometry_.parallel, {placed(instance).at + 4 * std::size_t{p.first}});
}

SetupParameters PictureSetup::parametersOf(std::uint32_t number) const {
  const TriangleStretch& stretch = stretches_[number];
  SetupParameters s{};
  s.width = geometry_.width;
  s.height = geometry_.height;
  s.samples = samples_;
  s.mirrored = instances_[stretch.instance].mirrored ? -1.0f : 1.0f;
  s.facing = stretch.part->bothSides ? 0 : s.mirrored;
  s.leastDepth = geometry_.leastDepth;
  s.mostDepth = geometry_.mostDepth;
  s.slopeOffset = slopeOffset_;
  s.stepOffset = stepOffset_;
  s.source = number;
  return s;
}

void PictureSetup::setUpStretch(std::uint32_t number, std::vector<TriangleRecord>& records) const {
  constexpr std::uint32_t kAtOnce = 256;
  const TriangleStretch& stretch = stretches_[number];
  const PictureInstance& instance = instances_[stretch.instance];
  const SetupParameters by = parametersOf(number);
  const PlacedVertices at = placed(instance);
  const TriangleClipper clipper(by, geometry_.parallel);
  TriangleRecord made[kAtOnce];
  for (std::uint32_t done = 0; done < stretch.count; done += kAtOnce) {
    const std::uint32_t count = std::min(stretch.count - done, kAtOnce);
    const unsigned found =
        kernels_.setUp(instance.mesh->corners(), stretch.first + done, count, at, by, made);
    for (const TriangleRecord& r : std::span(made, found)) {
      if (r.sourceAndFlags & kUnfinished)
        finish(r, stretch, clipper, records);
      else
        records.push_back(r);
    }
  }
}

void PictureSetup::finish(const TriangleRecord& record, const TriangleStretch& stretch,
                          const TriangleClipper& clipper, std::vector<TriangleRecord>& records) const {
  const PictureInstance& instance = instances_[stretch.instance];
  std::array<std::array<float, 3>, 3> corners;
  std::ranges::transform(instance.mesh->triangle(record.triangle), corners.begin(),
                         [&](int v) { return instance.mesh->position(v); });
  clipper.clip(corners, instance.matrix, record.triangle, !stretch.transparent, records);
}

void PictureSetup::setUp(std::size_t piece) {
  Chunk& chunk = chunks_[piece];
  chunk.records.clear();
  for (std::uint32_t i = chunk.firstStretch; i < chunk.endStretch; ++i) setUpStretch(i, chunk.records);
  sortIntoBands(chunk);
}

/// By counting.
void PictureSetup::sortIntoBands(Chunk& chunk) const {
  chunk.binEnds.assign(bands_ + 2, 0);
  const auto bandOf = [](short row) { return static_cast<std::size_t>(row / kBandRows); };
  for (const TriangleRecord& r : chunk.records)
    for (std::size_t band = bandOf(r.low); band <= bandOf(r.high); ++band) ++chunk.binEnds[band + 2];
  for (std::size_t band = 2; band < chunk.binEnds.size(); ++band)
    chunk.binEnds[band] += chunk.binEnds[band - 1];
  chunk.bins.resize(chunk.binEnds.back());
  for (std::uint32_t i = 0; i < chunk.records.size(); ++i)
    for (std::size_t band = bandOf(chunk.records[i].low); band <= bandOf(chunk.records[i].high); ++band)
      chunk.bins[chunk.binEnds[band + 1]++] = i;
}

}  // namespace stadion
