#include "engine/plain_text/number_text.h"

#include <charconv>

namespace stadion {
namespace {

template <class Number>
std::optional<Number> numberIn(const char* begin, const char* end) {
  Number value{};
  const auto [stop, problem] = std::from_chars(begin, end, value);
  if (problem != std::errc{} || stop != end) return std::nullopt;
  return value;
}

}  // namespace

std::optional<std::pair<std::uint32_t, std::uint32_t>> parseSize(const std::string& text) {
  const std::size_t by = text.find('x');
  if (by == std::string::npos) return std::nullopt;
  const auto width = numberIn<std::uint32_t>(text.data(), text.data() + by);
  const auto height = numberIn<std::uint32_t>(text.data() + by + 1, text.data() + text.size());
  if (!width || !height) return std::nullopt;
  return std::pair(*width, *height);
}

}  // namespace stadion
