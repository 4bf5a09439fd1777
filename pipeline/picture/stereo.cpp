#include "pipeline/picture/stereo.h"

#include "pipeline/picture/linear_light.h"

#include <algorithm>

namespace stadion {
namespace {

struct LayoutName {
  StereoLayout layout;
  const char* name;
};
constexpr LayoutName kLayouts[] = {{StereoLayout::Pair, "pair"},
                                   {StereoLayout::SideBySide, "side-by-side"},
                                   {StereoLayout::TopBottom, "top-bottom"},
                                   {StereoLayout::Anaglyph, "anaglyph"},
                                   {StereoLayout::Interlaced, "interlaced"},
                                   {StereoLayout::Off, "off"}};

void copyRow(const Picture& from, std::uint32_t row, Picture& to, std::uint32_t x, std::uint32_t y) {
  std::copy_n(from.at(0, row), std::size_t(from.width) * 4, to.at(x, y));
}

Picture sideBySide(const Picture& left, const Picture& right) {
  Picture out(left.width * 2, left.height);
  for (std::uint32_t y = 0; y < left.height; ++y) {
    copyRow(left, y, out, 0, y);
    copyRow(right, y, out, left.width, y);
  }
  return out;
}

Picture topBottom(const Picture& left, const Picture& right) {
  Picture out(left.width, left.height * 2);
  for (std::uint32_t y = 0; y < left.height; ++y) {
    copyRow(left, y, out, 0, y);
    copyRow(right, y, out, 0, left.height + y);
  }
  return out;
}

Picture interlaced(const Picture& left, const Picture& right) {
  Picture out(left.width, left.height);
  for (std::uint32_t y = 0; y < left.height; ++y) copyRow(y % 2 == 0 ? left : right, y, out, 0, y);
  return out;
}

/// Luminance instead of the red channel alone: pure greens and blues are then not black for the left eye.
std::uint8_t luminance(const std::uint8_t* p) {
  const std::uint64_t light =
      2126ull * linearFromSrgb(p[0]) + 7152ull * linearFromSrgb(p[1]) + 722ull * linearFromSrgb(p[2]);
  return srgbFromLinear(static_cast<std::uint32_t>((light + 5000) / 10000));
}

Picture anaglyph(const Picture& left, const Picture& right) {
  Picture out = right;
  for (std::size_t i = 0; i < out.rgba.size(); i += 4) out.rgba[i] = luminance(&left.rgba[i]);
  return out;
}

}  // namespace

std::optional<StereoLayout> stereoLayout(std::string_view name) {
  for (const LayoutName& n : kLayouts)
    if (name == n.name) return n.layout;
  return std::nullopt;
}

const char* stereoLayoutName(StereoLayout layout) {
  for (const LayoutName& n : kLayouts)
    if (layout == n.layout) return n.name;
  return "";
}

std::vector<std::string> stereoLayoutNames() {
  std::vector<std::string> names;
  for (const LayoutName& n : kLayouts) names.emplace_back(n.name);
  return names;
}

Picture compose(StereoLayout layout, const Picture& left, const Picture& right) {
  if (keepsEyesApart(layout)) return left;
  if (!left.sameSize(right)) return {};
  switch (layout) {
  case StereoLayout::SideBySide: return sideBySide(left, right);
  case StereoLayout::TopBottom: return topBottom(left, right);
  case StereoLayout::Anaglyph: return anaglyph(left, right);
  case StereoLayout::Interlaced: return interlaced(left, right);
  case StereoLayout::Pair:
  case StereoLayout::Off: break;
  }
  return left;
}

}  // namespace stadion
