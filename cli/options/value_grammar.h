#pragma once
/// What an option's value may be. All values of the command line are checked and read here.
///
/// Errors  a mistake names the value and what is allowed: "60Hz" is not a number from 1 to 1000.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace stadion {

enum class OptionValueKind : std::uint8_t {
  Flag,    ///< no value
  Text,    ///< any text but the empty one
  File,    ///< a path
  Folder,  ///< a path of a folder
  Word,    ///< one of `words`
  Whole,   ///< a whole number, or one of `words`
  Number,  ///< a finite decimal number, or one of `words`
  Size,    ///< WIDTHxHEIGHT; each side from `least` to `most`
  Frames,  ///< A..B, both included
};

enum class ValueTimes : std::uint8_t {
  Once,
  Repeated,  ///< the option may be repeated, with one value each time
  Several,   ///< one or more values follow the option, which may be repeated
  List,      ///< values between commas
};

struct ValueGrammar {
  OptionValueKind kind = OptionValueKind::Flag;
  std::string_view shape{};  ///< how help names a value: "FILE", "HZ"
  double least = 0, most = 0;
  std::string_view words{};  ///< "pair|off"
  ValueTimes times = ValueTimes::Once;
  unsigned count = 1;  ///< values after each option

  /// Says what is wrong with a value. Empty if it is allowed.
  std::string mistakeIn(std::string_view text) const;
  bool allows(std::string_view text) const { return mistakeIn(text).empty(); }
  /// What may stand in its place: "HZ", "pair|off", "last|all|none|N".
  std::string notation() const;
  /// The limits of numbers and sizes: "1 to 1000". Empty if there are none.
  std::string limits() const;
};

/// A decimal number and nothing else, such as "-1.5e3".
std::optional<double> readDecimal(std::string_view text);
/// A whole decimal number without a sign and nothing else.
std::optional<std::uint64_t> readWhole(std::string_view text);
/// "A..B", both included; A is not greater than B.
std::optional<std::pair<std::uint64_t, std::uint64_t>> readFrames(std::string_view text);

/// Whether a word is one of those between the bars.
bool hasWord(std::string_view words, std::string_view word);

}  // namespace stadion
