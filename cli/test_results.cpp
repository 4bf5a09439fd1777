#include "cli/test_results.h"

#include <fmt/format.h>
#include <string_view>

namespace stadion {
namespace {

/// The text between the two marks; empty if one of them is missing.
std::string_view between(std::string_view text, std::string_view from, std::string_view to) {
  const std::size_t begin = text.find(from);
  if (begin == text.npos) return {};
  text.remove_prefix(begin + from.size());
  return text.substr(0, text.find(to));
}

/// The text without the entities that XML needs, in one line.
std::string plainText(std::string_view xml) {
  constexpr std::pair<std::string_view, char> kEntities[] = {
      {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}, {"&amp;", '&'}, {"\n", ' '}};
  std::string text;
  while (!xml.empty()) {
    std::size_t length = 1;
    char c = xml.front();
    for (const auto& [entity, meaning] : kEntities)
      if (xml.starts_with(entity)) {
        length = entity.size();
        c = meaning;
      }
    text += c;
    xml.remove_prefix(length);
  }
  return text;
}

/// What the test gave as its reason: GoogleTest prints "FILE:LINE: Skipped" and the reason below.
std::string skipReason(std::string_view testCase) {
  std::string_view reason = between(testCase, ": Skipped\n", "\n[");
  while (!reason.empty() && reason.back() == '\n') reason.remove_suffix(1);
  return reason.empty() ? "no reason given" : plainText(reason);
}

}  // namespace

TestResults testResultsOf(const std::string& junit) {
  TestResults results;
  std::string_view rest = junit;
  for (std::size_t at = 0; (at = rest.find("<testcase ")) != rest.npos;) {
    rest.remove_prefix(at);
    const std::string_view test = rest.substr(0, rest.find("</testcase>"));
    const std::string_view status = between(test, "status=\"", "\"");
    if (status == "run")
      ++results.passed;
    else if (status == "disabled" || test.find("<skipped message=\"SKIP_") != test.npos)
      results.skipped.emplace_back(plainText(between(test, "name=\"", "\"")), skipReason(test));
    else
      ++results.failed;
    rest.remove_prefix(test.size());
  }
  return results;
}

std::string closingLine(const TestResults& results) {
  return fmt::format("{} passed, {} failed, {} skipped", results.passed, results.failed,
                     results.skipped.size());
}

}  // namespace stadion
