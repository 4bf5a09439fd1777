#include "engine/colour_table/cube_file.h"

#include "engine/plain_text/statement_reader.h"

#include <fmt/format.h>

#include <cmath>

namespace stadion {
namespace {

constexpr double kLargestPlace = 1000;  ///< of a range
constexpr double kLargestEntry = 1e6;   ///< of a row
constexpr double kLeastRange = 1e-6;

class CubeReader {
public:
  CubeReader(std::string_view text, const std::string& file, Diagnostics& out) : in_(text, file, out) {}

  std::optional<ColourTable> run() {
    while (in_.next()) {
      if (beginsRow(in_.keyword().text)) {
        if (!row()) break;
      } else if (rows_ > 0) {
        in_.error(in_.keyword(), fmt::format("{} stands below the first row of the table; move this line up",
                                             quotedWord(in_.keyword().text)));
        break;
      } else {
        in_.read(*this, kStatements);
      }
    }
    if (!in_.failed()) complete();
    if (in_.failed()) return std::nullopt;
    return std::move(table_);
  }

private:
  static const Statement<CubeReader> kStatements[9];

  static bool beginsRow(std::string_view word) {
    return std::string_view("0123456789+-.").find(word[0]) != std::string_view::npos;
  }

  // Statements.

  void title() {
    // Blanks within the title become single ones: it is for people.
    while (in_.more()) {
      if (!table_.title.empty()) table_.title += ' ';
      table_.title += in_.word("a title")->text;
    }
    std::string& t = table_.title;
    std::erase(t, '"');
    t = printable(t, 200);
  }

  void curveSize() { size("the number of rows of the curves", kMostCurveEntries, table_.curveSize); }
  void solidSize() { size("the number of grid points along an edge", kMostSolidSide, table_.solidSize); }
  void size(std::string_view what, std::uint32_t most, std::uint32_t& target) {
    const auto size = in_.count(what, 2, most);
    if (size && in_.finished()) target = static_cast<std::uint32_t>(*size);
  }

  void domainMin() { place("the lowest place", domain_.low, domainAt_); }
  void domainMax() { place("the highest place", domain_.high, domainAt_); }
  void place(std::string_view what, std::array<double, 3>& target, std::optional<StatementPlace>& at) {
    for (std::size_t c = 0; c < 3; ++c) {
      constexpr const char* kChannelNames[] = {"red", "green", "blue"};
      const auto value =
          in_.number(fmt::format("{} of {}", what, kChannelNames[c]), -kLargestPlace, kLargestPlace);
      if (!value) return;
      target[c] = *value;
    }
    if (in_.finished()) at = in_.place(in_.keyword());
  }

  void curveRange() { range(table_.curveRange, curveRangeAt_); }
  void solidRange() { range(table_.solidRange, solidRangeAt_); }
  void range(ColourTable::Range& target, std::optional<StatementPlace>& at) {
    const auto low = in_.number("the lowest place", -kLargestPlace, kLargestPlace);
    const auto high = low ? in_.number("the highest place", -kLargestPlace, kLargestPlace) : low;
    if (!high || !in_.finished()) return;
    target.low.fill(*low);
    target.high.fill(*high);
    at = in_.place(in_.keyword());
  }

  void videoRange() {
    in_.error(in_.keyword(), fmt::format("{} is not read here; write the table for values of the full range",
                                         quotedWord(in_.keyword().text)));
  }

  // Rows.

  std::uint64_t rowsOfSolid() const {
    return std::uint64_t{table_.solidSize} * table_.solidSize * table_.solidSize;
  }
  std::uint64_t rowsInAll() const { return table_.curveSize + rowsOfSolid(); }

  bool row() {
    if (table_.empty()) {
      if (!in_.failed())
        in_.error(in_.keyword(),
                  "a row stands before the size of the table; put LUT_1D_SIZE N or LUT_3D_SIZE N "
                  "above it");
      return false;
    }
    if (rows_ == rowsInAll()) {
      in_.error(in_.keyword(),
                fmt::format("the table has {} rows, and this is one more; delete it, or correct the "
                            "size",
                            rows_));
      return false;
    }
    std::vector<float>& values = rows_ < table_.curveSize ? table_.curve : table_.solid;
    const Word first = in_.keyword();
    const auto red = in_.numberIn(first, "red");
    const auto green = red ? in_.number("green") : red;
    const auto blue = green ? in_.number("blue") : green;
    if (!blue || !in_.finished()) return false;
    for (const double value : {*red, *green, *blue}) {
      if (!(std::fabs(value) <= kLargestEntry)) {
        in_.error(first, fmt::format("a value of this row is beyond {}", kLargestEntry));
        return false;
      }
      values.push_back(static_cast<float>(value));
    }
    ++rows_;
    return true;
  }

  // What goes together.

  void complete() {
    if (table_.empty())
      return in_.errorOfFile("the file has no table; it needs LUT_1D_SIZE N or LUT_3D_SIZE N");
    if (rows_ < rowsInAll())
      return in_.errorOfFile(
          fmt::format("the file ends after {} of {} rows; write it again", rows_, rowsInAll()));
    if (domainAt_) {
      const auto& other = table_.curveSize > 0 ? curveRangeAt_ : solidRangeAt_;
      if (table_.curveSize > 0 && table_.solidSize > 0)
        return in_.errorAt(*domainAt_,
                           "the file has two tables, and the domain could be that of either; write "
                           "LUT_1D_INPUT_RANGE and LUT_3D_INPUT_RANGE");
      if (other) return in_.errorAt(*domainAt_, "the file has a domain and an input range; keep one of them");
      (table_.curveSize > 0 ? table_.curveRange : table_.solidRange) = domain_;
    }
    check(table_.curveRange, domainAt_ ? domainAt_ : curveRangeAt_);
    check(table_.solidRange, domainAt_ ? domainAt_ : solidRangeAt_);
  }

  void check(const ColourTable::Range& range, const std::optional<StatementPlace>& at) {
    for (std::size_t c = 0; c < 3; ++c)
      if (!(range.high[c] - range.low[c] >= kLeastRange) && at)
        return in_.errorAt(*at, fmt::format("the highest place ({}) must be above the lowest ({})",
                                            range.high[c], range.low[c]));
  }

  StatementReader in_;
  ColourTable table_;
  ColourTable::Range domain_;
  std::optional<StatementPlace> domainAt_, curveRangeAt_, solidRangeAt_;
  std::uint64_t rows_ = 0;
};

constexpr Statement<CubeReader> CubeReader::kStatements[9] = {
    {"TITLE", &CubeReader::title},
    {"LUT_1D_SIZE", &CubeReader::curveSize},
    {"LUT_3D_SIZE", &CubeReader::solidSize},
    {"DOMAIN_MIN", &CubeReader::domainMin},
    {"DOMAIN_MAX", &CubeReader::domainMax},
    {"LUT_1D_INPUT_RANGE", &CubeReader::curveRange},
    {"LUT_3D_INPUT_RANGE", &CubeReader::solidRange},
    {"LUT_IN_VIDEO_RANGE", &CubeReader::videoRange},
    {"LUT_OUT_VIDEO_RANGE", &CubeReader::videoRange}};

void addRows(const std::vector<float>& values, std::string& text) {
  for (std::size_t i = 0; i + 2 < values.size(); i += 3)
    text += fmt::format("{} {} {}\n", values[i], values[i + 1], values[i + 2]);
}

bool isGrey(const ColourTable::Range& r) {
  return r.low[0] == r.low[1] && r.low[1] == r.low[2] && r.high[0] == r.high[1] && r.high[1] == r.high[2];
}

void addRange(const ColourTable::Range& r, const char* table, std::string& text) {
  if (r == ColourTable::Range{}) return;
  if (isGrey(r))
    text += fmt::format("LUT_{}_INPUT_RANGE {} {}\n", table, r.low[0], r.high[0]);
  else
    text += fmt::format("DOMAIN_MIN {} {} {}\nDOMAIN_MAX {} {} {}\n", r.low[0], r.low[1], r.low[2], r.high[0],
                        r.high[1], r.high[2]);
}

}  // namespace

std::optional<ColourTable> readCube(std::string_view text, const std::string& file, Diagnostics& out) {
  return CubeReader(text, file, out).run();
}

std::string formatCube(const ColourTable& table) {
  std::string text;
  if (!table.title.empty()) text += fmt::format("TITLE \"{}\"\n", table.title);
  if (table.curveSize > 0) text += fmt::format("LUT_1D_SIZE {}\n", table.curveSize);
  if (table.solidSize > 0) text += fmt::format("LUT_3D_SIZE {}\n", table.solidSize);
  if (table.curveSize > 0) addRange(table.curveRange, "1D", text);
  if (table.solidSize > 0) addRange(table.solidRange, "3D", text);
  addRows(table.curve, text);
  addRows(table.solid, text);
  return text;
}

}  // namespace stadion
