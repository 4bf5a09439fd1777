#include "profiling/regression/suite.h"

#include "engine/base/plain_file.h"
#include "engine/base/text_line.h"
#include "engine/unicode/likeness.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <span>

namespace stadion::regression {
namespace {

constexpr std::size_t kMaxFileBytes = 1 << 20;
constexpr const char* kHeading = "stadion-suite";
constexpr std::uint64_t kMostFrames = 1'000'000, kMostRounds = 80, kMaxPixels = 16384;

std::string didYouMean(std::string_view word, const std::vector<std::string>& known) {
  const auto near = closest(std::string(word.substr(0, 64)), known);
  if (near) return "; " + didYouMeanOne(std::string(word), *near);
  return fmt::format("; known are {}", fmt::join(known, ", "));
}

bool isPath(std::string_view walls) {
  return walls.find('/') != walls.npos || walls.ends_with(".walls");
}

/// Reads one file, statement by statement.
class Parser {
public:
  Parser(std::string_view text, const std::string& file, Diagnostics& out, bool filesMustBeThere)
      : out_(out), in_(text, file, out), file_(file), folder_(std::filesystem::path(file).parent_path()),
        filesMustBeThere_(filesMustBeThere) {}

  std::optional<Suite> run() {
    suite_.file = file_;
    if (!heading()) return std::nullopt;
    while (in_.next()) statement();
    endCase();
    if (in_.failed() || broken_) return std::nullopt;
    if (!suite_.cases.empty()) return std::move(suite_);
    out_.error({file_, 0, 0}, "there is no case in the file; add lines such as: case kick, and below it: "
                              "show ../kick.evs");
    return std::nullopt;
  }

private:
  struct Statement {
    const char* name;
    void (Parser::*read)();
    bool ofCasesOnly;
    bool repeats;
  };

  static std::span<const Statement> statements() {
    static constexpr Statement kStatements[] = {
        {"case", &Parser::beginCase, false, true},   {"show", &Parser::show, true, false},
        {"walls", &Parser::walls, false, false},     {"modes", &Parser::modes, false, false},
        {"input", &Parser::input, true, false},      {"stereo", &Parser::stereo, false, false},
        {"look", &Parser::look, false, false},       {"size", &Parser::size, false, false},
        {"rate", &Parser::rate, false, false},       {"frames", &Parser::frames, false, false},
        {"compare", &Parser::compare, false, false}, {"tolerance", &Parser::tolerance, false, true},
        {"rounds", &Parser::rounds, false, false},   {"asset-root", &Parser::assetRoot, false, true}};
    return kStatements;
  }

  bool heading() {
    const bool any = in_.next();
    if (any && in_.words()[0].text == kHeading) {
      const Word* version = word(1, "the version of the format (1)");
      if (version && version->text != "1")
        in_.error(version->column,
                  fmt::format("version {} of the format is not known here; 1 is", quotedWord(version->text)));
      return version && nothingAfter(2) && !in_.failed();
    }
    const std::string message = fmt::format("a suite file begins with the line: {} 1", kHeading);
    any ? in_.error(in_.words()[0].column, message) : out_.error({file_, 0, 0}, message);
    return false;
  }

  void statement() {
    const Word& keyword = in_.words()[0];
    for (const Statement& s : statements()) {
      if (keyword.text != s.name) continue;
      if (s.ofCasesOnly && !inCase_)
        return in_.error(keyword.column,
                         fmt::format("\"{}\" belongs to a case; put it below a line: case NAME", s.name));
      if (!s.repeats && std::ranges::find(seen_, s.name) != seen_.end())
        return in_.error(keyword.column, fmt::format("\"{}\" is given twice; keep one of them", s.name));
      seen_.emplace_back(s.name);
      return (this->*s.read)();
    }
    std::vector<std::string> known;
    for (const Statement& s : statements()) known.emplace_back(s.name);
    in_.error(keyword.column,
              quotedWord(keyword.text) + " does not begin a statement" + didYouMean(keyword.text, known));
  }

  const Word* word(std::size_t index, std::string_view what) {
    if (index < in_.words().size()) return &in_.words()[index];
    in_.error(in_.endColumn(), fmt::format("{} is missing", what));
    return nullptr;
  }

  bool nothingAfter(std::size_t count) {
    if (in_.words().size() <= count) return true;
    const Word& extra = in_.words()[count];
    in_.error(extra.column, fmt::format("{} is one word too many here", quotedWord(extra.text)));
    return false;
  }

  /// The one word of a statement that has one.
  const Word* only(std::string_view what) {
    const Word* w = word(1, what);
    return w && nothingAfter(2) ? w : nullptr;
  }

  SuiteCase& current() { return inCase_ ? case_ : defaults_; }

  void beginCase() {
    endCase();
    inCase_ = false;
    const Word* w = only("the case's name");
    const auto name = w ? in_.name(*w, "a case") : std::nullopt;
    case_ = defaults_;
    case_.name = name.value_or("");
    inCase_ = true;
    caseWhere_ = in_.at(w ? w->column : 1), caseExcerpt_ = in_.excerpt();
    seen_.clear();
    if (!name) return;
    if (std::ranges::find(suite_.cases, *name, &SuiteCase::name) != suite_.cases.end())
      in_.error(w->column, fmt::format("there is a case \"{}\" already; give this one another name", *name));
    if (suite_.cases.size() == Suite::kMostCases)
      in_.error(w->column, fmt::format("a suite has at most {} cases; make a second one", Suite::kMostCases));
  }

  void endCase() {
    if (!inCase_) return;
    if (case_.show.empty() && std::ranges::find(seen_, "show") == seen_.end())
      out_.error(caseWhere_, fmt::format("case \"{}\" has no show; add below it: show FILE.evs", case_.name),
                 caseExcerpt_),
          broken_ = true;
    suite_.cases.push_back(case_);
  }

  /// A file as named relative to the suite's folder.
  std::optional<std::string> file(const Word& w, std::string_view what) {
    const std::filesystem::path path = (folder_ / std::string(w.text)).lexically_normal();
    std::error_code none;
    if (!filesMustBeThere_ || std::filesystem::exists(path, none)) return path.string();
    in_.error(w.column, fmt::format("there is no {} {}; names of files are relative to the suite's folder",
                                    what, path.string()));
    return std::nullopt;
  }

  void show() {
    const Word* w = only("the show's file");
    if (const auto path = w ? file(*w, "show") : std::nullopt) case_.show = *path;
  }

  void walls() {
    const Word* w = only("the name of walls, or a wall file");
    if (!w) return;
    if (!isPath(w->text)) return void(current().walls = w->text);
    if (const auto path = file(*w, "wall file")) current().walls = *path;
  }

  void input() {
    const Word* w = only("an input log, or none");
    if (!w) return;
    if (w->text == "none") return void(case_.input = "none");
    if (const auto path = file(*w, "input log")) case_.input = *path;
  }

  void assetRoot() {
    const Word* w = only("a folder");
    if (const auto path = w ? file(*w, "folder") : std::nullopt) current().assetRoots.push_back(*path);
  }

  /// Each word of the statement, one of the known ones.
  bool eachOf(const std::vector<std::string>& known, std::string_view what,
              const std::function<void(std::size_t)>& take) {
    if (!word(1, fmt::format("{} ({})", what, fmt::join(known, ", ")))) return false;
    std::vector<bool> given(known.size());
    for (std::size_t i = 1; i < in_.words().size(); ++i) {
      const Word& w = in_.words()[i];
      const auto at = std::ranges::find(known, w.text);
      const auto index = static_cast<std::size_t>(at - known.begin());
      if (at == known.end())
        in_.error(w.column,
                  fmt::format("{} is not {}{}", quotedWord(w.text), what, didYouMean(w.text, known)));
      else if (given[index])
        in_.error(w.column, fmt::format("\"{}\" is given twice; keep one of them", *at));
      else
        given[index] = true, take(index);
    }
    return true;
  }

  void modes() {
    static const std::vector<std::string> kKnown{"sequential", "pipelined"};
    current().modes.clear();
    eachOf(kKnown, "a mode", [&](std::size_t i) { current().modes.push_back(kKnown[i]); });
  }

  void stereo() {
    static const std::vector<std::string> kKnown{"pair", "off"};
    oneOf(kKnown, "pair or off", &SuiteCase::stereo);
  }

  void look() {
    static const std::vector<std::string> kKnown{"full", "plain"};
    oneOf(kKnown, "full or plain", &SuiteCase::look);
  }

  void oneOf(const std::vector<std::string>& known, std::string_view what, std::string SuiteCase::*target) {
    eachOf(known, what, [&](std::size_t i) { current().*target = known[i]; });
    nothingAfter(2);
  }

  void compare() {
    static const std::vector<std::string> kKnown{"state", "images", "counts", "instructions", "times"};
    static constexpr bool Metrics::*kFlags[] = {&Metrics::state, &Metrics::images, &Metrics::counts,
                                                &Metrics::instructions, &Metrics::times};
    Metrics metrics{false, false, false, false, false};
    eachOf(kKnown, "something to compare", [&](std::size_t i) { metrics.*kFlags[i] = true; });
    current().metrics = metrics;
  }

  void tolerance() {
    static const std::vector<std::string> kKnown{"instructions", "times"};
    const Word* of = word(1, "what the tolerance is of (instructions, times)");
    const Word* w = of ? word(2, "the tolerance in percent") : nullptr;
    if (!w || !nothingAfter(3)) return;
    if (std::ranges::find(kKnown, of->text) == kKnown.end())
      return in_.error(of->column, fmt::format("{} has no tolerance{}", quotedWord(of->text),
                                               didYouMean(of->text, kKnown)));
    const auto percent = in_.number(*w, "the tolerance in percent");
    if (!percent) return;
    if (*percent < 0 || *percent > 1000)
      return in_.error(w->column,
                       fmt::format("the tolerance must be from 0 to 1000 percent, not {}", *percent));
    (of->text == "times" ? current().tolerances.times : current().tolerances.instructions) = *percent;
  }

  void size() {
    const Word* w = only("the size of a picture, such as 96x72");
    if (!w) return;
    const std::size_t x = w->text.find('x');
    if (x == w->text.npos)
      return in_.error(w->column, fmt::format("{} is not a size; write WIDTHxHEIGHT in pixels, such as 96x72",
                                              quotedWord(w->text)));
    const auto column = [&](std::size_t i) { return w->column + static_cast<std::uint32_t>(i); };
    const auto width = in_.count({w->text.substr(0, x), column(0)}, "the width in pixels", 1, kMaxPixels);
    if (!width) return;
    if (in_.count({w->text.substr(x + 1), column(x + 1)}, "the height in pixels", 1, kMaxPixels))
      current().size = w->text;
  }

  void rate() {
    const Word* w = only("frames a second");
    const auto value = w ? in_.number(*w, "frames a second") : std::nullopt;
    if (!value) return;
    if (*value < 1 || *value > 1000)
      return in_.error(w->column, fmt::format("frames a second must be from 1 to 1000, not {}", *value));
    current().rate = *value;
  }

  void number(std::string_view what, std::uint64_t least, std::uint64_t most,
              std::uint64_t SuiteCase::*target) {
    const Word* w = only(what);
    const auto value = w ? in_.count(*w, what, least, most) : std::nullopt;
    if (value) current().*target = *value;
  }
  void frames() { number("the number of frames", 2, kMostFrames, &SuiteCase::frames); }
  void rounds() { number("the number of rounds", 12, kMostRounds, &SuiteCase::rounds); }

  Diagnostics& out_;
  LineReader in_;
  std::string file_;
  std::filesystem::path folder_;
  bool filesMustBeThere_;
  Suite suite_;
  SuiteCase defaults_, case_;
  bool inCase_ = false, broken_ = false;
  SourcePosition caseWhere_;
  std::string caseExcerpt_;
  std::vector<std::string> seen_;  ///< statements of this case
};

}  // namespace

std::string playedName(const SuiteCase& played, const std::string& mode) {
  return played.name + "/" + mode + (played.look == "full" ? "" : "/" + played.look);
}

std::optional<Suite> parseSuite(std::string_view text, const std::string& file, Diagnostics& out) {
  return Parser(text, file, out, false).run();
}

std::optional<Suite> loadSuite(const std::string& path, Diagnostics& out) {
  const Result<std::string> text = readPlainFile(path, kMaxFileBytes);
  if (text) return Parser(text.value(), path, out, true).run();
  out.add(text.error());
  return std::nullopt;
}

}  // namespace stadion::regression
