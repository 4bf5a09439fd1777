#pragma once
/// What nodes tell each other has happened. A node type names its own events: `raise("timesup", due)`.

#include "engine/core/word.h"

#include <string_view>

namespace stadion {

class Event {
public:
  constexpr Event() = default;
  consteval Event(const char* name) : name_(name), id_(hashOfWord(name)) {}

  constexpr std::string_view name() const { return name_; }
  friend constexpr bool operator==(const Event& a, const Event& b) { return a.id_ == b.id_; }

private:
  const char* name_ = "";
  std::uint32_t id_ = 0;
};

}  // namespace stadion
