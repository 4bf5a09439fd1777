#include "pipeline/raster/triangle_culler.h"

#include "pipeline/gl/finite.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr std::size_t kCullLanes = 8;

std::size_t padded(std::size_t count) {
  return (count + kCullLanes - 1) / kCullLanes * kCullLanes;
}

}  // namespace

const CullKernels& bestCuller() {
  return __builtin_cpu_supports("avx2") ? kCullByEight : kCullByFour;
}

CullerMesh::CullerMesh(const Mesh& mesh, std::span<const std::uint32_t> indices) {
  const std::size_t vertices = padded(mesh.positions.size()), triangles = indices.size() / 3;
  for (auto* axis : {&x, &y, &z}) axis->resize(vertices);
  for (std::size_t i = 0; i < vertices; ++i) {  // vertices past the last one repeat it
    const auto& p = mesh.positions[std::min(i, mesh.positions.size() - 1)];
    x[i] = finite(p[0]);
    y[i] = finite(p[1]);
    z[i] = finite(p[2]);
  }
  std::size_t corner = 0;
  for (auto* corners : {&a, &b, &c}) {
    corners->resize(triangles + kCullLanes - 1);
    for (std::size_t t = 0; t < triangles; ++t)
      (*corners)[t] = static_cast<std::int32_t>(indices[3 * t + corner]);
    ++corner;
  }
}

TriangleCuller::TriangleCuller(std::uint32_t width, std::uint32_t height, const CullKernels& kernels)
    : kernels_(kernels), halfWidth_(0.5 * width), halfHeight_(0.5 * height), oddX_(width % 2 == 0 ? 0 : 0.5),
      oddY_(height % 2 == 0 ? 0 : 0.5), width_(width), height_(height) {}

void TriangleCuller::setView(const DrawView& eye) {
  eye_ = eye;
  clip_ = eye.projection * eye.view;
  seen_ = {};
}

/// A depth d is p23 / w - p22 for the projection's third row, so that 1 / w = (d + p22) / p23.
void TriangleCuller::hideBehind(std::span<const float> depths) {
  constexpr double kDepthRounding = 4e-7;  // of depths of a surface that begins near the eye, doubled
  constexpr double kBehind = 1.001;        // equally near is not behind
  const double p22 = eye_.projection(2, 2), p23 = eye_.projection(2, 3);
  const bool perspective = eye_.projection(3, 2) == -1 && eye_.projection(3, 3) == 0 && p23 > 0;
  if (!perspective) return;
  const int wide = static_cast<int>((width_ + kSquare - 1) / kSquare),
            high = static_cast<int>((height_ + kSquare - 1) / kSquare);
  squares_.resize(static_cast<std::size_t>(wide) * static_cast<std::size_t>(high));
  const NearnessOfDepth of{static_cast<float>(1 / p23 / kBehind),
                           static_cast<float>((p22 - kDepthRounding) / p23 / kBehind)};
  kernels_.squares(depths.data(), static_cast<int>(width_), static_cast<int>(height_), of, squares_.data());
  seen_ = {squares_.data(), wide, high, static_cast<float>(width_ / 2), static_cast<float>(height_ / 2)};
}

void TriangleCuller::place(const CullerMesh& mesh, const InstanceMatrix& model) {
  mesh_ = &mesh;
  PictureMatrix m;
  for (int k = 0; k < 4; ++k) {
    const auto of = [&](int row) {
      double sum = k == 3 ? clip_(row, 3) : 0;
      for (int i = 0; i < 3; ++i)
        sum += clip_(row, i) * static_cast<double>(model[static_cast<std::size_t>(4 * i + k)]);
      return sum;
    };
    const double x = of(0), y = of(1), w = of(3);
    m.x[k] = static_cast<float>(halfWidth_ * x + oddX_ * w);
    m.y[k] = static_cast<float>(halfHeight_ * y + oddY_ * w);
    m.w[k] = static_cast<float>(w);
  }
  if (px_.size() < mesh.x.size())
    for (auto* values : {&px_, &py_, &nearness_}) values->resize(mesh.x.size());
  told_ = kernels_.project(mesh.x.data(), mesh.y.data(), mesh.z.data(), static_cast<unsigned>(mesh.x.size()),
                           m, px_.data(), py_.data(), nearness_.data(), bounds_);
}

TriangleCuller::Range TriangleCuller::keep(std::uint32_t first, std::uint32_t count, Facing facing) {
  if (kept_.size() < used_ + 3 * count) kept_.resize(2 * (used_ + 3 * count));
  Range range{static_cast<std::uint32_t>(used_), 3 * count};
  std::uint32_t* out = kept_.data() + used_;
  const std::int32_t *a = mesh_->a.data() + first, *b = mesh_->b.data() + first, *c = mesh_->c.data() + first;
  if (told_) {
    const float sign = facing == Facing::Both ? 0 : facing == Facing::Clockwise ? -1 : 1;
    range.count = kernels_.keep(a, b, c, count, px_.data(), py_.data(), nearness_.data(), sign, seen_, out);
  } else {
    for (std::uint32_t t = 0; t < count; ++t) {
      const std::int32_t corners[] = {a[t], b[t], c[t]};
      for (const std::int32_t corner : corners) *out++ = static_cast<std::uint32_t>(corner);
    }
  }
  used_ += range.count;
  return range;
}

}  // namespace stadion
