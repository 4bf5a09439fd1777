#pragma once
/// Earlier spellings of options. Each is an error that names the present spelling.

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace stadion {

struct RetiredSpelling {
  std::string_view commands;  ///< "run|cluster"; "bench walls" is one command
  std::string_view option;
  std::string_view value;  ///< only with such a value; empty: with any. See kinds in retired_spellings.cpp
  std::string_view now;    ///< the present spelling
};

std::span<const RetiredSpelling> retiredSpellings();

/// Looks for an earlier spelling in the words after the program's name. Returns the message, if there is one.
std::optional<std::string> retiredSpellingIn(std::span<const std::string> words);

}  // namespace stadion
