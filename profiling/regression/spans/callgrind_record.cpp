#include "profiling/regression/spans/callgrind_record.h"

#include <algorithm>
#include <charconv>

namespace stadion::regression {
namespace {

constexpr std::string_view kTrigger = "desc: Trigger: Client Request: ";

std::string_view withoutBlanks(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
  return text;
}

/// Reads the file line by line. Names may be shortened to a number: "ob=(3) /path/to/file" at first, then
/// "ob=(3)".
class Reader {
public:
  explicit Reader(std::string_view object) : object_(object) {}

  void line(std::string_view text) {
    if (text.starts_with(kTrigger)) {
      label_ = text.substr(kTrigger.size());
      ours_ = false;
    } else if (text.starts_with("part:")) {
      label_.clear();
      ours_ = false;
    } else if (text.starts_with("ob=")) {
      ours_ = isOurs(text.substr(3));
    } else if (text.starts_with("cob=")) {
      isOurs(text.substr(4));  // the line may define a number
    } else if (text.starts_with("calls=")) {
      skip_ = true;  // the next line is the cost of the called function
    } else if (!text.empty() && (text[0] == '+' || text[0] == '-' || text[0] == '*' || isDigit(text[0]))) {
      if (!skip_ && ours_ && !label_.empty()) counts_[label_] += cost(text);
      skip_ = false;
    }
  }
  std::map<std::string, double> counts() && { return std::move(counts_); }

private:
  static bool isDigit(char c) { return c >= '0' && c <= '9'; }

  bool isOurs(std::string_view name) {
    if (name.empty() || name[0] != '(') return name == object_;
    const std::size_t end = name.find(')');
    if (end == name.npos) return false;
    const std::string number(name.substr(0, end));
    if (name.size() > end + 1) objects_[number] = withoutBlanks(name.substr(end + 1)) == object_;
    return objects_[number];
  }

  /// The second word: the position comes first.
  static double cost(std::string_view text) {
    const std::size_t blank = text.find(' ');
    std::uint64_t value = 0;
    if (blank != text.npos) std::from_chars(text.data() + blank + 1, text.data() + text.size(), value);
    return static_cast<double>(value);
  }

  std::string_view object_;
  std::string label_;
  bool ours_ = false, skip_ = false;
  std::map<std::string, bool> objects_;
  std::map<std::string, double> counts_;
};

}  // namespace

std::string_view commandOf(std::string_view callgrindFile) {
  constexpr std::string_view kCommand = "\ncmd:";
  const std::size_t at = callgrindFile.find(kCommand);
  if (at == callgrindFile.npos) return {};
  const std::string_view rest = callgrindFile.substr(at + kCommand.size());
  return withoutBlanks(rest.substr(0, rest.find('\n')));
}

std::map<std::string, double> instructionsByLabel(std::string_view callgrindFile, std::string_view object) {
  Reader reader(object);
  for (std::size_t at = 0; at < callgrindFile.size();) {
    const std::size_t end = std::min(callgrindFile.find('\n', at), callgrindFile.size());
    reader.line(callgrindFile.substr(at, end - at));
    at = end + 1;
  }
  return std::move(reader).counts();
}

}  // namespace stadion::regression
