#pragma once
/// From the text of a value to numbers and words.

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace stadion {

/// Why a value cannot be read, and where in its text.
struct ValueError {
  std::size_t offset = 0;
  std::string message;
};

/// Up to seven numbers, which is the most that a value of the language has.
struct NumberList {
  std::array<double, 7> value{};
  std::size_t count = 0;
  std::array<std::size_t, 7> offset{};  ///< offset of each number in the text
};

/// Numbers separated by blanks, by commas, or by both. `what` names the value in messages.
std::optional<ValueError> readNumbers(std::string_view text, NumberList& numbers, const std::string& what,
                                      const std::string& form);

std::optional<bool> readFlag(std::string_view text);

/// A part of a text between separators, without blanks at both ends.
struct Piece {
  std::string_view text;
  std::size_t offset = 0;  ///< in the whole text
};

/// Takes the part before the next `separator` off `rest`, whose place in the whole text is kept in `offset`.
Piece takeUntil(char separator, std::string_view& rest, std::size_t& offset);
/// Takes the next word (no blanks) off `rest`; empty if there is none.
Piece takeWord(std::string_view& rest, std::size_t& offset);

/// The first 40 bytes or so of a text, for messages: whole characters, "..." if it was cut.
std::string shortened(std::string_view text);
/// Says where the text has a character that cannot be seen, and which (engine/unicode/characters.h).
std::optional<ValueError> hiddenCharacter(std::string_view text);

}  // namespace stadion
