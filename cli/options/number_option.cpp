#include "cli/options/number_option.h"

#include <charconv>
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

}  // namespace stadion
