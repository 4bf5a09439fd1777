#pragma once
/// Characters of UTF-8 text: invisible ones, and ones that look alike.
///
/// A *hidden* character leaves no mark or only a gap: ignorable, format and control characters and all blanks
/// but those of ASCII. In a name it is a mistake that cannot be seen. Only the joiners U+200C and U+200D may
/// stand in words, where their script needs them: between letters of Arabic and its relatives, and after the
/// virama of an Indic script.
///
/// Text     well-formed UTF-8; an invalid byte counts as one character with the code U+FFFD.
/// Threads  no state.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace stadion::unicode {

/// The character that `text` begins with, which is not empty, and the bytes that it takes.
char32_t firstCharacter(std::string_view text, std::size_t& bytes);
void append(std::string& text, char32_t code);

bool isHidden(char32_t code);
/// Where the first hidden character of a word is [bytes]; nothing if it has none.
std::optional<std::size_t> hiddenIn(std::string_view word);

std::string withoutHidden(std::string_view text);

/// "U+200B ZERO WIDTH SPACE", or the number alone if its name is not known here.
std::string nameOf(char32_t code);
/// Returns the name of the character that `text` begins with.
std::string nameOfFirst(std::string_view text);

/// Returns the look of a word: letters that look alike replaced by one of them, accents separated from their
/// letters, and without invisible characters. Words that look alike have the same skeleton.
std::string skeleton(std::string_view word);
/// How two words differ that look alike: "U+0430 CYRILLIC SMALL LETTER A stands for U+0061 LATIN SMALL LETTER
/// A".
std::string differenceOf(std::string_view word, std::string_view other);

/// How many columns of a terminal it takes: 0, 1 or 2.
unsigned columnsOf(char32_t code);
/// The text for a message: what is hidden, above ASCII, is shown by its number, "<U+200B>".
std::string withHiddenShown(std::string_view text);

}  // namespace stadion::unicode
