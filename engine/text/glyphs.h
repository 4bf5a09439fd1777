#pragma once
/// Stadion's letters: strokes of even width, as Greek stonecutters drew them. Latin letters and the accents
/// of western Europe, Greek capitals, digits of equal width, punctuation.
///
/// Units    hundredths of the height of a capital; x to the right from the glyph's left edge, y up from the
///          line on which letters stand.
/// Threads  constant data.

#include <cstdint>
#include <string_view>
#include <vector>

namespace stadion {

constexpr double kStrokeWidth = 14;  ///< width of every stroke [hundredths]
constexpr double kLineHeight = 160;  ///< from line to line [hundredths]
constexpr double kDescent = 32;      ///< how far letters reach below the line [hundredths]

/// How a character is drawn: `path` describes the middle of its strokes.
///
///   Mx y       a stroke begins           Lx y   a straight line to x, y
///   Acx cy rx ry from to                 an arc of an ellipse about cx, cy, from and to in degrees, counted
///                                        counter-clockwise from the right; it begins a stroke or goes on
///   Z          back to the beginning     ;      the stroke ends     Dx y   a dot about x, y
///
/// Straight ends that lean are cut level, so that A and V stand on the line.
struct Glyph {
  char32_t character = 0;
  double advance = 0;  ///< to the next glyph
  std::string_view path;
  char32_t mark = 0;  ///< the accent above or below it, a combining character; 0 = none
};

/// Null if the font has no such character.
const Glyph* findGlyph(char32_t character);

/// An accent, drawn about x = 0, for small letters; above capitals it is moved up by kMarkRise.
std::string_view pathOfMark(char32_t mark);
constexpr double kMarkRise = 30;

/// A character as it is drawn: which glyph, and which accent.
struct DrawnCharacter {
  const Glyph* glyph = nullptr;
  char32_t mark = 0;
  bool raised = false;   ///< the accent stands above a capital
  bool missing = false;  ///< the font lacks it
};
DrawnCharacter drawn(char32_t character);

/// How much closer than their advance says two characters stand (negative), such as A and V.
double kerning(const Glyph& left, const Glyph& right);

/// Returns the characters of a UTF-8 text. Invalid bytes become U+FFFD.
std::vector<char32_t> charactersOf(std::string_view utf8);
/// Returns the characters of a text that the font lacks, each once, in the order of the text. Line ends are
/// no characters.
std::vector<char32_t> missingFrom(std::string_view utf8);

}  // namespace stadion
