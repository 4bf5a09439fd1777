#include "engine/asset/importer_program/assimp/obj_text.h"

#include "engine/asset/importer_program/assimp/obj_statements.h"
#include "engine/asset/importer_program/source/name_list.h"
#include "engine/asset/importer_program/source/source_scene.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <string>
#include <string_view>

namespace stadion::importer {
namespace {

constexpr std::size_t kMostWholeDigits = 18;  ///< assimp reads the digits before a point as a 64-bit number

[[noreturn]] void refuseAt(const Word& at, const std::string& why) {
  throw Refusal("is wrong in line " + std::to_string(at.line) + ", column " + std::to_string(at.column) +
                ": " + why);
}

/// How many of a kind the file has, and the highest index that a face has named.
struct IndexKind {
  const char* name;
  std::int64_t count = 0, highest = 0;
  Word namedBy;
};

class ObjText {
public:
  explicit ObjText(const std::vector<std::uint8_t>& file)
      : text_(reinterpret_cast<const char*>(file.data()), file.size()) {
    if (text_.starts_with("\xef\xbb\xbf")) change(text_.substr(0, 3), "");
  }

  std::optional<std::vector<std::uint8_t>> mended() {
    Statements statements(text_);
    for (std::vector<Word> words; statements.next(words);) {
      if (words.empty()) continue;
      read(words);
      if (!statements.comment().empty()) change(statements.comment(), "");  // assimp reads on in it
    }
    for (const IndexKind& kind : kinds_)
      if (kind.highest > kind.count) refuseIndex(kind, kind.namedBy);
    if (!text_.empty() && !text_.ends_with('\n')) change(text_.substr(text_.size()), "\n");
    if (changes_.empty()) return {};
    return changed();
  }

private:
  struct Change {
    std::string_view old;  ///< within the text
    std::string now;
  };

  void read(const std::vector<Word>& words) {
    std::string_view keyword = words.front().text;
    if (keyword.starts_with("\xef\xbb\xbf"))
      keyword.remove_prefix(3);
    else if (const std::size_t blanks = words.front().column - 1; blanks > 0)  // assimp skips such lines
      change({keyword.data() - blanks, blanks}, "");
    if (keyword == "v")
      readVertex(words);
    else if (keyword == "vt")
      readTextureCoordinate(words);
    else if (keyword == "vn") {
      readNumbers(words, 3, 3, "a normal has three numbers");
      ++kinds_[2].count;
    } else if (keyword == "f")
      readFace(words);
  }

  void readVertex(const std::vector<Word>& words) {
    constexpr const char* kRule = "a vertex has three numbers, four with a weight, six with a colour";
    if (words.size() == 6) refuseAt(words.back(), countOf(words, kRule));
    readNumbers(words, 3, 6, kRule);
    ++kinds_[0].count;
  }

  void readTextureCoordinate(const std::vector<Word>& words) {
    readNumbers(words, 1, 3, "a texture coordinate has one to three numbers");
    if (words.size() == 2) changes_.push_back({words[1].text.substr(words[1].text.size()), " 0"});
    ++kinds_[1].count;
  }

  static std::string countOf(const std::vector<Word>& words, const char* rule) {
    return std::string(rule) + ", this one has " + std::to_string(words.size() - 1);
  }

  void readNumbers(const std::vector<Word>& words, std::size_t least, std::size_t most, const char* rule) {
    for (std::size_t i = 1; i < words.size(); ++i) readNumber(words[i]);
    if (words.size() - 1 < least || words.size() - 1 > most) refuseAt(words.back(), countOf(words, rule));
  }

  void readNumber(const Word& word) {
    const bool negative = word.text.starts_with('-');
    std::string_view digits = word.text.substr(negative || word.text.starts_with('+') ? 1 : 0);
    std::string withPoint;  // some programs write the comma of their user's language
    if (digits.find(',') != std::string_view::npos) {
      withPoint = digits;
      withPoint[withPoint.find(',')] = '.';
      digits = withPoint;
    }
    double value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    const bool whole = end == digits.data() + digits.size() && !digits.starts_with('-');
    if (!whole || error == std::errc::invalid_argument)
      refuseAt(word, inQuotes(word.text) + " is not a number; write it as 0.5, -2 or 1e-3");
    const std::size_t wholeDigits = std::min(digits.find_first_not_of("0123456789"), digits.size());
    const std::string sign = negative ? "-" : "";
    if (error == std::errc::result_out_of_range)
      readExtreme(word, digits);
    else if (wholeDigits > kMostWholeDigits)
      change(word.text, sign + shortest(value));
    else if (digits.starts_with('.'))
      change(word.text, sign + "0" + std::string(digits));
  }

  /// Beyond double precision: too small counts as 0, too large is wrong.
  void readExtreme(const Word& word, std::string_view digits) {
    if (digits.find("e-") == std::string_view::npos && digits.find("E-") == std::string_view::npos)
      refuseAt(word, inQuotes(word.text) + " is too large");
    change(word.text, "0");
  }

  static std::string shortest(double value) {
    std::array<char, 32> buffer{};
    const auto end =
        std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::scientific);
    return {buffer.data(), end.ptr};
  }

  /// "7", "7/1", "7/1/3" or "7//3".
  void readFace(const std::vector<Word>& words) {
    for (std::size_t i = 1; i < words.size(); ++i) {
      std::string_view rest = words[i].text;
      for (std::size_t kind = 0; kind < kinds_.size(); ++kind) {
        const std::size_t slash = std::min(rest.find('/'), rest.size());
        if (slash > 0 || kind == 0) readIndex(rest.substr(0, slash), kinds_[kind], words[i]);
        rest.remove_prefix(std::min(slash + 1, rest.size()));
        if (rest.empty()) break;
      }
      if (!rest.empty()) refuseCorner(words[i]);
    }
  }

  [[noreturn]] static void refuseCorner(const Word& word) {
    refuseAt(word, inQuotes(word.text) + " is not the corner of a face; write it as 7, 7/1, 7//3 or 7/1/3");
  }

  [[noreturn]] static void refuseIndex(const IndexKind& kind, const Word& word) {
    refuseAt(word, inQuotes(word.text) + " names a " + kind.name + " that does not exist; there are " +
                       std::to_string(kind.count));
  }

  static void readIndex(std::string_view digits, IndexKind& kind, const Word& word) {
    if (digits.starts_with('+')) digits.remove_prefix(1);
    std::int64_t index = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), index);
    if (error == std::errc::invalid_argument || end != digits.data() + digits.size() || index == 0)
      refuseCorner(word);
    if (error != std::errc{} || index < -kind.count) refuseIndex(kind, word);
    if (index > kind.highest) {
      kind.highest = index;
      kind.namedBy = word;
    }
  }

  void change(std::string_view old, std::string now) { changes_.push_back({old, std::move(now)}); }

  std::vector<std::uint8_t> changed() const {
    std::vector<std::uint8_t> result;
    result.reserve(text_.size() + 2 * changes_.size());
    const char* from = text_.data();
    for (const Change& c : changes_) {
      result.insert(result.end(), from, c.old.data());
      result.insert(result.end(), c.now.begin(), c.now.end());
      from = c.old.data() + c.old.size();
    }
    result.insert(result.end(), from, text_.data() + text_.size());
    return result;
  }

  std::string_view text_;
  std::array<IndexKind, 3> kinds_{
      {{"vertex", 0, 0, {}}, {"texture coordinate", 0, 0, {}}, {"normal", 0, 0, {}}}};
  std::vector<Change> changes_;
};

}  // namespace

std::vector<std::string> materialLibraries(const std::vector<std::uint8_t>& file) {
  std::vector<std::string> names;
  Statements statements({reinterpret_cast<const char*>(file.data()), file.size()});
  for (std::vector<Word> words; statements.next(words);)
    if (words.size() > 1 && words[0].text == "mtllib") names.emplace_back(restOf(words, 1));
  return names;
}

std::optional<std::vector<std::uint8_t>> mendedObj(const std::vector<std::uint8_t>& file) {
  return ObjText(file).mended();
}

}  // namespace stadion::importer
