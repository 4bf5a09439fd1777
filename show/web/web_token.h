#pragma once
/// The secret that every request to the operator's page has to know.
///
/// Threads  a plain value.
/// Errors   a file that cannot be read, or whose first line is too short or no plain text, is refused.

#include "engine/base/diagnostic.h"

#include <string>
#include <string_view>

namespace stadion {

class WebToken {
public:
  static constexpr std::size_t kLeast = 16, kMost = 256;  ///< [characters]

  /// Makes one of 128 random bits, as 32 hexadecimal digits.
  static Result<WebToken> make();
  /// Reads the first line of a file: letters, digits and `-._~+/=`. Warns in `findings` if other users may read
  /// the file.
  static Result<WebToken> load(const std::string& file, Diagnostics& findings);

  const std::string& text() const { return text_; }
  /// Compares in a time that does not depend on where the two differ.
  bool matches(std::string_view given) const;

private:
  explicit WebToken(std::string text) : text_(std::move(text)) {}
  std::string text_;
};

}  // namespace stadion
