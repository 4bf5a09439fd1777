#include "pipeline/picture/contact_sheet.h"

#include "pipeline/picture/lettering.h"
#include "pipeline/picture/linear_light.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace stadion {
namespace {

constexpr std::uint32_t kGap = 6;  ///< between cells [pixels]
constexpr std::uint32_t kLabel = kLetterHeight + 4;
constexpr std::array<std::uint8_t, 3> kInk{225, 225, 225};
constexpr std::uint8_t kPaper = 24;

/// The old pixels that a new one covers, and the covered part of each, in units of 1/new of an old pixel.
struct Cover {
  std::uint32_t first = 0;
  std::vector<std::uint64_t> weights;
};

/// New pixel i covers [i old, (i + 1) old) where old pixel k covers [k new, (k + 1) new): whole numbers,
/// exact.
std::vector<Cover> covers(std::uint32_t oldSize, std::uint32_t newSize) {
  std::vector<Cover> all(newSize);
  for (std::uint64_t i = 0; i < newSize; ++i) {
    const std::uint64_t begin = i * oldSize, end = begin + oldSize;
    Cover& c = all[i];
    c.first = static_cast<std::uint32_t>(begin / newSize);
    for (std::uint64_t k = c.first; k * newSize < end; ++k)
      c.weights.push_back(std::min(end, (k + 1) * newSize) - std::max(begin, k * newSize));
  }
  return all;
}

void average(const Picture& from, const Cover& cx, const Cover& cy, std::uint8_t* to) {
  std::array<std::uint64_t, 4> sum{};
  std::uint64_t total = 0;
  for (std::size_t j = 0; j < cy.weights.size(); ++j)
    for (std::size_t i = 0; i < cx.weights.size(); ++i) {
      const std::uint64_t weight = cx.weights[i] * cy.weights[j];
      const std::uint8_t* p =
          from.at(cx.first + static_cast<std::uint32_t>(i), cy.first + static_cast<std::uint32_t>(j));
      for (std::size_t c = 0; c < 3; ++c) sum[c] += weight * linearFromSrgb(p[c]);
      sum[3] += weight * p[3];
      total += weight;
    }
  for (std::size_t c = 0; c < 3; ++c)
    to[c] = srgbFromLinear(static_cast<std::uint32_t>((sum[c] + total / 2) / total));
  to[3] = static_cast<std::uint8_t>((sum[3] + total / 2) / total);
}

struct Cell {
  std::uint32_t width = 0, height = 0;
};

/// Returns the shown size of a picture: in the proportions of its wall, with neither side enlarged.
Cell shownSize(const Picture& picture, double aspect, std::uint32_t cellWidth) {
  const double own = double(picture.width) / picture.height;
  if (!(aspect > 0)) aspect = own;
  const double width = std::min({double(cellWidth), double(picture.width), picture.height * aspect});
  const auto pixels = [](double side) { return std::max(1u, static_cast<std::uint32_t>(side + 0.5)); };
  return {pixels(width), pixels(width / aspect)};
}

Cell cellOf(const WallPictures& wall, std::uint32_t cellWidth) {
  Cell cell{std::min(cellWidth, 8 * kLetterWidth), 0};
  for (const Picture* p : {wall.left, wall.right}) {
    if (!p || p->empty()) continue;
    const Cell shown = shownSize(*p, wall.aspect, cellWidth);
    cell = {std::max(cell.width, shown.width), std::max(cell.height, shown.height)};
  }
  return cell;
}

void place(Picture& sheet, const Picture& picture, const Cell& shown, std::uint32_t x, std::uint32_t y) {
  const Picture small = resized(picture, shown.width, shown.height);
  for (std::uint32_t row = 0; row < shown.height; ++row) {
    std::copy_n(small.at(0, row), std::size_t(shown.width) * 4, sheet.at(x, y + row));
    for (std::uint32_t column = 0; column < shown.width; ++column) sheet.at(x + column, y + row)[3] = 255;
  }
}

}  // namespace

Picture resized(const Picture& picture, std::uint32_t width, std::uint32_t height) {
  if (picture.empty() || width == 0 || height == 0) return {};
  if (picture.width == width && picture.height == height) return picture;
  const std::vector<Cover> columns = covers(picture.width, width), rows = covers(picture.height, height);
  Picture out(width, height);
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x) average(picture, columns[x], rows[y], out.at(x, y));
  return out;
}

Picture contactSheet(std::span<const WallPictures> walls, std::uint64_t frame, std::uint32_t cellWidth) {
  std::vector<Cell> cells;
  std::uint32_t width = kGap, cellHeight = 0, rows = 1;
  for (const WallPictures& wall : walls) {
    cells.push_back(cellOf(wall, std::max(cellWidth, 1u)));
    width += cells.back().width + kGap;
    cellHeight = std::max(cellHeight, cells.back().height);
    if (wall.right) rows = 2;
  }
  const std::uint32_t rowHeight = cellHeight + kLabel + kGap;
  Picture sheet(width, kGap + rows * rowHeight, kPaper);
  for (std::size_t i = 3; i < sheet.rgba.size(); i += 4) sheet.rgba[i] = 255;

  std::uint32_t x = kGap;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    for (std::uint32_t row = 0; row < rows; ++row) {
      const std::uint32_t y = kGap + row * rowHeight;
      const Picture* picture = row == 0 ? walls[i].left : walls[i].right;
      // Letters beyond the cell would overlap the next one.
      std::string label = fmt::format("{} {} {}", walls[i].wall, row == 0 ? "L" : "R", frame);
      label.resize(std::min<std::size_t>(label.size(), cells[i].width / kLetterWidth));
      letter(sheet, x, y, label, kInk);
      if (picture && !picture->empty())
        place(sheet, *picture, shownSize(*picture, walls[i].aspect, std::max(cellWidth, 1u)), x, y + kLabel);
    }
    x += cells[i].width + kGap;
  }
  return sheet;
}

}  // namespace stadion
