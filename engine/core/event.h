#pragma once
/// What nodes tell each other has happened. A node type names its own events: `raise("timesup", due)`. An event may
/// have a word of the script: `raise(Event("marker").with("step"), due)`.

#include "engine/core/word.h"

#include <string_view>

namespace stadion {

class Event {
public:
  constexpr Event() = default;
  consteval Event(const char* name) : name_(name), id_(hashOfWord(name)) {}

  /// The event with a word, which is another one: it equals only the same event with the same word.
  constexpr Event with(std::string_view word) const {
    Event event = *this;
    event.id_ = id_ * 31 + hashOfWord(word);
    return event;
  }

  constexpr std::string_view name() const { return name_; }  ///< without the word
  friend constexpr bool operator==(const Event& a, const Event& b) { return a.id_ == b.id_; }

private:
  const char* name_ = "";
  std::uint32_t id_ = 0;
};

}  // namespace stadion
