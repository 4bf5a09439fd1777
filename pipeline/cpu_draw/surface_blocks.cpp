#include "pipeline/cpu_draw/surface_blocks.h"

#include "pipeline/cpu_draw/plain_light.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

/// In a SurfaceBlock.
constexpr std::size_t kFirstCorner = 12, kCornerFloats = 12;
constexpr std::size_t kNormalOf = 0, kPositionOf = 3, kColourOf = 8;

double rowTimes(const float* row, const std::array<float, 3>& p) {
  return double{row[0]} * p[0] + double{row[1]} * p[1] + double{row[2]} * p[2] + row[3];
}

/// Turns a corner's tangent to World axes, unit.
void placeExtra(const PictureInstance& instance, const float* from, float* to) {
  float squared = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const float* row = instance.model.data() + 4 * k;
    to[k] = row[0] * from[0] + row[1] * from[1] + row[2] * from[2];
    squared += to[k] * to[k];
  }
  const float per = 1 / std::sqrt(std::max(squared, 1e-30f));
  for (std::size_t k = 0; k < 3; ++k) to[k] *= per;
  to[3] = instance.mirrored ? -from[3] : from[3];
  std::copy_n(from + 4, kExtraVertexFloats - 4, to + 4);
}

}  // namespace

void SurfaceBlocks::fill(std::span<const TriangleRecord* const> triangles, SurfaceBlock* out) const {
  while (!triangles.empty()) {
    const TriangleStretch* stretch = &picture_.stretchOf(*triangles[0]);
    std::size_t same = 1;
    while (same < triangles.size() && &picture_.stretchOf(*triangles[same]) == stretch) ++same;
    fillStretch(triangles.first(same), out);
    triangles = triangles.subspan(same);
    out += same;
  }
}

/// Of triangles of one stretch.
void SurfaceBlocks::fillStretch(std::span<const TriangleRecord* const> triangles, SurfaceBlock* out) const {
  const TriangleStretch& stretch = picture_.stretchOf(*triangles[0]);
  const PictureInstance& instance = picture_.instance(stretch.instance);
  const MaterialParameters& material = *picture_.materials()[stretch.material];
  SurfaceJob job{};
  job.triangles = triangles.data();
  job.count = static_cast<unsigned>(triangles.size());
  job.corners = instance.mesh->corners();
  job.vertices = instance.mesh->vertices();
  job.placed = picture_.placed(instance);
  job.parallel = picture_.geometry().parallel;
  job.model = instance.model.data();
  job.normals = instance.normals.data();
  job.alpha = material.baseColour[3];
  job.out = out;
  kernels_.makeSurfaces(job);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (triangles[i]->sourceAndFlags & kClipped) weighClipped(*triangles[i], out[i]);
    if (look_ == Look::Plain)
      for (std::size_t k = 0; k < 3; ++k) lightCorner(material, out[i].at + kFirstCorner + k * kCornerFloats);
  }
}

void SurfaceBlocks::fillExtras(std::span<const TriangleRecord* const> triangles, SurfaceExtra* out) const {
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const PictureInstance& instance = picture_.instance(picture_.stretchOf(*triangles[i]).instance);
    const float* from = instance.mesh->extras();
    if (!from) continue;
    const std::array<int, 3> corners = instance.mesh->triangle(triangles[i]->triangle);
    for (std::size_t k = 0; k < 3; ++k)
      placeExtra(instance, from + static_cast<std::size_t>(corners[k]) * kExtraVertexFloats,
                 out[i].at + k * kExtraVertexFloats);
  }
}

/// Corners of a clipped triangle may lie behind the eye: they have no place in the picture.
void SurfaceBlocks::weighClipped(const TriangleRecord& record, SurfaceBlock& out) const {
  const PictureInstance& instance = picture_.instance(picture_.stretchOf(record).instance);
  const std::array<int, 3> triangle = instance.mesh->triangle(record.triangle);
  std::array<Corner, 3> corners;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::array<float, 3> p = instance.mesh->position(triangle[k]);
    const double w = picture_.geometry().parallel ? 1 : rowTimes(instance.matrix.w, p);
    corners[k] = {rowTimes(instance.matrix.x, p) - record.left * w,
                  rowTimes(instance.matrix.y, p) - record.low * w, w};
  }
  fillWeights(corners, out);
}

/// A corner's weight is the volume that a ray spans with the two others; corners behind the eye do no harm.
void SurfaceBlocks::fillWeights(const std::array<Corner, 3>& p, SurfaceBlock& out) {
  std::array<Corner, 3> rows;
  for (std::size_t k = 0; k < 3; ++k) {
    const Corner &b = p[(k + 1) % 3], &c = p[(k + 2) % 3];
    rows[k] = {b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2], b[0] * c[1] - b[1] * c[0]};
  }
  const double whole = p[0][0] * rows[0][0] + p[0][1] * rows[0][1] + p[0][2] * rows[0][2];
  const double per = 1 / whole;
  float sum = 0;
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < 3; ++i)
      out.at[4 * k + i] = static_cast<float>(rows[k][i] * per), sum += out.at[4 * k + i];
  if (std::isfinite(sum)) return;
  for (std::size_t k = 0; k < 3; ++k) out.at[4 * k] = out.at[4 * k + 1] = 0, out.at[4 * k + 2] = 1;
}

/// As in the vertex shader. The light takes the place of the colour, the clearness of the air that of the
/// normal.
void SurfaceBlocks::lightCorner(const MaterialParameters& material, float* corner) const {
  const std::array<float, 3> n{corner[0], corner[1], corner[2]};
  const std::array<float, 3> p{corner[kPositionOf], corner[kPositionOf + 1], corner[kPositionOf + 2]};
  const std::array<float, 3> light =
      material.unlit ? std::array<float, 3>{1, 1, 1} : plainLight(scene_, p, n);
  float* colour = corner + kColourOf;
  float squared = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const float emitted = material.glow.texels || material.unlit ? 0 : material.emissive[k];
    colour[k] = std::min(emitted + material.baseColour[k] * colour[k] * light[k], 1.0f);
    squared += (view_.eye[k] - p[k]) * (view_.eye[k] - p[k]);
  }
  corner[kNormalOf] = scene_.perHaze > 0 ? clearnessAt(scene_, std::sqrt(squared)) : 1;
}

}  // namespace stadion
