#include "show/base/error_output.h"

#include <sstream>

namespace stadion {
namespace {

/// What valgrind adds, and what the parser of command lines says below each error.
bool givesNoReason(const std::string& line) {
  return line.empty() || line.starts_with("==") || line == "Run with --help for more information.";
}

/// Progress is erased and written again within a line.
std::string withoutProgress(const std::string& line) {
  const std::string text = line.substr(line.find_last_of('\r') + 1);
  const std::string erased = "\x1b[K";
  return text.starts_with(erased) ? text.substr(erased.size()) : text;
}

}  // namespace

bool isFinding(const std::string& line, const char* severity) {
  const std::string word = std::string(severity) + ": ";
  return line.starts_with(word) || line.find(": " + word) != line.npos;
}

std::string reasonIn(const std::string& said) {
  std::string ofProgram, last;
  std::istringstream lines(said);
  for (std::string raw; std::getline(lines, raw);) {
    const std::string line = withoutProgress(raw);
    if (givesNoReason(line)) continue;
    if (isFinding(line, "error")) return line;
    if (line.starts_with("stadion: ")) ofProgram = line;
    last = line;
  }
  return ofProgram.empty() ? last : ofProgram;
}

}  // namespace stadion
