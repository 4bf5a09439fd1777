#pragma once
/// A word of the language as a number, so that comparing words costs one instruction and a new word needs no
/// list.
///
/// Written as its text: `node.number("period")`, `kind == "timer"`. The number is a hash of the text,
/// computed by the compiler. NodeRegistry refuses two words of a kind that have the same number.

#include <cstdint>
#include <string_view>

namespace stadion {

/// 23 bits of FNV-1a with bit 23 set: never 0, and never one of the small numbers that older states hold.
constexpr std::uint32_t hashOfWord(std::string_view text) {
  std::uint32_t hash = 2166136261U;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619U;
  return ((hash >> 23) ^ hash) % 0x800000U | 0x800000U;
}

/// `Sort` keeps node types and attributes apart.
template <class Sort>
class WordId {
public:
  constexpr WordId() = default;
  consteval WordId(const char* text) : id_(hashOfWord(text)) {}
  static constexpr WordId of(std::string_view text) { return WordId(hashOfWord(text)); }
  static constexpr WordId numbered(std::uint32_t id) { return WordId(id); }  ///< an id() of before

  constexpr std::uint32_t id() const { return id_; }  ///< 0 = no word; below 2^24
  friend constexpr bool operator==(WordId, WordId) = default;

private:
  explicit constexpr WordId(std::uint32_t id) : id_(id) {}
  std::uint32_t id_ = 0;
};

using NodeKind = WordId<struct NodeType>;   ///< the name of a node type
using Attr = WordId<struct AttributeSpec>;  ///< the name of an attribute

}  // namespace stadion
