#pragma once
/// Errors, warnings and notes for the author of a file, each with its place.

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace stadion {

struct SourcePosition {
  std::string file;          ///< as the user named it
  std::uint32_t line = 0;    ///< from 1; 0 = the whole file
  std::uint32_t column = 0;  ///< from 1, in characters
};

enum class Severity { Error, Warning, Note };

struct Diagnostic {
  Severity severity = Severity::Error;
  SourcePosition where;
  std::string message;  ///< one sentence, no trailing full stop; says what to do if that is known
  std::string excerpt;  ///< the source line, empty if there is none
};

/// "FILE:LINE:COLUMN: error: MESSAGE", then the line and a caret under the column when there is an excerpt.
std::string format(const Diagnostic& d);

/// Collects several findings in one pass.
class Diagnostics {
public:
  void error(SourcePosition where, std::string message, std::string excerpt = {});
  void warning(SourcePosition where, std::string message, std::string excerpt = {});
  void note(SourcePosition where, std::string message, std::string excerpt = {});
  void add(Diagnostic d);
  void append(const Diagnostics& other);

  bool hasErrors() const { return errors_ > 0; }
  std::size_t errorCount() const { return errors_; }
  const std::vector<Diagnostic>& all() const { return list_; }

private:
  std::vector<Diagnostic> list_;
  std::size_t errors_ = 0;
};

/// A value, or the reason there is none. For failures that come from the user's files, never for our bugs.
template <class T>
class Result {
public:
  Result(T value) : content_(std::move(value)) {}
  Result(Diagnostic why) : content_(std::move(why)) {}
  static Result failure(std::string message) {
    return Diagnostic{Severity::Error, {}, std::move(message), {}};
  }

  explicit operator bool() const { return std::holds_alternative<T>(content_); }
  T& value() { return std::get<T>(content_); }
  const T& value() const { return std::get<T>(content_); }
  const Diagnostic& error() const { return std::get<Diagnostic>(content_); }

private:
  std::variant<T, Diagnostic> content_;
};

}  // namespace stadion
