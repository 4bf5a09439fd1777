#pragma once
/// The text of a wall file in which single numbers change. All else stays as it is: comments, blanks, order, ends of
/// lines.
///
/// Threads  one at a time.

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace stadion {

/// A line before and after a change.
struct ChangedLine {
  std::size_t line = 0;  ///< from 0
  std::string before, after;
};

class WallText {
public:
  explicit WallText(std::string_view text);

  /// Writes the numbers behind `field` in the statement "STATEMENT NAME ..."; if the field is not there, adds it
  /// behind the last word. Returns what has changed; nothing if there is no such statement, or the field has other
  /// words.
  std::optional<ChangedLine> set(std::string_view statement, std::string_view name, std::string_view field,
                                 std::span<const double> values);
  /// Puts a line back to how it was before the change, or after it.
  void undo(const ChangedLine& change) { lines_[change.line] = change.before; }
  void redo(const ChangedLine& change) { lines_[change.line] = change.after; }

  std::string text() const;

private:
  std::vector<std::string> lines_;  ///< without '\n'
};

/// The number as it is written into the text: at most six decimals, without zeros at its end.
std::string numberText(double value);
/// The number that is read from there.
double asWritten(double value);

}  // namespace stadion
