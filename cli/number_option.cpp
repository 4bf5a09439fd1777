#include "cli/number_option.h"

#include <charconv>
#include <cmath>
#include <fmt/format.h>

namespace stadion {
namespace {

template <class Number>
std::optional<Number> parse(const char* begin, const char* end) {
  Number value{};
  const auto [stop, problem] = std::from_chars(begin, end, value);
  if (problem != std::errc{} || stop != end) return std::nullopt;
  return value;
}

template <class Number>
CLI::Validator validator(Number least, Number most, const char* what) {
  const std::string allowed = fmt::format("{} from {} to {}", what, least, most);
  const auto check = [=](std::string& text) {
    const auto value = parse<Number>(text.data(), text.data() + text.size());
    // A value that is not a number compares as neither.
    const bool good = value && *value >= least && *value <= most;
    return good ? std::string() : fmt::format("\"{}\" is not a {}", text, allowed);
  };
  return {check, fmt::format("{} to {}", least, most)};
}

}  // namespace

CLI::Validator numberFrom(double least, double most) {
  return validator<double>(least, most, "number");
}

CLI::Validator wholeNumberFrom(std::uint64_t least, std::uint64_t most) {
  return validator<std::uint64_t>(least, most, "whole number");
}

std::optional<double> parseNumber(const std::string& text) {
  const auto value = parse<double>(text.data(), text.data() + text.size());
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<std::pair<std::uint32_t, std::uint32_t>> parseSize(const std::string& text) {
  const std::size_t by = text.find('x');
  if (by == std::string::npos) return std::nullopt;
  const auto width = parse<std::uint32_t>(text.data(), text.data() + by);
  const auto height = parse<std::uint32_t>(text.data() + by + 1, text.data() + text.size());
  if (!width || !height) return std::nullopt;
  return std::pair(*width, *height);
}

}  // namespace stadion
