#include "engine/script/source_text.h"

#include "engine/asset/format.h"
#include "engine/base/plain_file.h"

#include <algorithm>

#include <fmt/format.h>
#include <tao/pegtl.hpp>

namespace stadion {

namespace {

constexpr std::size_t kBlock = 1024;
constexpr std::size_t kLongestExcerpt = 4096;
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

struct Utf8Text : tao::pegtl::star<tao::pegtl::utf8::any> {};

/// Length of the longest well-formed beginning.
std::size_t wellFormedPrefix(std::string_view bytes) {
  namespace pegtl = tao::pegtl;
  pegtl::memory_input<pegtl::tracking_mode::lazy> in(bytes.data(), bytes.data() + bytes.size(), "");
  pegtl::parse<Utf8Text>(in);
  return static_cast<std::size_t>(in.current() - bytes.data());
}

bool startsCharacter(char c) {
  return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
}

Diagnostic refusal(const std::string& file, std::string why) {
  return {Severity::Error, {file, 0, 0}, std::move(why), {}};
}

}  // namespace

Result<SourceText> SourceText::make(std::string file, std::string_view bytes) {
  if (bytes.size() > kMostBytes)
    return refusal(file, fmt::format("the file is larger than {} MiB", kMostBytes >> 20));
  if (bytes.starts_with(kByteOrderMark)) bytes.remove_prefix(kByteOrderMark.size());

  SourceText source;
  source.file_ = std::move(file);
  const std::size_t good = std::min(wellFormedPrefix(bytes), bytes.find('\0'));
  source.text_.assign(bytes.begin(), bytes.end());
  source.index();
  if (good < bytes.size()) {
    const char* const why =
        bytes[good] == '\0' ? "a NUL character is not text" : "this byte is not UTF-8 text";
    return Diagnostic{Severity::Error, source.position(static_cast<std::uint32_t>(good)), why, {}};
  }
  return source;
}

Result<SourceText> SourceText::read(const std::string& path) {
  const auto bytes = readPlainFile(path, kMostBytes);
  if (!bytes) return bytes.error();
  if (formatOf(path) || refusedFormat(path))
    return refusal(
        path, "this is a model, not a script; `stadion view` shows a model, and `stadion check --assets DIR` "
              "tries all models of a folder");
  return make(path, bytes.value());
}

void SourceText::index() {
  lineStarts_.assign(1, 0);
  blockCharacters_.clear();
  std::uint32_t characters = 0;
  for (std::size_t i = 0; i < text_.size(); ++i) {
    if (i % kBlock == 0) blockCharacters_.push_back(characters);
    if (startsCharacter(text_[i])) ++characters;
    const bool ends =
        text_[i] == '\n' || (text_[i] == '\r' && (i + 1 == text_.size() || text_[i + 1] != '\n'));
    if (ends) lineStarts_.push_back(static_cast<std::uint32_t>(i + 1));
  }
  if (text_.size() % kBlock == 0) blockCharacters_.push_back(characters);
}

std::uint32_t SourceText::charactersBefore(std::uint32_t offset) const {
  const std::size_t block = offset / kBlock;
  std::uint32_t count = blockCharacters_[block];
  for (std::size_t i = block * kBlock; i < offset; ++i)
    if (startsCharacter(text_[i])) ++count;
  return count;
}

std::uint32_t SourceText::line(std::uint32_t offset) const {
  const auto after = std::upper_bound(lineStarts_.begin(), lineStarts_.end(), offset);
  return static_cast<std::uint32_t>(after - lineStarts_.begin());
}

std::uint32_t SourceText::lineStart(std::uint32_t offset) const {
  return lineStarts_[line(offset) - 1];
}

SourcePosition SourceText::position(std::uint32_t offset) const {
  offset = std::min(offset, static_cast<std::uint32_t>(text_.size()));
  const std::uint32_t start = lineStart(offset);
  return {file_, line(offset), charactersBefore(offset) - charactersBefore(start) + 1};
}

std::string SourceText::excerpt(std::uint32_t offset) const {
  const std::string_view rest = text().substr(lineStart(offset), kLongestExcerpt + 1);
  const std::string_view line = rest.substr(0, rest.find_first_of("\r\n"));
  return line.size() > kLongestExcerpt ? std::string{} : std::string(line);
}

std::size_t SourceText::bytesHeld() const {
  return text_.capacity() + (lineStarts_.capacity() + blockCharacters_.capacity()) * sizeof(std::uint32_t);
}

}  // namespace stadion
