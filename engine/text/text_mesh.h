#pragma once
/// Text as a mesh: letters of triangles, which every sample of a pixel smooths as it does any edge, alike on
/// all walls and for both eyes.
///
/// Frames   the text runs along +X, upright along +Z, for a reader who looks along +Y. The first line stands
///          on the origin; further lines lie below it.
/// Threads  pure functions.

#include "engine/asset/mesh.h"

#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace stadion {

enum class TextAlign : std::uint8_t { Left, Centre, Right };  ///< text: align

struct TextStyle {
  double size = 0.5;                     ///< height of a capital [m]
  double depth = 0;                      ///< depth of the letters, away from the reader [m]; 0 = flat
  std::array<float, 3> colour{1, 1, 1};  ///< linear
  std::optional<std::array<float, 3>> background{};  ///< colour of a board behind the letters, linear
  TextAlign align = TextAlign::Centre;
  bool lit = false;  ///< lit like any surface; else it shows its colour in any light
};

constexpr std::size_t kLongestWords = 1000;  ///< [bytes]

/// The letters, and the board behind them if there is one; null if there is nothing to draw. What goes beyond
/// kLongestWords is left out.
std::unique_ptr<Mesh> textMesh(std::string_view utf8, const TextStyle& style);

/// With every "\n" turned into an end of line, and every "\," into a comma.
std::string unescaped(std::string_view text);

}  // namespace stadion
