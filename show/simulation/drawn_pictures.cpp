#include "show/simulation/drawn_pictures.h"

#include "pipeline/projection/hall_pictures.h"

namespace stadion {
namespace {

class DrawnPictures final : public PictureSource {
public:
  explicit DrawnPictures(std::unique_ptr<HallPictures> pictures) : pictures_(std::move(pictures)) {}

  std::vector<Picture> draw(std::size_t entry, const Pose& X_RH, const Painter& paint) override {
    return pictures_->draw(entry, X_RH, [&](const PaintedView& view, Picture& picture) {
      paint({view.clipFromRig, view.eye}, picture);
    });
  }

private:
  std::unique_ptr<HallPictures> pictures_;
};

}  // namespace

Result<std::unique_ptr<PictureSource>> drawnPictures(const WallFile& hall) {
  // A table and its display together have the light that the wall file states: this is what the simulator assumes of
  // a display alone.
  WallFile withoutTables = hall;
  for (WallEntry& entry : withoutTables.walls)
    if (entry.projector) entry.projector->lut.reset();
  auto pictures = HallPictures::create(withoutTables);
  if (!pictures) return pictures.error();
  return std::unique_ptr<PictureSource>(std::make_unique<DrawnPictures>(std::move(pictures.value())));
}

}  // namespace stadion
