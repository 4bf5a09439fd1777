#pragma once
/// The reader of all text files with one statement a line: wall files, rig files, cluster files, suites and
/// input logs. It gives them one grammar and one set of messages.
///
///     stadion-rig 1                 heading: the format and its version (not all formats have one)
///     hold 0.1                      statement: a keyword and its words
///     tracker head  safe 0 0 1.7    fields in a statement: a name and its words, in any order
///
/// A parser has a table of its statements. read() finds the entry of a line's keyword and calls its function.
/// That function takes the words of the line from left to right: word(), number(), name() and so on, then
/// finished(). Each of these reports what is wrong and returns nothing or false; the function then returns.
///
///     while (in.next()) in.read(*this, kStatements);
///     void hold() {
///       const auto seconds = in.number("the time to hold", 0, 60);
///       if (seconds && in.finished()) rig.hold = *seconds;
///     }
///
/// Ownership  borrows the text and the Diagnostics; words point into the text.
/// Threads    one reader, one thread.
/// Errors     go to the Diagnostics with line, column, the line itself and a fix where one is known, at most
///            LineReader::kMaxErrors a file; none is thrown.

#include "engine/plain_text/text_line.h"

#include <span>
#include <type_traits>

namespace stadion {

/// A kind of line that a parser knows.
template <class Parser>
struct Statement {
  const char* keyword;
  void (Parser::*read)();
  bool repeats = false;  ///< may be given more than once in a section
};

/// A named group of words within a line; read() returns false after an error.
template <class Parser>
struct StatementField {
  const char* name;
  bool (Parser::*read)();
};

/// Where something stands in a file, for errors that are found after its line was read.
struct StatementPlace {
  SourcePosition where;
  std::string excerpt;
};

class StatementReader {
public:
  StatementReader(std::string_view text, const std::string& file, Diagnostics& out)
      : out_(out), lines_(text, file, out), file_(file) {}

  /// Reads the heading, the line "FORMAT VERSION". Returns the version, from 1 to `newest`; nothing after an
  /// error. `what` is the file with its article, such as "a rig file".
  std::optional<std::uint64_t> heading(std::string_view what, std::string_view format,
                                       std::uint64_t newest = 1);

  /// Steps to the next line that has words. False at the end of the text or after too many errors.
  bool next();
  /// Calls the parser's function for this line's keyword. An unknown keyword is an error, and a second
  /// statement of one that does not repeat.
  template <class Parser>
  void read(Parser& parser, std::span<const std::type_identity_t<Statement<Parser>>> known) {
    for (std::size_t i = 0; i < known.size(); ++i) {
      if (keyword().text != known[i].keyword) continue;
      if (!known[i].repeats && !firstTime(known[i].keyword)) return;
      return (parser.*known[i].read)();
    }
    std::vector<std::string> names;
    for (const auto& s : known) names.emplace_back(s.keyword);
    unknown(keyword(), "does not begin a statement", names);
  }
  /// Reads fields up to the line's end, each at most once. False after an error. `what` is the statement with
  /// its article, such as "a wall".
  template <class Parser>
  bool fields(Parser& parser, std::span<const std::type_identity_t<StatementField<Parser>>> known,
              std::string_view what) {
    std::vector<std::string_view> given;
    while (more()) {
      const Word name = *word("a field");
      const StatementField<Parser>* field = nullptr;
      for (const auto& f : known)
        if (name.text == f.name) field = &f;
      if (!field) {
        std::vector<std::string> names;
        for (const auto& f : known) names.emplace_back(f.name);
        return unknownField(name, what, names);
      }
      for (const std::string_view before : given)
        if (before == name.text) return fieldTwice(name, what);
      given.push_back(name.text);
      if (!(parser.*field->read)()) return false;
    }
    return true;
  }
  /// Begins a section: all statements may be given again.
  void beginSection() { given_.clear(); }

  // The words of the line.

  const Word& keyword() const { return lines_.words()[0]; }
  /// Returns true if the line has another word.
  bool more() const { return next_ < lines_.words().size(); }
  /// The next word, without taking it; null at the line's end.
  const Word* peek() const { return more() ? &lines_.words()[next_] : nullptr; }
  /// Takes the next word; null and an error that names `what` if there is none. Valid until next().
  const Word* word(std::string_view what);
  /// The word taken last; at first the keyword.
  const Word& last() const { return lines_.words()[next_ - 1]; }
  /// True if all words of the line are taken; else an error.
  bool finished();

  std::optional<double> number(std::string_view what);
  /// A number from lo to hi; `unit` follows each number of the message, such as " m".
  std::optional<double> number(std::string_view what, double lo, double hi, std::string_view unit = {});
  std::optional<std::uint64_t> count(std::string_view what, std::uint64_t lo, std::uint64_t hi);
  /// A whole number, which may be negative.
  std::optional<std::int64_t> whole(std::string_view what, std::int64_t lo, std::int64_t hi);
  /// Seconds with at most nine decimals, exactly; not negative.
  std::optional<Nanoseconds> seconds(std::string_view what);
  /// The name of `of`, such as "a wall". `what` is the word for it, such as "the wall's name".
  std::optional<std::string> name(std::string_view what, std::string_view of);
  /// The index in `known` of the next word. `what` says what it is, such as "a unit".
  std::optional<std::size_t> choice(std::string_view what, std::span<const std::string_view> known);

  // Words that word() has taken.

  /// Reads a word as name() does.
  std::optional<std::string> nameIn(const Word& word, std::string_view of) { return lines_.name(word, of); }
  /// Reads a word as number() does.
  std::optional<double> numberIn(const Word& word, std::string_view what) { return lines_.number(word, what); }
  /// Reads a word, or a part of one, as count() does.
  std::optional<std::uint64_t> countIn(const Word& part, std::string_view what, std::uint64_t lo,
                                       std::uint64_t hi) {
    return lines_.count(part, what, lo, hi);
  }

  // Errors and places.

  std::uint32_t line() const { return lines_.line(); }
  std::string excerpt() const { return lines_.excerpt(); }
  StatementPlace place(const Word& word) const { return {lines_.at(word.column), lines_.excerpt()}; }
  void error(const Word& at, std::string message) { lines_.error(at.column, std::move(message)); }
  void errorAt(const StatementPlace& place, std::string message);
  /// An error of the whole file.
  void errorOfFile(std::string message) { errorAt({{file_, 0, 0}, {}}, std::move(message)); }
  /// An error behind the last word of the line.
  void errorAtEnd(std::string message) { lines_.error(lines_.endColumn(), std::move(message)); }
  /// An error at a word that is none of `known`: `"WORD" PROBLEM`, and what was meant or what is known.
  void unknown(const Word& at, std::string_view problem, const std::vector<std::string>& known);
  /// Returns true if an error of this file was reported.
  bool failed() const { return lines_.failed() || failed_; }

private:
  bool firstTime(std::string_view keyword);
  bool unknownField(const Word& name, std::string_view what, const std::vector<std::string>& known);
  bool fieldTwice(const Word& name, std::string_view what);

  Diagnostics& out_;
  LineReader lines_;
  std::string file_;
  std::size_t next_ = 0;                 ///< index of the next word
  std::vector<std::string_view> given_;  ///< keywords of this section that do not repeat
  bool failed_ = false;                  ///< by an error that lines_ does not count
};

/// A unit of length in a file.
struct LengthUnit {
  std::string_view name;
  double metres;
};
inline constexpr LengthUnit kLengthUnits[] = {
    {"m", 1}, {"cm", 0.01}, {"mm", 0.001}, {"in", 0.0254}, {"ft", 0.3048}};

/// Takes the next word as a unit of length; nothing after an error.
std::optional<LengthUnit> lengthUnit(StatementReader& in);

}  // namespace stadion
