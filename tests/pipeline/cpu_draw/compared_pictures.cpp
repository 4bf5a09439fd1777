#include "tests/pipeline/cpu_draw/compared_pictures.h"

#include "engine/maths/srgb.h"
#include "pipeline/cpu_draw/kernels/choose_kernels.h"

#include <gtest/gtest.h>

#include <cmath>

namespace stadion::test {

PictureDifference difference(const Picture& a, const Picture& b) {
  PictureDifference d;
  std::size_t alike = 0, channels = 0;
  for (std::size_t i = 0; i < a.rgba.size(); ++i) {
    if (i % 4 == 3) continue;
    const int by = std::abs(int{a.rgba[i]} - int{b.rgba[i]});
    d.mean += by, d.most = std::max(d.most, by), alike += by <= 8;
    ++channels;
  }
  d.mean /= static_cast<double>(channels),
      d.alike = static_cast<double>(alike) / static_cast<double>(channels);
  return d;
}

Picture drawnByCpu(const MeshStore& meshes, const DrawList& list, std::uint32_t width, std::uint32_t height,
                   const PictureRung& rung, std::size_t threads, const DrawKernels* kernels,
                   std::uint32_t view) {
  DrawPool pool(threads);
  CpuRoom room(meshes, rung.look, pool, kernels ? *kernels : bestDrawKernels());
  auto renderer = CpuRenderer::create(room, width, height, rung);
  EXPECT_TRUE(renderer);
  const auto drawn = renderer.value()->draw(list);
  EXPECT_FALSE(drawn) << drawn->message;
  Picture picture{width, height, std::vector<std::uint8_t>(std::size_t{width} * height * 4)};
  EXPECT_FALSE(renderer.value()->read(view, picture.rgba));
  return picture;
}

Picture drawnByOpenGl(const MeshStore& meshes, const DrawList& list, std::uint32_t width,
                      std::uint32_t height, const RenderQuality& quality, std::uint32_t view) {
  return Stage(meshes, width, height, GlProviderKind::OsMesa, quality).draw(list, view);
}

namespace {

/// The projection of pictures that lie (x, y) pixels to the right and up.
Mat4 movedProjection(const Mat4& projection, double x, double y, std::uint32_t width, std::uint32_t height) {
  Mat4 by = Mat4::Identity();
  by(0, 3) = -2 * x / width, by(1, 3) = -2 * y / height;
  return by * projection;
}

void addLinearLight(const Picture& picture, std::vector<double>& sums) {
  for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += linearFromSrgb(picture.rgba[i] / 255.0);
}

}  // namespace

Picture referencePicture(const MeshStore& meshes, DrawList list, std::uint32_t width, std::uint32_t height,
                         int side, std::uint32_t view) {
  DrawPool pool(1);
  CpuRoom room(meshes, Look::Full, pool);
  PictureRung rung;
  rung.samples = 1;
  auto renderer = CpuRenderer::create(room, width, height, rung);
  Picture picture{width, height, std::vector<std::uint8_t>(std::size_t{width} * height * 4)};
  std::vector<double> sums(picture.rgba.size());
  const Mat4 projection = list.views[view].projection;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const auto part = [&](int i) { return (i + 0.5) / side - 0.5; };
      list.views[view].projection = movedProjection(projection, part(x), part(y), width, height);
      EXPECT_FALSE(renderer.value()->draw(list));
      EXPECT_FALSE(renderer.value()->read(view, picture.rgba));
      addLinearLight(picture, sums);
    }
  for (std::size_t i = 0; i < sums.size(); ++i)
    picture.rgba[i] = static_cast<std::uint8_t>(std::lround(255 * srgbFromLinear(sums[i] / (side * side))));
  return picture;
}

}  // namespace stadion::test
