#include "show/adjust/adjust_pictures.h"

#include "pipeline/picture/lettering.h"
#include "pipeline/picture/sketch.h"

#include <algorithm>

namespace stadion {
namespace {

constexpr Sketch::Colour kMark{255, 60, 200}, kText{255, 255, 255}, kBack{20, 20, 24};
constexpr std::uint32_t kLettersAcross = 90;  ///< of a picture's width, in a line of text

std::vector<std::string> stateLines(const std::string& state) {
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin <= state.size();) {
    const std::size_t end = std::min(state.find("; ", begin), state.size());
    lines.push_back(state.substr(begin, end - begin));
    begin = end + 2;
  }
  return lines;
}

/// Writes the state where no pin and no edge is.
void writeState(Sketch& sketch, const std::string& state) {
  Picture& picture = sketch.picture();
  const std::uint32_t scale = std::max(1u, picture.width / (kLettersAcross * kLetterWidth));
  std::uint32_t y = picture.height * 2 / 5;
  for (const std::string& line : stateLines(state)) {
    const auto width = static_cast<std::uint32_t>(line.size()) * kLetterWidth * scale;
    const std::uint32_t x = picture.width > width ? (picture.width - width) / 2 : 0;
    sketch.fill(x > 4 ? x - 4 : 0, y > 4 ? y - 4 : 0, width + 8, kLetterHeight * scale + 8, kBack);
    letter(picture, x, y, line, kText, scale);
    y += (kLetterHeight + 3) * scale + 2;
  }
}

void markPin(Sketch& sketch, const Vec2& at) {
  const double arm = 0.05 * sketch.height();
  sketch.line(at - Vec2(arm, 0), at + Vec2(arm, 0), kMark, 3);
  sketch.line(at - Vec2(0, arm), at + Vec2(0, arm), kMark, 3);
}

void markEdge(Sketch& sketch, PictureEdge edge, double share) {
  const double w = sketch.width(), h = sketch.height();
  const bool across = edge == PictureEdge::Left || edge == PictureEdge::Right;
  const bool from = edge == PictureEdge::Left || edge == PictureEdge::Top;
  const double place = (from ? share : 1 - share) * (across ? w : h);
  const double inside = std::clamp(place, 1.0, (across ? w : h) - 2);
  if (across)
    sketch.line({inside, 0}, {inside, h - 1}, kMark, 3);
  else
    sketch.line({0, inside}, {w - 1, inside}, kMark, 3);
}

}  // namespace

Result<std::unique_ptr<AdjustPictures>> AdjustPictures::create(const WallFile& hall, HallPattern pattern,
                                                               bool stereo) {
  auto patterns = HallPatterns::create(hall, stereo);
  if (!patterns) return patterns.error();
  return std::unique_ptr<AdjustPictures>(
      new AdjustPictures(std::move(patterns.value()), pattern, hall.walls.size()));
}

void AdjustPictures::change(const WallFile& hall, std::size_t entry) {
  const auto& own = hall.walls[entry].projector;
  if (!own) return;  // the output bends a flat wall's picture
  std::erase(stale_, entry);
  stale_.push_front(entry);
  for (std::size_t i = 0; i < hall.walls.size(); ++i) {
    const auto& other = hall.walls[i].projector;
    if (i == entry || !other || other->screen != own->screen || std::ranges::find(stale_, i) != stale_.end())
      continue;
    stale_.push_back(i);
  }
}

std::optional<std::size_t> AdjustPictures::refresh(const WallFile& hall) {
  if (stale_.empty()) return std::nullopt;
  const std::size_t entry = stale_.front();
  stale_.pop_front();
  patterns_->change(hall, entry);
  plain_[entry].clear();
  return entry;
}

std::vector<Picture> AdjustPictures::pictures(const HallAdjuster& adjuster, std::size_t entry,
                                              std::uint32_t width, std::uint32_t height) {
  const WallEntry& e = adjuster.hall().walls[entry];
  std::vector<Picture>& plain = plain_[entry];
  const bool fits = !plain.empty() && (!e.isFlat() || (plain[0].width == width && plain[0].height == height));
  if (!fits) plain = patterns_->pictures(entry, pattern_, width, height);
  if (entry != adjuster.chosen()) return plain;
  std::vector<Picture> marked;
  for (const Picture& picture : plain) {
    Sketch sketch(picture);
    if (const auto edge = adjuster.edge())
      markEdge(sketch, *edge, e.projector->blend.edges[static_cast<std::size_t>(*edge)]);
    if (const auto pin = adjuster.pin(); pin && adjuster.pins()) {
      // The corner of a flat wall's picture is where the output shows its pin.
      constexpr double kCorners[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
      const Vec2 share = e.projector ? (*adjuster.pins())[*pin] : Vec2(kCorners[*pin][0], kCorners[*pin][1]);
      markPin(sketch, {share.x() * (sketch.width() - 1), share.y() * (sketch.height() - 1)});
    }
    writeState(sketch, adjuster.state());
    marked.push_back(sketch.take());
  }
  return marked;
}

}  // namespace stadion
