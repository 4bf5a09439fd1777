#pragma once
/// Numbers of a line of a foreign text file, separated by blanks, tabs, commas or semicolons.
///
/// Ownership  borrows the line.
/// Threads    one line, one thread.

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

namespace stadion {

class NumberLine {
public:
  explicit NumberLine(std::string_view line) : rest_(line) {}

  /// Takes the next word; empty at the end of the line.
  std::string_view word() {
    static constexpr std::string_view kBetween = " \t\r\n,;";
    rest_.remove_prefix(std::min(rest_.find_first_not_of(kBetween), rest_.size()));
    const std::string_view taken = rest_.substr(0, rest_.find_first_of(kBetween));
    rest_.remove_prefix(taken.size());
    return taken;
  }

  /// Takes the next word as a finite number.
  std::optional<double> number() { return numberIn(word()); }

  /// Takes as many numbers; false if one is missing.
  template <std::size_t Count>
  bool numbers(double (&values)[Count]) {
    for (double& value : values) {
      const auto taken = number();
      if (!taken) return false;
      value = *taken;
    }
    return true;
  }

  /// Takes the next word as a whole number from 0 to `most`.
  std::optional<std::size_t> count(std::size_t most) {
    const auto value = number();
    if (!value || *value < 0 || *value > static_cast<double>(most) || *value != std::floor(*value))
      return std::nullopt;
    return static_cast<std::size_t>(*value);
  }

  bool atEnd() { return NumberLine(rest_).word().empty(); }
  std::string_view rest() const { return rest_; }

  /// The whole text as a finite number.
  static std::optional<double> numberIn(std::string_view text) {
    if (text.starts_with('+')) text.remove_prefix(1);
    double value = 0;
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (fault != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
      return std::nullopt;
    return value;
  }

private:
  std::string_view rest_;
};

}  // namespace stadion
