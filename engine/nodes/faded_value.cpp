#include "engine/nodes/faded_value.h"

#include <algorithm>
#include <charconv>
#include <optional>

namespace stadion {
namespace {

std::optional<double> numberOfWord(const std::string& word) {
  double value = 0;
  const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (fault != std::errc() || end != word.data() + word.size()) return {};
  return value + 0.0;  // no negative zero
}

}  // namespace

double FadedValue::at(Nanoseconds time) const {
  if (time >= until_) return to_;
  if (time <= since_) return from_;
  const double part = static_cast<double>(time - since_) / static_cast<double>(until_ - since_);
  return from_ + (to_ - from_) * part;
}

bool FadedValue::take(const Message& m, Nanoseconds when, double least, double most) {
  constexpr double kLongestFade = 1e6;
  const std::size_t words = m.arguments.size();
  if (words != 1 && (words != 3 || m.arguments[1] != "fade")) return false;
  const auto number = numberOfWord(m.arguments[0]), seconds = words == 3 ? numberOfWord(m.arguments[2]) : 0.0;
  if (!number || !seconds || !(*number == *number) || !(*seconds >= 0 && *seconds <= kLongestFade))
    return false;
  from_ = at(when);
  to_ = std::clamp(*number, least, most);
  since_ = when;
  until_ = when + fromSeconds(*seconds);
  return true;
}

bool FadedValue::isWithin(double least, double most) const {
  const auto fits = [&](double x) { return x >= least && x <= most; };
  return fits(from_) && fits(to_) && since_ <= until_;
}

}  // namespace stadion
