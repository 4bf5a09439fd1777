#include "engine/asset/importer_program/assimp/obj_statements.h"

#include <algorithm>

namespace stadion::importer {
namespace {

bool isBlank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v';
}

}  // namespace

bool Statements::next(std::vector<Word>& words) {
  words.clear();
  comment_ = {};
  if (at_ >= text_.size()) return false;
  while (at_ < text_.size()) {
    const char c = text_[at_];
    if (c == '\n') {
      newLine();
      return true;
    }
    if (c == '#')
      skipComment();
    else if (const std::size_t joined = joining(at_); joined > 0) {
      at_ += joined - 1;
      newLine();
    } else if (isBlank(c))
      ++at_;
    else
      words.push_back(word());
  }
  return true;
}

void Statements::newLine() {
  ++at_;
  ++line_;
  lineStart_ = at_;
}

void Statements::skipComment() {
  const std::size_t from = at_;
  at_ = std::min(text_.find('\n', at_), text_.size());
  comment_ = text_.substr(from, at_ - from);
}

// The length of a backslash and the end of its line, 0 if there is none at `at`.
std::size_t Statements::joining(std::size_t at) const {
  if (text_[at] != '\\') return 0;
  const std::string_view rest = text_.substr(at + 1, 2);
  return rest.starts_with('\n') ? 2 : rest == "\r\n" ? 3 : 0;
}

Word Statements::word() {
  const std::size_t from = at_;
  while (at_ < text_.size() && !isBlank(text_[at_]) && text_[at_] != '\n' && joining(at_) == 0) ++at_;
  return {text_.substr(from, at_ - from), line_, from - lineStart_ + 1};
}

std::string_view restOf(const std::vector<Word>& words, std::size_t from) {
  if (from >= words.size()) return {};
  const std::string_view first = words[from].text, last = words.back().text;
  return {first.data(), static_cast<std::size_t>(last.data() + last.size() - first.data())};
}

}  // namespace stadion::importer
