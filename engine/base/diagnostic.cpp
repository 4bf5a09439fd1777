#include "engine/base/diagnostic.h"

#include "engine/unicode/characters.h"

#include <algorithm>
#include <string_view>

namespace stadion {

namespace {

constexpr std::size_t kWindow = 160;  // characters of a long line that are worth showing

const char* nameOf(Severity s) {
  switch (s) {
  case Severity::Error: return "error";
  case Severity::Warning: return "warning";
  case Severity::Note: return "note";
  }
  return "note";
}

/// A character of a line, as it is shown.
struct Shown {
  std::string bytes;
  std::size_t columns;
};

/// The characters of a UTF-8 line, without the line's end. What would steer the terminal, or could not be
/// seen below the caret, is shown as '?': control characters, those of writing directions, and what has no
/// width. Joiners and variation selectors stay, where they do not matter.
std::vector<Shown> charactersOf(std::string_view line, std::size_t caret) {
  std::vector<Shown> result;
  std::size_t bytes = 0;
  for (; !line.empty() && line[0] != '\n' && line[0] != '\r'; line.remove_prefix(bytes)) {
    const char32_t c = unicode::firstCharacter(line, bytes);
    const std::size_t columns = unicode::columnsOf(c);
    const bool harmless = c == 0x200C || c == 0x200D || (c >= 0xFE00 && c <= 0xFE0F);
    const bool hidden = c != '\t' && columns == 0 && (unicode::isHidden(c) || c < 0x20);
    if (hidden && !(harmless && result.size() != caret))
      result.push_back({"?", 1});
    else
      result.push_back({std::string(line.substr(0, bytes)), columns});
  }
  return result;
}

/// The line and, under it, a caret below `column`. A tab above stands as a tab below, whatever its width.
std::string pointAt(const std::string& excerpt, std::uint32_t column) {
  const std::size_t caret = column > 0 ? column - 1 : 0;
  const std::vector<Shown> characters = charactersOf(excerpt, caret);
  const std::size_t first = caret > kWindow / 2 && characters.size() > kWindow ? caret - kWindow / 2 : 0;
  const std::size_t end = std::min(characters.size(), first + kWindow);

  std::string line = first > 0 ? "..." : "";
  std::string below(line.size(), ' ');
  for (std::size_t i = first; i < end; ++i) {
    line += characters[i].bytes;
    if (i < caret) below += characters[i].bytes == "\t" ? "\t" : std::string(characters[i].columns, ' ');
  }
  if (end < characters.size()) line += "...";
  if (column == 0 || caret > characters.size()) return "\n" + line;
  return "\n" + line + "\n" + below + "^";
}

}  // namespace

std::string format(const Diagnostic& d) {
  std::string result = d.where.file;
  if (d.where.line > 0) {
    if (!result.empty()) result += ':';
    result += std::to_string(d.where.line);
    if (d.where.column > 0) result.append(1, ':').append(std::to_string(d.where.column));
  }
  if (!result.empty()) result += ": ";
  result.append(nameOf(d.severity)).append(": ").append(d.message);
  if (!d.excerpt.empty()) result += pointAt(d.excerpt, d.where.column);
  return result;
}

void Diagnostics::error(SourcePosition where, std::string message, std::string excerpt) {
  add({Severity::Error, std::move(where), std::move(message), std::move(excerpt)});
}

void Diagnostics::warning(SourcePosition where, std::string message, std::string excerpt) {
  add({Severity::Warning, std::move(where), std::move(message), std::move(excerpt)});
}

void Diagnostics::note(SourcePosition where, std::string message, std::string excerpt) {
  add({Severity::Note, std::move(where), std::move(message), std::move(excerpt)});
}

void Diagnostics::add(Diagnostic d) {
  if (d.severity == Severity::Error) ++errors_;
  list_.push_back(std::move(d));
}

void Diagnostics::append(const Diagnostics& other) {
  const std::size_t count = other.list_.size();  // other may be this
  list_.reserve(list_.size() + count);
  for (std::size_t i = 0; i < count; ++i) add(other.list_[i]);
}

}  // namespace stadion
