#include "pipeline/projector_control/pjlink_line.h"

#include <fmt/format.h>
#include <md5.h>

#include <algorithm>
#include <array>

namespace stadion::pjlink {
namespace {

constexpr std::size_t kLongestNumber = 64;  ///< the specification has 8 digits

bool isHexadecimal(std::string_view text) {
  return std::ranges::all_of(text, [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F');
  });
}

std::string_view meaningOf(std::string_view code) {
  if (code == "ERR1") return "it does not know the command";
  if (code == "ERR2") return "it does not take that value";
  if (code == "ERR3") return "it cannot do that now; it may be warming up, cooling down or off";
  if (code == "ERR4") return "it has a fault";
  if (code == "ERRA") return "the password is wrong";
  return {};
}

}  // namespace

std::string printable(std::string_view text) {
  std::string clean;
  for (const char c : text)
    if (c >= ' ' && c <= '~') clean += c;
  return clean;
}

Result<std::string> challengeOf(std::string_view line) {
  if (line == "PJLINK 0") return std::string();
  if (line == "PJLINK ERRA") return Result<std::string>::failure("the password is wrong");
  constexpr std::string_view kWith = "PJLINK 1 ";
  const std::string_view number = line.starts_with(kWith) ? line.substr(kWith.size()) : "";
  if (!number.empty() && number.size() <= kLongestNumber && isHexadecimal(number)) return std::string(number);
  return Result<std::string>::failure(
      fmt::format("it greets with \"{}\", which is no greeting of PJLink class 1", printable(line)));
}

std::string digestOf(std::string_view number, std::string_view password) {
  const std::string text = std::string(number).append(password);
  std::array<char, MD5_DIGEST_STRING_LENGTH> digits{};
  MD5Data(reinterpret_cast<const std::uint8_t*>(text.data()), text.size(), digits.data());
  return digits.data();
}

std::string commandLine(std::string_view body, std::string_view parameter) {
  return fmt::format("%1{} {}\r", body, parameter);
}

Result<std::string> answerTo(std::string_view body, std::string_view line) {
  if (line == "PJLINK ERRA") return Result<std::string>::failure("the password is wrong");
  const std::string head = fmt::format("%1{}=", body);
  if (!line.starts_with(head))
    return Result<std::string>::failure(fmt::format(
        "it answers \"{}\" to {}, which is not an answer of PJLink class 1", printable(line), body));
  const std::string_view answer = line.substr(head.size());
  if (const std::string_view why = meaningOf(answer); !why.empty())
    return Result<std::string>::failure(fmt::format("{} ({})", why, answer));
  return std::string(answer);
}

}  // namespace stadion::pjlink
