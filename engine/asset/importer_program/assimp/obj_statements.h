#pragma once
/// The statements of an OBJ or MTL file.

#include <string_view>
#include <vector>

namespace stadion::importer {

/// A word and its place; line and column count from 1, columns in bytes.
struct Word {
  std::string_view text;
  std::size_t line = 0, column = 0;
};

/// Splits the text into statements: the words of a line, and of the lines that a backslash at its end joins.
class Statements {
public:
  explicit Statements(std::string_view text) : text_(text) {}

  /// False at the end of the text.
  bool next(std::vector<Word>& words);

  /// The comment at the end of the statement; empty: none.
  std::string_view comment() const { return comment_; }

private:
  void newLine();
  void skipComment();
  std::size_t joining(std::size_t at) const;
  Word word();

  std::string_view text_, comment_;
  std::size_t at_ = 0, line_ = 1, lineStart_ = 0;
};

/// The text from a word to the end of the statement: a file name may have blanks.
std::string_view restOf(const std::vector<Word>& words, std::size_t from);

}  // namespace stadion::importer
