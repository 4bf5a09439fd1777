#pragma once
/// The lines of PJLink, class 1 (JBMIA's public specification, version 1.04).
///
/// A projector greets with "PJLINK 0", or with "PJLINK 1 NUMBER" if it wants a password: then the MD5 digest
/// of NUMBER and password stands before the first command. A command is "%1POWR 1", its answer "%1POWR=OK".
/// Each line ends with a carriage return.
///
/// Threads  pure functions.
/// Errors   one sentence that says what the projector answered.

#include "engine/base/diagnostic.h"

#include <optional>
#include <string>
#include <string_view>

namespace stadion::pjlink {

constexpr std::size_t kLongestLine = 136;  ///< with its carriage return [bytes]

/// Returns the number to be digested; empty: no password is wanted. `line` is without its carriage return.
Result<std::string> challengeOf(std::string_view line);

/// Returns the digest of number and password, as 32 hexadecimal digits.
std::string digestOf(std::string_view number, std::string_view password);

/// Returns the line of a command: `body` is four letters, such as POWR; `parameter` is ? for a question.
std::string commandLine(std::string_view body, std::string_view parameter);

/// Returns what the projector answers to the command `body`.
Result<std::string> answerTo(std::string_view body, std::string_view line);

/// A text of a projector with what could not be printed left out; for messages.
std::string printable(std::string_view text);

}  // namespace stadion::pjlink
