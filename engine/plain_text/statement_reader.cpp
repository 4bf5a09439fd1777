#include "engine/plain_text/statement_reader.h"

#include "engine/plain_text/suggestion.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace stadion {

std::optional<std::uint64_t> StatementReader::heading(std::string_view what, std::string_view format,
                                                      std::uint64_t newest) {
  if (!next()) {
    errorAt({{file_, 1, 1}, {}},
            fmt::format("the file is empty; {} begins with the line: {} 1", what, format));
    return std::nullopt;
  }
  if (keyword().text != format) {
    error(keyword(), fmt::format("this is not {}; one begins with the line: {} 1", what, format));
    return std::nullopt;
  }
  const auto version = count("the version of the format", 1, 1'000'000);
  if (!version) return std::nullopt;
  if (*version > newest) {
    error(last(), fmt::format("version {} of the format is newer than this program, which reads {}", *version,
                              newest));
    return std::nullopt;
  }
  return finished() ? version : std::nullopt;
}

bool StatementReader::next() {
  next_ = 1;
  return lines_.next();
}

bool StatementReader::firstTime(std::string_view keyword) {
  if (std::ranges::find(given_, keyword) == given_.end()) {
    given_.push_back(keyword);
    return true;
  }
  error(this->keyword(), fmt::format("\"{}\" is given twice; keep one of them", keyword));
  return false;
}

void StatementReader::unknown(const Word& at, std::string_view problem,
                              const std::vector<std::string>& known) {
  error(at, fmt::format("{} {}{}", quotedWord(at.text), problem, didYouMeanOrKnown(at.text, known)));
}

bool StatementReader::unknownField(const Word& name, std::string_view what,
                                   const std::vector<std::string>& known) {
  unknown(name, fmt::format("is not a field of {}", what), known);
  return false;
}

bool StatementReader::fieldTwice(const Word& name, std::string_view what) {
  const std::string_view noun = what.substr(what.find(' ') + 1);
  error(name, fmt::format("\"{}\" is given twice for this {}; keep one of them", name.text, noun));
  return false;
}

const Word* StatementReader::word(std::string_view what) {
  if (more()) return &lines_.words()[next_++];
  errorAtEnd(fmt::format("{} is missing", what));
  return nullptr;
}

bool StatementReader::finished() {
  if (!more()) return true;
  error(*peek(), fmt::format("{} is one word too many here", quotedWord(peek()->text)));
  return false;
}

std::optional<double> StatementReader::number(std::string_view what) {
  const Word* w = word(what);
  return w ? lines_.number(*w, what) : std::nullopt;
}

std::optional<double> StatementReader::number(std::string_view what, double lo, double hi,
                                              std::string_view unit) {
  const auto value = number(what);
  if (!value || (*value >= lo && *value <= hi)) return value;
  error(last(),
        fmt::format("{} must be from {}{} to {}{}, not {}{}", what, lo, unit, hi, unit, *value, unit));
  return std::nullopt;
}

std::optional<std::uint64_t> StatementReader::count(std::string_view what, std::uint64_t lo,
                                                    std::uint64_t hi) {
  const Word* w = word(what);
  return w ? lines_.count(*w, what, lo, hi) : std::nullopt;
}

std::optional<std::int64_t> StatementReader::whole(std::string_view what, std::int64_t lo, std::int64_t hi) {
  const auto value = number(what, static_cast<double>(lo), static_cast<double>(hi));
  if (!value) return std::nullopt;
  if (*value == std::floor(*value)) return static_cast<std::int64_t>(*value);
  error(last(), fmt::format("{} must be a whole number, not {}", what, *value));
  return std::nullopt;
}

std::optional<Nanoseconds> StatementReader::seconds(std::string_view what) {
  const Word* w = word(what);
  return w ? lines_.seconds(*w, what) : std::nullopt;
}

std::optional<std::string> StatementReader::name(std::string_view what, std::string_view of) {
  const Word* w = word(what);
  return w ? lines_.name(*w, of) : std::nullopt;
}

std::optional<std::size_t> StatementReader::choice(std::string_view what,
                                                   std::span<const std::string_view> known) {
  if (!more()) {
    errorAtEnd(fmt::format("{} ({}) is missing", what, fmt::join(known, ", ")));
    return std::nullopt;
  }
  const Word& w = *word(what);
  const auto at = std::ranges::find(known, w.text);
  if (at != known.end()) return static_cast<std::size_t>(at - known.begin());
  unknown(w, fmt::format("is not {}", what), {known.begin(), known.end()});
  return std::nullopt;
}

void StatementReader::errorAt(const StatementPlace& place, std::string message) {
  out_.error(place.where, std::move(message), place.excerpt);
  failed_ = true;
}

std::optional<LengthUnit> lengthUnit(StatementReader& in) {
  std::vector<std::string_view> names;
  for (const LengthUnit& u : kLengthUnits) names.push_back(u.name);
  const auto index = in.choice("a unit", names);
  if (!index) return std::nullopt;
  return kLengthUnits[*index];
}

}  // namespace stadion
