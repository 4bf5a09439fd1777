#pragma once
/// Combines the pictures of both eyes into the picture that a screen shows.
///
/// Threads  pure functions.
/// Errors   for eyes of different sizes it returns the empty picture.

#include "pipeline/picture/picture.h"

#include <string_view>

namespace stadion {

enum class StereoLayout {
  Pair,        ///< two pictures, left and right
  SideBySide,  ///< twice as wide, left eye on the left
  TopBottom,   ///< twice as high, left eye on top
  Anaglyph,    ///< red-cyan glasses: red is the left eye's luminance, green and blue are the right eye's
  Interlaced,  ///< even rows (from the top, from 0) left, odd ones right
  Off          ///< one eye only, from the middle between the eyes
};

/// "pair", "side-by-side", "top-bottom", "anaglyph", "interlaced", "off".
std::optional<StereoLayout> stereoLayout(std::string_view name);
const char* stereoLayoutName(StereoLayout layout);
/// The names that stereoLayout() knows, for messages.
std::vector<std::string> stereoLayoutNames();

/// Returns the number of drawn eyes: 1 for Off, else 2.
constexpr std::uint32_t eyeCount(StereoLayout layout) {
  return layout == StereoLayout::Off ? 1 : 2;
}
/// Returns true if the eyes stay separate pictures (or one, for Off) instead of being composed.
constexpr bool keepsEyesApart(StereoLayout layout) {
  return layout == StereoLayout::Pair || layout == StereoLayout::Off;
}

/// Returns the composed picture. For Pair and Off it is the left eye's.
Picture compose(StereoLayout layout, const Picture& left, const Picture& right);

}  // namespace stadion
