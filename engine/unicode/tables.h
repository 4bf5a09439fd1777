#pragma once
/// Tables of the Unicode Character Database (tables.py makes them), sorted by code point.
///
/// Threads  constants.

#include <array>
#include <span>

namespace stadion::unicode {

struct Range {
  char32_t first, last;
};
/// A letter, and the one that stands for all that look like it.
struct Alike {
  char32_t letter, shown;
};
/// A letter with accents, and the same in pieces, in canonical order; 0 after the last one.
struct Composition {
  char32_t whole;
  std::array<char32_t, 4> parts;
};
struct CharacterName {
  char32_t code;
  const char* name;
};

extern const std::span<const Range> kBlanks;   ///< empty, but as wide as a letter; not the ASCII blank
extern const std::span<const Range> kNothing;  ///< no sign at all: ignorable, format and control characters
/// Viramas of Indic scripts: they join the consonants around them.
extern const std::span<const Range> kViramas;
extern const std::span<const Range> kMarks;  ///< stand above, below or around the letter before
extern const std::span<const Range> kWide;   ///< twice as wide as a Latin letter in a terminal
extern const std::span<const Alike> kAlike;
extern const std::span<const Composition> kComposed;
extern const std::span<const CharacterName> kNames;

}  // namespace stadion::unicode
