#include "dynamics/flight/number_columns.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>

namespace stadion {
namespace {

std::string_view trimmed(std::string_view s) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!s.empty() && blank(s.front())) s.remove_prefix(1);
  while (!s.empty() && blank(s.back())) s.remove_suffix(1);
  return s;
}

/// A cell and the column it begins in, from 1.
struct Cell {
  std::string_view text;
  std::uint32_t at;
};

struct Reader {
  NumberColumns table;
  std::uint32_t line = 0;
  const char* start = nullptr;  ///< of the line
  std::optional<Diagnostic> wrong;

  std::uint32_t columnOf(std::string_view part) const {
    return static_cast<std::uint32_t>(part.data() - start + 1);
  }
  std::vector<Cell> cellsOf(std::string_view text) const {
    std::vector<Cell> cells;
    for (std::size_t begin = 0; begin <= text.size();) {
      const std::size_t end = std::min(text.find(',', begin), text.size());
      const std::string_view cell = trimmed(text.substr(begin, end - begin));
      cells.push_back({cell, columnOf(cell)});
      begin = end + 1;
    }
    return cells;
  }
  void fail(std::uint32_t column, std::string why) {
    if (!wrong) wrong = Diagnostic{Severity::Error, {table.file, line, column}, std::move(why), {}};
  }
  void remark(std::string_view text) {
    const std::size_t equals = text.find('=');
    if (equals == std::string_view::npos) return;
    const std::string_view value = trimmed(text.substr(equals + 1));
    table.settings[std::string(trimmed(text.substr(0, equals)))] = {std::string(value), line,
                                                                    columnOf(value)};
  }
  void names(std::string_view text) {
    for (const Cell& c : cellsOf(text)) {
      if (c.text.empty())
        return fail(c.at, "a column without a name: write names such as alpha_deg,CD,CL,CM");
      if (table.column(c.text)) return fail(c.at, fmt::format("a second column \"{}\"", c.text));
      table.names.emplace_back(c.text);
    }
  }
  void numbers(std::string_view text) {
    const std::vector<Cell> cells = cellsOf(text);
    if (cells.size() != table.names.size())
      return fail(
          cells[std::min(cells.size() - 1, table.names.size())].at,
          fmt::format("{} numbers where the first line names {} columns", cells.size(), table.names.size()));
    std::vector<double> row;
    std::vector<std::uint32_t> places;
    for (const Cell& c : cells) {
      const std::optional<double> x = numberIn(c.text);
      if (!x) return fail(c.at, fmt::format("\"{}\" is not a finite number", c.text.substr(0, 40)));
      row.push_back(*x);
      places.push_back(c.at);
    }
    table.rows.push_back(std::move(row));
    table.lines.push_back(line);
    table.places.push_back(std::move(places));
  }
  void add(std::string_view text) {
    ++line;
    start = text.data();
    text = trimmed(text);
    if (text.empty()) return;
    if (text.front() == '#') return remark(text.substr(1));
    if (table.names.empty())
      names(text);
    else
      numbers(text);
  }
};

}  // namespace

std::optional<double> numberIn(std::string_view text) {
  double x = 0;
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), x);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(x)) return std::nullopt;
  return x;
}

std::optional<std::size_t> NumberColumns::column(std::string_view name) const {
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) return std::nullopt;
  return static_cast<std::size_t>(found - names.begin());
}

Result<NumberColumns> readNumberColumns(std::string_view text, const std::string& file) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";  // "CSV UTF-8" of spreadsheets
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  Reader reader;
  reader.table.file = file;
  while (!text.empty() && !reader.wrong) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    reader.add(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  if (reader.wrong) return *reader.wrong;
  if (reader.table.rows.empty()) {
    reader.line = std::max(reader.line, 1U);
    reader.fail(1, "no rows of numbers");
    return *reader.wrong;
  }
  return reader.table;
}

}  // namespace stadion
