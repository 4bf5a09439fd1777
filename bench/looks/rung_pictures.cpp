#include "bench/looks/rung_pictures.h"

#include "bench/looks/open_gl_pictures.h"
#include "engine/maths/srgb.h"

#include <array>
#include <cmath>
#include <ctime>

namespace stadion::bench {
namespace {

constexpr int kReferenceSide = 8;  ///< samples of a pixel in each axis

double processorMs(clockid_t clock) {
  timespec t{};
  clock_gettime(clock, &t);
  return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

/// The projection of pictures that lie (x, y) pixels to the right and up.
Mat4 movedProjection(const Mat4& projection, double x, double y, PixelSize size) {
  Mat4 by = Mat4::Identity();
  by(0, 3) = -2 * x / size.width;
  by(1, 3) = -2 * y / size.height;
  return by * projection;
}

/// The list with all views moved by sample number (x, y) of a pixel's grid.
DrawList movedList(const DrawList& list, int x, int y, PixelSize size) {
  const auto part = [](int i) { return (i + 0.5) / kReferenceSide - 0.5; };
  DrawList moved = list;
  for (std::uint32_t v = 0; v < list.viewCount; ++v)
    moved.views[v].projection = movedProjection(list.views[v].projection, part(x), part(y), size);
  return moved;
}

/// Sums of pictures in linear light, in whole numbers, so that their order does not matter.
class LightSum {
public:
  explicit LightSum(std::size_t bytes) : sums_(bytes) {
    for (std::size_t i = 0; i < kLinear; ++i)
      linear_[i] =
          static_cast<std::uint32_t>(std::lround(kScale * linearFromSrgb(static_cast<double>(i) / 255)));
  }
  void add(const Picture& picture) {
    for (std::size_t i = 0; i < sums_.size(); ++i) sums_[i] += linear_[picture.rgba[i]];
  }
  Picture mean(PixelSize size, int count) const {
    Picture picture(size.width, size.height);
    for (std::size_t i = 0; i < sums_.size(); ++i)
      picture.rgba[i] =
          static_cast<std::uint8_t>(std::lround(255 * srgbFromLinear(sums_[i] / (kScale * count))));
    return picture;
  }

private:
  static constexpr std::size_t kLinear = 256;
  static constexpr double kScale = 1 << 24;  // 64 of them fit

  std::array<std::uint32_t, kLinear> linear_{};
  std::vector<std::uint32_t> sums_;
};

}  // namespace

Result<std::unique_ptr<RungPictures>> RungPictures::create(const MeshStore& meshes, PixelSize size,
                                                           std::optional<GlProviderKind> openGl) {
  std::unique_ptr<RungPictures> made(new RungPictures(meshes, size));
  if (openGl) {
    auto pictures = OpenGlPictures::create(meshes, size, *openGl);
    if (!pictures) return pictures.error();
    made->openGl_ = std::move(pictures.value());
  }
  return Result<std::unique_ptr<RungPictures>>(std::move(made));
}

RungPictures::RungPictures(const MeshStore& meshes, PixelSize size) : meshes_(meshes), size_(size) {}
RungPictures::~RungPictures() = default;

Result<CpuRenderer*> RungPictures::rendererOf(const PictureRung& rung) {
  LookRoom& look = rung.look == Look::Full ? full_ : plain_;
  if (!look.renderer) {
    look.room = std::make_unique<CpuRoom>(meshes_, rung.look, pool_);
    auto made = CpuRenderer::create(*look.room, size_.width, size_.height, rung);
    if (!made) return made.error();
    look.renderer = std::move(made.value());
  }
  look.renderer->setRung(rung);
  return look.renderer.get();
}

Result<DrawnViews> RungPictures::drawWith(Renderer& renderer, const DrawList& list, int clock) const {
  DrawnViews drawn;
  const double began = processorMs(clock);
  if (const auto wrong = renderer.draw(list, {}, nullptr)) return *wrong;
  drawn.ms = (processorMs(clock) - began) / list.viewCount;
  for (std::uint32_t view = 0; view < list.viewCount; ++view) {
    Picture& picture = drawn.views.emplace_back(size_.width, size_.height);
    if (const auto wrong = renderer.read(view, picture.rgba)) return *wrong;
  }
  return drawn;
}

Result<DrawnViews> RungPictures::draw(const DrawList& list, const NamedRung& rung) {
  if (!rung.rung) return drawWith(openGl_->renderer(), list, CLOCK_PROCESS_CPUTIME_ID);
  const auto renderer = rendererOf(*rung.rung);
  if (!renderer) return renderer.error();
  return drawWith(*renderer.value(), list, CLOCK_THREAD_CPUTIME_ID);
}

Result<std::vector<Picture>> RungPictures::reference(const DrawList& list) {
  const auto renderer = rendererOf(PictureRung{.samples = 1});
  if (!renderer) return renderer.error();
  std::vector<LightSum> sums(list.viewCount, LightSum(std::size_t{size_.width} * size_.height * 4));
  for (int y = 0; y < kReferenceSide; ++y)
    for (int x = 0; x < kReferenceSide; ++x) {
      const auto drawn = drawWith(*renderer.value(), movedList(list, x, y, size_), CLOCK_THREAD_CPUTIME_ID);
      if (!drawn) return drawn.error();
      for (std::uint32_t v = 0; v < list.viewCount; ++v) sums[v].add(drawn.value().views[v]);
    }
  std::vector<Picture> pictures;
  for (const LightSum& sum : sums) pictures.push_back(sum.mean(size_, kReferenceSide * kReferenceSide));
  return pictures;
}

}  // namespace stadion::bench
