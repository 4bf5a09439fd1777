#pragma once
/// Line-based text files (wall files, input logs): words with their positions, numbers, and errors that
/// point.
///
/// A line is words separated by blanks or commas; `#` begins a comment that runs to the end of the line.
///
/// Ownership  a LineReader borrows the text and the Diagnostics; words point into the text.
/// Threads    one reader, one thread.
/// Errors     go to the Diagnostics, at most kMaxErrors for a file; none is thrown.

#include "engine/base/diagnostic.h"
#include "engine/base/time_signature.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stadion {

struct Word {
  std::string_view text;
  std::uint32_t column = 0;  ///< column of the word's first character, from 1
};

class LineReader {
public:
  static constexpr std::size_t kMaxErrors = 20;

  LineReader(std::string_view text, std::string file, Diagnostics& out);

  /// Steps to the next line that has words; false at the end of the text or after too many errors.
  bool next();
  const std::vector<Word>& words() const { return words_; }
  std::uint32_t line() const { return line_; }
  /// The line as it is shown to people: printable(), of bounded length.
  std::string excerpt() const;
  SourcePosition at(std::uint32_t column) const { return {file_, line_, column}; }
  std::uint32_t endColumn() const;  ///< just after the last word

  void error(std::uint32_t column, std::string message);
  void warning(std::uint32_t column, std::string message);
  bool failed() const { return errors_ > 0; }

  /// The word as a finite number; anything else is an error that names `what`.
  std::optional<double> number(const Word& word, std::string_view what);
  /// The word as a whole number from lo to hi.
  std::optional<std::uint64_t> count(const Word& word, std::string_view what, std::uint64_t lo,
                                     std::uint64_t hi);
  /// Seconds with at most nine decimals, exactly; not negative.
  std::optional<Nanoseconds> seconds(const Word& word, std::string_view what);
  /// A name of letters, digits, '-', '_' and '.', at most 32 characters, not beginning with '.' or '-'.
  std::optional<std::string> name(const Word& word, std::string_view what);

private:
  /// A character of the word that cannot be seen is an error in its place. False if there is none.
  bool reportHidden(const Word& word);

  std::string_view text_;
  std::string file_;
  Diagnostics& out_;
  std::string_view current_;
  std::vector<Word> words_;
  std::size_t position_ = 0;
  std::uint32_t line_ = 0;
  std::size_t errors_ = 0;
};

/// "SECONDS.FRACTION" without trailing zeros; LineReader::seconds reads it back exactly. ns >= 0.
std::string formatSeconds(Nanoseconds ns);

/// Returns at most `limit` characters of the text. Control characters and invalid UTF-8 are replaced, so text
/// from a file cannot command a terminal.
std::string printable(std::string_view text, std::size_t limit);
/// `"word"`, shortened and printable(), for messages.
std::string quotedWord(std::string_view word);

}  // namespace stadion
