#pragma once
/// The text of one script, and the way from a place in it to a line and column.
///
/// Text     UTF-8 without NUL, at most 64 MiB, any line ends; a byte order mark at the start is left out.
/// Places   byte offsets into text(); positions count lines and characters from 1.
/// Errors   make() and read() refuse any other text.
/// Threads  constant once made. Moving it keeps views into text() valid.

#include "engine/base/diagnostic.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace stadion {

class SourceText {
public:
  static constexpr std::size_t kMostBytes = std::size_t{64} << 20;

  /// `file` is how the user named it.
  static Result<SourceText> make(std::string file, std::string_view bytes);
  static Result<SourceText> read(const std::string& path);

  const std::string& file() const { return file_; }
  std::string_view text() const { return {text_.data(), text_.size()}; }
  std::string_view slice(std::uint32_t offset, std::uint32_t length) const {
    return text().substr(offset, length);
  }

  std::uint32_t line(std::uint32_t offset) const;  ///< from 1
  SourcePosition position(std::uint32_t offset) const;
  std::uint32_t lineStart(std::uint32_t offset) const;  ///< offset of the first byte of the line
  /// The line around `offset` without its end; empty if it is too long to read.
  std::string excerpt(std::uint32_t offset) const;

  std::size_t bytesHeld() const;  ///< memory

private:
  SourceText() = default;
  void index();
  std::uint32_t charactersBefore(std::uint32_t offset) const;

  std::string file_;
  std::vector<char> text_;
  std::vector<std::uint32_t> lineStarts_;
  std::vector<std::uint32_t>
      blockCharacters_;  // characters before each block of text, so that columns are cheap
};

}  // namespace stadion
