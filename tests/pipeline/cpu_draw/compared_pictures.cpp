#include "tests/pipeline/cpu_draw/compared_pictures.h"

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

}  // namespace stadion::test
