#include "engine/core/named_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

namespace stadion {
namespace {

std::string numberText(std::uint64_t bits, bool real, bool hasSign) {
  if (real) return fmt::format("{}", std::bit_cast<double>(bits));
  return hasSign ? fmt::format("{}", static_cast<std::int64_t>(bits)) : fmt::format("{}", bits);
}

}  // namespace

// Elements of a list have the same names: their values are one field.
NamedState::Gathered& NamedState::gathered() {
  std::string name(outer_);
  if (!name.empty()) name += ".";
  name += name_;
  const auto [at, isNew] = places_.try_emplace({part_, name}, fields_.size());
  if (isNew) fields_.push_back(Gathered{Field{name, "", part_}, StateHash()});
  return fields_[at->second];
}

void NamedState::show(Gathered& g, const std::string& value) {
  constexpr std::size_t kShown = 7;  // a pose
  if (++g.values > kShown) return g.field.value.clear();
  g.field.value += (g.field.value.empty() ? "" : " ") + value;
}

void NamedState::number(std::uint64_t& bits, Form form) {
  Gathered& g = gathered();
  g.hash.add(bits);
  g.isZero &= bits == 0;
  show(g, numberText(bits, form == Form::Real, form == Form::Signed));
}

void NamedState::text(std::string& words) {
  Gathered& g = gathered();
  g.hash.add(std::string_view(words));
  g.isZero &= words.empty();
  std::string line = words;
  std::ranges::replace_if(
      line, [](unsigned char c) { return c < ' '; }, ' ');
  show(g, '"' + line + '"');
}

std::vector<NamedState::Field> NamedState::take() {
  std::vector<Field> all;
  for (Gathered& g : fields_) {
    if (g.isZero) continue;
    if (g.field.value.empty()) g.field.value = fmt::format("#{:016x}", g.hash.value());
    all.push_back(std::move(g.field));
  }
  fields_.clear();
  places_.clear();
  return all;
}

}  // namespace stadion
