#pragma once
/// The one fault that a program is to have, in the environment variable STADION_FAULT: its kind, then
/// figures.
///
///   new nth=N       the Nth time that the program asks for memory there is none; from=N: from then on never.
///                   Counted from main() on. tell=1: says at the end how often it asked.
///   read            of files: most=BYTES at a time (of sockets, too); delay=MS each; error=ERRNO
///   write           likewise, and after=BYTES written to such files
///   protect nth=N   a byte is written to large memory the Nth time that it is made read-only; offset=BYTES;
///                   thread=NAME: soon afterwards, by a thread whose name begins so
///   clock jump=S    the time of day jumps by so many seconds, as if somebody set it; after=MS
///
/// in=PROGRAM says which program has it (else "stadion"; its children inherit the variable), path=PART which
/// files. Nothing here asks for memory.

#include <cerrno>
#include <cstdlib>
#include <cstring>

namespace stadion {

class Fault {
public:
  explicit Fault(const char* kind) {
    const char* words = std::getenv("STADION_FAULT");
    const std::size_t length = std::strlen(kind);
    if (!words || std::strncmp(words, kind, length) != 0 || words[length] != ' ') return;
    words_ = words + length;
    const Word in = word(" in=");
    const char* mine = program_invocation_short_name;
    if (!(in.at ? in.is(mine) : std::strcmp(mine, "stadion") == 0)) words_ = nullptr;
  }

  explicit operator bool() const { return words_ != nullptr; }
  /// The figure of that key (with a space before and = after); `other` if it is not said.
  long number(const char* key, long other) const {
    const Word w = word(key);
    return w.at ? std::strtol(w.at, nullptr, 10) : other;
  }
  /// Whether the key is there, and the text begins with its word.
  bool begins(const char* text, const char* key) const {
    const Word w = word(key);
    return w.at && std::strncmp(text, w.at, w.length) == 0;
  }
  bool has(const char* key) const { return word(key).at != nullptr; }
  /// Whether the file is one of those.
  bool concerns(const char* path) const {
    const Word part = word(" path=");
    if (!part.at) return true;
    for (const char* at = path; std::strlen(at) >= part.length; ++at)
      if (std::strncmp(at, part.at, part.length) == 0) return true;
    return false;
  }

private:
  struct Word {
    const char* at = nullptr;
    std::size_t length = 0;
    bool is(const char* text) const {
      return std::strlen(text) == length && std::strncmp(text, at, length) == 0;
    }
  };
  Word word(const char* key) const {
    const char* at = words_ ? std::strstr(words_, key) : nullptr;
    if (!at) return {};
    at += std::strlen(key);
    return {at, std::strcspn(at, " ")};
  }

  const char* words_ = nullptr;
};

}  // namespace stadion
