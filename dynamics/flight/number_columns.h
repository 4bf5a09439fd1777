#pragma once
/// Comma-separated numbers under a row of names, as references and tables of coefficients come.
///
/// Format   lines that begin with # are remarks; of these "# NAME = VALUE" are settings. The first other line
///          names the columns, the rest hold a finite number for each.
/// Errors   with the file's name, line and column, and what was expected.

#include "engine/base/diagnostic.h"

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace stadion {

struct NumberColumns {
  struct Setting {
    std::string value;
    std::uint32_t line = 0, at = 0;  ///< line and column of the value
  };
  std::string file;
  std::vector<std::string> names;
  std::vector<std::vector<double>> rows;           ///< rows of numbers, each as long as `names`
  std::vector<std::uint32_t> lines;                ///< where each row stands
  std::vector<std::vector<std::uint32_t>> places;  ///< where in its line each number of a row begins, from 1
  std::map<std::string, Setting> settings;

  /// The column of that name, or nothing.
  std::optional<std::size_t> column(std::string_view name) const;
};

Result<NumberColumns> readNumberColumns(std::string_view text, const std::string& file);

/// The number that a text is, all of it; nothing if it is none or not finite.
std::optional<double> numberIn(std::string_view text);

}  // namespace stadion
