#pragma once
/// From the text of a script to its declarations, without asking what they mean.
///
///   nodetype( attribute = value, attribute = "value, with, commas", ... )
///
/// `#` begins a comment that ends with the line. A value is one bare word or stands in quotes, straight or
/// typographic, where any of them may open and any may close. A comma before `)` is allowed.
///
/// Time     linear in the length of the text, whatever it contains; no recursion.

#include "engine/script/source_text.h"

#include <functional>

namespace stadion {

/// A stretch of the text.
struct TextSpan {
  std::uint32_t offset = 0;
  std::uint32_t length = 0;
};

struct RawAttribute {
  TextSpan name;
  TextSpan value;  ///< without the quotes, blanks at both ends left out
};

struct RawDeclaration {
  TextSpan type;
  std::vector<RawAttribute> attributes;
  bool complete = true;  ///< false: a syntax error cut it short
};

/// Calls `take` for each declaration in turn (the object is reused) and `complain` for each syntax error with
/// its place; after an error it goes on at the next line that looks like the beginning of a declaration. Ends
/// early when `complain` returns false.
void parseSyntax(const SourceText& source, const std::function<void(const RawDeclaration&)>& take,
                 const std::function<bool(std::uint32_t offset, std::string message)>& complain);

}  // namespace stadion
