#include "show/web/web_token.h"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <sys/random.h>
#include <sys/stat.h>

namespace stadion {
namespace {

bool isTokenCharacter(char c) {
  const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
  return letter || (c != 0 && std::strchr("-._~+/=", c) != nullptr);
}

Diagnostic wrongToken(const std::string& file, const std::string& why, std::uint32_t column = 0) {
  return {Severity::Error, {file, column > 0 ? 1u : 0u, column}, why, {}};
}

}  // namespace

Result<WebToken> WebToken::make() {
  std::array<unsigned char, 16> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    return Result<WebToken>::failure(std::string("no random numbers for a token: ") + std::strerror(errno));
  std::string text;
  for (const unsigned char byte : bytes) text += fmt::format("{:02x}", byte);
  return WebToken(std::move(text));
}

namespace {

/// A token that came from the program that started this one is not for programs that this one starts.
void keepFromChildren(const std::string& file) {
  const std::string_view inherited = "/proc/self/fd/";
  if (file.starts_with(inherited)) fcntl(std::atoi(file.c_str() + inherited.size()), F_SETFD, FD_CLOEXEC);
}

}  // namespace

Result<WebToken> WebToken::load(const std::string& file, Diagnostics& findings) {
  keepFromChildren(file);
  std::ifstream in(file, std::ios::binary);
  std::string text(kMost + 2, '\0');
  if (!in) return wrongToken(file, std::string("the token cannot be read: ") + std::strerror(errno));
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(in.gcount()));
  if (const std::size_t end = text.find('\n'); end != std::string::npos) text.resize(end);
  if (text.ends_with('\r')) text.pop_back();
  for (std::size_t i = 0; i < text.size(); ++i)
    if (!isTokenCharacter(text[i]))
      return wrongToken(file, "the token is the first line, of letters, digits and -._~+/= alone",
                        static_cast<std::uint32_t>(i + 1));
  if (text.size() < kLeast || text.size() > kMost)
    return wrongToken(file, fmt::format("a token has {} to {} characters; make one with: head -c 18 "
                                        "/dev/urandom | base64",
                                        kLeast, kMost));
  struct stat status {};
  if (stat(file.c_str(), &status) == 0 && S_ISREG(status.st_mode) &&
      (status.st_mode & (S_IRGRP | S_IROTH)) != 0)
    findings.warning({file, 0, 0}, "other users of this machine can read the token: chmod 600 " + file);
  return WebToken(std::move(text));
}

bool WebToken::matches(std::string_view given) const {
  // Each character is compared, also after a difference and beyond the end of the shorter text.
  unsigned difference = text_.size() == given.size() ? 0 : 1;
  for (std::size_t i = 0; i < kMost; ++i) {
    const unsigned char ours = i < text_.size() ? static_cast<unsigned char>(text_[i]) : 0;
    const unsigned char theirs = i < given.size() ? static_cast<unsigned char>(given[i]) : 0;
    difference |= static_cast<unsigned>(ours ^ theirs);
  }
  return difference == 0;
}

}  // namespace stadion
