#include "pipeline/raster/small_object_rasterizer.h"

#include "pipeline/gl/finite.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr std::size_t kLanes = 8;

std::uint32_t packed(const std::array<float, 3>& colour) {
  std::uint32_t all = 0xff000000U;
  for (std::size_t i = 0; i < 3; ++i)
    all |= static_cast<std::uint32_t>(std::lround(255 * std::clamp(colour[i], 0.0f, 1.0f))) << (8 * i);
  return all;
}

/// Transforms normals in the mesh to normals in World: the cofactors, as cross products of rows, with the
/// sign of the determinant. The shader does the same.
void normalsBy(const InstanceMatrix& m, float (&out)[9]) {
  const auto cross = [&](std::size_t a, std::size_t b, float* row) {
    const float *u = &m[4 * a], *v = &m[4 * b];
    row[0] = u[1] * v[2] - u[2] * v[1], row[1] = u[2] * v[0] - u[0] * v[2],
    row[2] = u[0] * v[1] - u[1] * v[0];
  };
  cross(1, 2, out);
  cross(2, 0, out + 3);
  cross(0, 1, out + 6);
  if (m[0] * out[0] + m[1] * out[1] + m[2] * out[2] < 0)
    for (float& x : out) x = -x;
}

}  // namespace

const RasterKernels& bestRaster() {
  return __builtin_cpu_supports("avx2") ? kRasterByEight : kRasterByFour;
}

MeshShading::MeshShading(const Mesh& mesh) {
  const std::size_t count = mesh.positions.size(), room = (count + kLanes - 1) / kLanes * kLanes;
  for (auto* values : {&nx, &ny, &nz, &r, &g, &b}) values->resize(room);
  for (std::size_t i = 0; i < count; ++i) {
    nx[i] = finite(mesh.normals[i][0]), ny[i] = finite(mesh.normals[i][1]),
    nz[i] = finite(mesh.normals[i][2]);
    constexpr std::array<std::uint8_t, 4> kWhite{255, 255, 255, 255};
    const auto& c = mesh.colours.empty() ? kWhite : mesh.colours[i];
    r[i] = static_cast<float>(c[0]) / 255;
    g[i] = static_cast<float>(c[1]) / 255;
    b[i] = static_cast<float>(c[2]) / 255;
  }
  for (const Material& material : mesh.materials) materials.push_back(fillMaterial(material, Look::Plain));
}

SmallObjectRasterizer::SmallObjectRasterizer(std::uint32_t width, std::uint32_t height,
                                             const RasterKernels& kernels)
    : kernels_(kernels), width_(static_cast<int>(width)), height_(static_cast<int>(height)),
      culler_(width, height), colours_(std::size_t{width} * height), depths_(std::size_t{width} * height) {}

bool SmallObjectRasterizer::serves(const DrawView& eye, const SceneBlock& scene) {
  const Mat4& p = eye.projection;
  const bool perspective = p(3, 2) == -1 && p(3, 3) == 0 && p(2, 3) > 0 && p(3, 0) == 0 && p(3, 1) == 0;
  bool directional = true;
  for (int i = 0; i < scene.lightCount[0]; ++i)
    directional = directional && scene.lights[static_cast<std::size_t>(i)].direction[3] == 0;
  return perspective && directional && scene.ambient[3] == 0;
}

/// A depth d is p23 / w - p22 for the projection's third row: 1 at the near plane.
void SmallObjectRasterizer::begin(const DrawView& eye, const SceneBlock& scene,
                                  const std::array<float, 3>& background) {
  const double p22 = eye.projection(2, 2), p23 = eye.projection(2, 3);
  nearest_ = static_cast<float>((1 + p22) / p23);
  std::ranges::fill(colours_, packed(background));
  std::ranges::fill(depths_, 0.0f);
  target_ = {colours_.data(), depths_.data(),          width_,
             height_,         static_cast<float>(p23), static_cast<float>(-p22)};
  lights_.clear();
  for (int i = 0; i < scene.lightCount[0]; ++i) {
    const LightBlock& l = scene.lights[static_cast<std::size_t>(i)];
    lights_.push_back(
        {{l.direction[0], l.direction[1], l.direction[2]}, {l.colour[0], l.colour[1], l.colour[2]}});
  }
  by_.lights = lights_.data();
  by_.lightCount = static_cast<unsigned>(lights_.size());
  std::copy_n(scene.ambient.begin(), 3, by_.ambient);
  culler_.setView(eye);
}

bool SmallObjectRasterizer::place(const CullerMesh& mesh, const MeshShading& shading,
                                  const InstanceMatrix& model) {
  culler_.clear();
  culler_.place(mesh, model);
  const PictureBounds* at = culler_.bounds();
  const int left = -(width_ / 2), bottom = -(height_ / 2);
  const auto within = [](float from, float to, int least, int size) {
    return from >= static_cast<float>(least) && to <= static_cast<float>(least + size) &&
           to - from <= kMostSmall;
  };
  if (!at || !within(at->left, at->right, left, width_) || !within(at->low, at->high, bottom, height_) ||
      at->nearest > nearest_)
    return false;
  shading_ = &shading;
  normalsBy(model, by_.normals);
  return true;
}

std::uint32_t SmallObjectRasterizer::draw(std::uint32_t first, std::uint32_t count,
                                          TriangleCuller::Facing facing, const MaterialBlock& material,
                                          std::uint32_t firstVertex, std::uint32_t endVertex) {
  using Facing = TriangleCuller::Facing;
  culler_.clear();
  const TriangleCuller::Range kept = culler_.keep(first, count, facing);
  if (kept.count == 0) return 0;
  for (auto* lit : {&r_, &g_, &b_})
    if (lit->size() < shading_->r.size()) lit->resize(shading_->r.size());
  std::copy_n(material.baseColour.begin(), 3, by_.base);
  std::copy_n(material.emissive.begin(), 3, by_.emissive);
  const VerticesToShade vertices{shading_->nx.data(), shading_->ny.data(), shading_->nz.data(),
                                 shading_->r.data(),  shading_->g.data(),  shading_->b.data()};
  const PictureVertices out{culler_.x(), culler_.y(), culler_.nearness(), r_.data(), g_.data(), b_.data()};
  kernels_.shade(vertices, firstVertex, endVertex, by_, out);
  const float sign = facing == Facing::Both ? 0 : facing == Facing::Clockwise ? -1 : 1;
  kernels_.draw(culler_.kept().data() + kept.first, kept.count / 3, out, sign, target_);
  return kept.count / 3;
}

}  // namespace stadion
