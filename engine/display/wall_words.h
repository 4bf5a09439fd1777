#pragma once
/// Words that several statements of a wall file have: lengths, in the file's unit there and in metres here, and
/// names of files.
///
/// Ownership  borrows the reader.
/// Threads    one reader, one thread.
/// Errors     are reported at the word that is wrong.

#include "engine/maths/maths.h"
#include "engine/plain_text/statement_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <initializer_list>
#include <string>

namespace stadion {

class LengthReader {
public:
  static constexpr double kMaxLength = 1e7;  ///< of any number before units [m or the file's unit]

  explicit LengthReader(StatementReader& in) : in_(in) {}

  /// Takes the next word as a length [m].
  std::optional<double> length(std::string_view what) {
    const auto value = in_.number(what);
    if (!value) return std::nullopt;
    ++count_;
    if (std::fabs(*value) <= kMaxLength) return *value * metresPerUnit_;
    in_.error(in_.last(), fmt::format("{} is too large ({})", quotedWord(in_.last().text), what));
    return std::nullopt;
  }

  /// Takes the next word as a length from lo to hi [m].
  std::optional<double> length(std::string_view what, double lo, double hi) {
    const auto value = length(what);
    if (!value || (*value >= lo && *value <= hi)) return value;
    in_.error(in_.last(), fmt::format("{} must be from {} m to {} m, not {} m", what, lo, hi, *value));
    return std::nullopt;
  }

  /// Takes the next three words as a point [m]; `of` says whose it is, such as "lower-left".
  bool point(std::string_view of, Vec3& target) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto value = length(fmt::format("{} of {}", "xyz"[axis], of));
      if (!value) return false;
      target[axis] = *value;
    }
    return true;
  }

  void setUnit(double metres) { metresPerUnit_ = metres; }
  /// True once a length was read: from then on the unit stands.
  bool used() const { return count_ > 0; }

private:
  StatementReader& in_;
  double metresPerUnit_ = 1;
  std::size_t count_ = 0;
};

/// Takes the next word as the name of a file with one of these endings. False after an error.
inline bool readFileName(StatementReader& in, std::string_view what,
                         std::initializer_list<std::string_view> endings, std::string& target) {
  const Word* w = in.word(what);
  if (!w) return false;
  const auto problem = [&]() -> std::string {
    if (w->text.size() > 1000) return "is too long for a file's name";
    for (const std::string_view ending : endings)
      if (w->text.ends_with(ending) && w->text.size() > ending.size()) return {};
    return fmt::format("is not read here; give a file whose name ends in {}", fmt::join(endings, " or "));
  }();
  if (problem.empty())
    target = std::string(w->text);
  else
    in.error(*w, quotedWord(w->text) + " " + problem);
  return problem.empty();
}

}  // namespace stadion
