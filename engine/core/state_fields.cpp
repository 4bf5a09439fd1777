#include "engine/core/state_fields.h"

#include <cmath>
#include <fmt/format.h>
#include <xxhash.h>

namespace stadion {
namespace {

// Most whole numbers are small: seven bits a byte, all but the last byte with the eighth.
constexpr unsigned kBits = 7;
constexpr std::uint8_t kMore = 0x80;

void append(std::uint64_t whole, std::vector<std::uint8_t>& bytes) {
  for (; whole >= kMore; whole >>= kBits) bytes.push_back(static_cast<std::uint8_t>(whole | kMore));
  bytes.push_back(static_cast<std::uint8_t>(whole));
}

}  // namespace

void SavedState::number(std::uint64_t& bits, Form form) {
  if (form != Form::Real) return append(bits, bytes_);
  for (unsigned i = 0; i < 64; i += 8) bytes_.push_back(static_cast<std::uint8_t>(bits >> i));
}

void SavedState::text(std::string& words) {
  append(words.size(), bytes_);
  bytes_.insert(bytes_.end(), words.begin(), words.end());
}

void StateDigest::text(std::string& words) {
  flush();
  hash_.add(std::string_view(words));
}

void StateDigest::flush() {
  hash_.add(std::uint64_t{XXH64(gathered_.data(), used_ * sizeof gathered_[0], 0)});
  used_ = 0;
}

std::uint64_t StateDigest::value() {
  flush();
  return hash_.value();
}

std::uint64_t StateBytes::whole() {
  std::uint64_t value = 0;
  for (unsigned shift = 0; shift < 64 && !left_.empty(); shift += kBits) {
    const std::uint8_t byte = left_.front();
    left_ = left_.subspan(1);
    value |= static_cast<std::uint64_t>(byte % kMore) << shift;
    if (!(byte & kMore)) return value;
  }
  fail();
  return 0;
}

std::uint64_t StateBytes::real() {
  constexpr std::size_t kSize = sizeof(double);
  if (left_.size() < kSize) {
    fail();
    return 0;
  }
  std::uint64_t value = 0;
  for (unsigned i = 0; i < kSize; ++i) value |= std::uint64_t{left_[i]} << (8 * i);
  left_ = left_.subspan(kSize);
  return value;
}

std::string StateBytes::text() {
  const std::uint64_t size = whole();
  if (size > left_.size()) {
    fail();
    return std::string();
  }
  std::string words(left_.begin(), left_.begin() + static_cast<std::ptrdiff_t>(size));
  left_ = left_.subspan(static_cast<std::size_t>(size));
  return words;
}

void RestoredState::number(std::uint64_t& bits, Form form) {
  const std::uint64_t there = form == Form::Real ? bytes_.real() : bytes_.whole();
  if (form == Form::Real && std::isnan(std::bit_cast<double>(there))) fail();
  if (!bytes_.failed()) bits = there;
}

void RestoredState::text(std::string& words) {
  std::string there = bytes_.text();
  if (!bytes_.failed()) words = std::move(there);
}

void StateDifference::number(std::uint64_t& bits, Form form) {
  if (apart_) return;
  const std::uint64_t there = form == Form::Real ? there_.real() : there_.whole();
  if (there == bits && !there_.failed()) return;
  apart_ = form == Form::Count || there_.failed();
  const auto told = [form](std::uint64_t value) {
    if (form == Form::Real) return fmt::format("{:.17g}", std::bit_cast<double>(value));
    return form == Form::Signed ? fmt::format("{}", static_cast<std::int64_t>(value))
                                : fmt::format("{}", value);
  };
  found(told(bits), there_.failed() ? "nothing" : told(there));
}

void StateDifference::text(std::string& words) {
  if (apart_) return;
  const std::string there = there_.text();
  if (there == words && !there_.failed()) return;
  found("\"" + words + "\"", there_.failed() ? "nothing" : "\"" + there + "\"");
}

void StateDifference::found(std::string here, std::string there) {
  if (first_) return;
  std::string name(outer_);
  if (!name.empty()) name += ".";
  first_ = Field{name + std::string(name_), std::move(here), std::move(there), part_};
}

}  // namespace stadion
