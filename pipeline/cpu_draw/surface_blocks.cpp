#include "pipeline/cpu_draw/surface_blocks.h"

#include "pipeline/cpu_draw/plain_light.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

/// In a SurfaceBlock.
constexpr std::size_t kOriginX = 3, kOriginY = 7, kFacing = 11, kFirstCorner = 12, kCornerFloats = 12;
constexpr std::size_t kNormalOf = 0, kPositionOf = 3, kUvOf = 6, kColourOf = 8;

double rowTimes(const float* row, const std::array<float, 3>& p) {
  return double{row[0]} * p[0] + double{row[1]} * p[1] + double{row[2]} * p[2] + row[3];
}

}  // namespace

void SurfaceBlocks::fill(const TriangleRecord& record, const TriangleStretch& stretch,
                         SurfaceBlock& out) const {
  const PictureInstance& instance = picture_.instance(stretch.instance);
  const CpuMesh& mesh = *instance.mesh;
  const std::array<int, 3> triangle = mesh.triangle(record.triangle);
  const bool parallel = picture_.geometry().parallel;
  const auto& m = instance.model;
  std::array<Corner, 3> inPicture;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::array<float, 3> p = mesh.position(triangle[k]);
    const CpuMesh::Vertex& v = mesh.vertex(triangle[k]);
    const double w = parallel ? 1 : rowTimes(instance.matrix.w, p);
    inPicture[k] = {rowTimes(instance.matrix.x, p) - record.left * w,
                    rowTimes(instance.matrix.y, p) - record.low * w, w};
    float* corner = out.at + kFirstCorner + k * kCornerFloats;
    std::array<float, 3> n;
    for (std::size_t row = 0; row < 3; ++row) {
      const float *r = &m[4 * row], *c = &instance.normals[3 * row];
      corner[kPositionOf + row] = r[0] * p[0] + r[1] * p[1] + r[2] * p[2] + r[3];
      n[row] = c[0] * v.normal[0] + c[1] * v.normal[1] + c[2] * v.normal[2];
    }
    const float per = 1 / std::sqrt(std::max(n[0] * n[0] + n[1] * n[1] + n[2] * n[2], 1e-30f));
    for (std::size_t row = 0; row < 3; ++row) corner[kNormalOf + row] = n[row] * per;
    std::ranges::copy(v.uv, corner + kUvOf);
    std::ranges::copy(v.colour, corner + kColourOf);
    const MaterialParameters& material = *picture_.materials()[stretch.material];
    corner[kColourOf + 3] *= material.baseColour[3];
    if (look_ == Look::Plain) lightCorner(material, corner);
  }
  fillWeights(inPicture, out);
  out.at[kOriginX] = record.left, out.at[kOriginY] = record.low;
  out.at[kFacing] = (record.sourceAndFlags & kFacesAway) != 0 ? -1.0f : 1.0f;
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
  const std::array<float, 3> light = plainLight(scene_, p, n);
  float* colour = corner + kColourOf;
  float squared = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const float emitted = material.glow.texels ? 0 : material.emissive[k];
    colour[k] = std::min(emitted + material.baseColour[k] * colour[k] * light[k], 1.0f);
    squared += (view_.eye[k] - p[k]) * (view_.eye[k] - p[k]);
  }
  corner[kNormalOf] = scene_.perHaze > 0 ? clearnessAt(scene_, std::sqrt(squared)) : 1;
}

}  // namespace stadion
