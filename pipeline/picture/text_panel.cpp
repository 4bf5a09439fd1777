#include "pipeline/picture/text_panel.h"

#include "pipeline/picture/lettering.h"

#include <algorithm>

namespace stadion {
namespace {

constexpr std::uint32_t kMargin = 4;   ///< points
constexpr std::uint32_t kLineGap = 2;  ///< between lines, points
constexpr std::uint8_t kPanelGround = 12, kGroundAlpha = 190;

std::vector<PanelLine> broken(const std::vector<PanelLine>& lines, std::size_t most) {
  std::vector<PanelLine> out;
  for (const PanelLine& line : lines)
    for (std::size_t at = 0; at == 0 || at < line.text.size(); at += most)
      out.push_back({line.text.substr(at, most), line.colour});
  return out;
}

}  // namespace

Picture textPanel(const std::vector<PanelLine>& lines, std::uint32_t mostWidth, std::uint32_t scale) {
  const std::uint32_t room = mostWidth > 2 * kMargin * scale ? mostWidth - 2 * kMargin * scale : 0;
  const std::vector<PanelLine> shown = broken(lines, std::max(1u, room / (kLetterWidth * scale)));
  std::size_t longest = 1;
  for (const PanelLine& l : shown) longest = std::max(longest, l.text.size());
  const std::uint32_t step = (kLetterHeight + kLineGap) * scale;
  Picture panel(static_cast<std::uint32_t>(longest) * kLetterWidth * scale + 2 * kMargin * scale,
                static_cast<std::uint32_t>(shown.size()) * step + 2 * kMargin * scale, kPanelGround);
  for (std::size_t i = 3; i < panel.rgba.size(); i += 4) panel.rgba[i] = kGroundAlpha;
  std::uint32_t y = kMargin * scale;
  for (const PanelLine& l : shown) {
    letter(panel, kMargin * scale, y, l.text, l.colour, scale);
    y += step;
  }
  return panel;
}

}  // namespace stadion
