#include "profiling/regression/suite.h"

#include "engine/base/plain_file.h"
#include "engine/plain_text/statement_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <span>

namespace stadion::regression {
namespace {

constexpr std::size_t kMaxFileBytes = 1 << 20;
constexpr std::uint64_t kMostFrames = 1'000'000, kMostRounds = 80, kMaxPixels = 16384;

bool isPath(std::string_view walls) {
  return walls.find('/') != walls.npos || walls.ends_with(".walls");
}

class SuiteParser {
public:
  SuiteParser(std::string_view text, const std::string& file, Diagnostics& out, bool filesMustExist)
      : in_(text, file, out), folder_(std::filesystem::path(file).parent_path()),
        filesMustExist_(filesMustExist) {
    suite_.file = file;
  }

  std::optional<Suite> run() {
    if (!in_.heading("a suite file", "stadion-suite")) return std::nullopt;
    while (in_.next()) in_.read(*this, kStatements);
    endCase();
    if (in_.failed()) return std::nullopt;
    if (!suite_.cases.empty()) return std::move(suite_);
    in_.errorOfFile("there is no case in the file; add lines such as: case kick, and below it: "
                    "show ../kick.evs");
    return std::nullopt;
  }

private:
  static const Statement<SuiteParser> kStatements[14];

  /// The one word of a statement that has one; null after an error.
  const Word* only(std::string_view what) {
    const Word* w = in_.word(what);
    return w && in_.finished() ? w : nullptr;
  }

  SuiteCase& current() { return inCase_ ? case_ : defaults_; }

  void beginCase() {
    endCase();
    inCase_ = false;
    const Word* w = only("the case's name");
    const auto name = w ? in_.nameIn(*w, "a case") : std::nullopt;
    case_ = defaults_;
    case_.name = name.value_or("");
    inCase_ = true;
    showGiven_ = false;
    caseAt_ = in_.place(w ? *w : in_.keyword());
    in_.beginSection();
    if (!name) return;
    if (std::ranges::find(suite_.cases, *name, &SuiteCase::name) != suite_.cases.end())
      in_.error(*w, fmt::format("there is a case \"{}\" already; give this one another name", *name));
    if (suite_.cases.size() == Suite::kMostCases)
      in_.error(*w, fmt::format("a suite has at most {} cases; make a second one", Suite::kMostCases));
  }

  void endCase() {
    if (!inCase_) return;
    if (!showGiven_)
      in_.errorAt(caseAt_, fmt::format("case \"{}\" has no show; add below it: show FILE.evs", case_.name));
    suite_.cases.push_back(case_);
  }

  /// True within a case; else an error.
  bool isInCase() {
    if (!inCase_)
      in_.error(in_.keyword(),
                fmt::format("\"{}\" belongs to a case; put it below a line: case NAME", in_.keyword().text));
    return inCase_;
  }

  /// The path of a file that is named relative to the suite's folder.
  std::optional<std::string> file(const Word& w, std::string_view what) {
    const std::filesystem::path path = (folder_ / std::string(w.text)).lexically_normal();
    std::error_code none;
    if (!filesMustExist_ || std::filesystem::exists(path, none)) return path.string();
    in_.error(w, fmt::format("there is no {} {}; names of files are relative to the suite's folder", what,
                             path.string()));
    return std::nullopt;
  }

  void show() {
    if (!isInCase()) return;
    showGiven_ = true;
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
    const Word* w = isInCase() ? only("an input log, or none") : nullptr;
    if (!w) return;
    if (w->text == "none") return void(case_.input = "none");
    if (const auto path = file(*w, "input log")) case_.input = *path;
  }

  void assetRoot() {
    const Word* w = only("a folder");
    if (const auto path = w ? file(*w, "folder") : std::nullopt) current().assetRoots.push_back(*path);
  }

  /// Takes the line's words, each one of `known` and given once; at least one.
  void eachOf(std::span<const std::string_view> known, std::string_view what,
              const std::function<void(std::size_t)>& take) {
    std::vector<bool> given(known.size());
    do {
      const auto index = in_.choice(what, known);
      if (!index) continue;
      if (given[*index])
        in_.error(in_.last(), fmt::format("\"{}\" is given twice; keep one of them", known[*index]));
      else {
        given[*index] = true;
        take(*index);
      }
    } while (in_.more());
  }

  void modes() {
    static constexpr std::string_view kModes[] = {"sequential", "pipelined"};
    current().modes.clear();
    eachOf(kModes, "a mode", [&](std::size_t i) { current().modes.emplace_back(kModes[i]); });
  }

  void stereo() {
    static constexpr std::string_view kKnown[] = {"pair", "off"};
    oneOf(kKnown, "a way to show stereo", &SuiteCase::stereo);
  }

  void look() {
    static constexpr std::string_view kKnown[] = {"full", "plain"};
    oneOf(kKnown, "a look", &SuiteCase::look);
  }

  void oneOf(std::span<const std::string_view> known, std::string_view what, std::string SuiteCase::*target) {
    const auto index = in_.choice(what, known);
    if (index && in_.finished()) current().*target = known[*index];
  }

  void compare() {
    static constexpr std::string_view kKnown[] = {"state", "images", "counts", "instructions", "times"};
    static constexpr bool Metrics::*kFlags[] = {&Metrics::state, &Metrics::images, &Metrics::counts,
                                                &Metrics::instructions, &Metrics::times};
    Metrics metrics{false, false, false, false, false};
    eachOf(kKnown, "something to compare", [&](std::size_t i) { metrics.*kFlags[i] = true; });
    current().metrics = metrics;
  }

  void tolerance() {
    static constexpr std::string_view kKnown[] = {"instructions", "times"};
    const auto of = in_.choice("something that has a tolerance", kKnown);
    const auto percent = of ? in_.number("the tolerance in percent", 0, 1000) : std::nullopt;
    if (!percent || !in_.finished()) return;
    (*of == 1 ? current().tolerances.times : current().tolerances.instructions) = *percent;
  }

  void size() {
    const Word* w = only("the size of a picture, such as 96x72");
    if (!w) return;
    const std::size_t x = w->text.find('x');
    if (x == w->text.npos)
      return in_.error(*w, fmt::format("{} is not a size; write WIDTHxHEIGHT in pixels, such as 96x72",
                                       quotedWord(w->text)));
    const auto column = [&](std::size_t i) { return w->column + static_cast<std::uint32_t>(i); };
    const auto width = in_.countIn({w->text.substr(0, x), column(0)}, "the width in pixels", 1, kMaxPixels);
    if (!width) return;
    if (in_.countIn({w->text.substr(x + 1), column(x + 1)}, "the height in pixels", 1, kMaxPixels))
      current().size = w->text;
  }

  void rate() {
    const auto value = in_.number("frames a second", 1, 1000);
    if (value && in_.finished()) current().rate = *value;
  }

  void count(std::string_view what, std::uint64_t least, std::uint64_t most,
             std::uint64_t SuiteCase::*target) {
    const auto value = in_.count(what, least, most);
    if (value && in_.finished()) current().*target = *value;
  }
  void frames() { count("the number of frames", 2, kMostFrames, &SuiteCase::frames); }
  void rounds() { count("the number of rounds", 12, kMostRounds, &SuiteCase::rounds); }

  StatementReader in_;
  std::filesystem::path folder_;
  bool filesMustExist_;
  Suite suite_;
  SuiteCase defaults_, case_;
  bool inCase_ = false, showGiven_ = false;
  StatementPlace caseAt_;
};

constexpr Statement<SuiteParser> SuiteParser::kStatements[14] = {
    {"case", &SuiteParser::beginCase, true},
    {"show", &SuiteParser::show},
    {"walls", &SuiteParser::walls},
    {"modes", &SuiteParser::modes},
    {"input", &SuiteParser::input},
    {"stereo", &SuiteParser::stereo},
    {"look", &SuiteParser::look},
    {"size", &SuiteParser::size},
    {"rate", &SuiteParser::rate},
    {"frames", &SuiteParser::frames},
    {"compare", &SuiteParser::compare},
    {"tolerance", &SuiteParser::tolerance, true},
    {"rounds", &SuiteParser::rounds},
    {"asset-root", &SuiteParser::assetRoot, true}};

}  // namespace

std::string playedName(const SuiteCase& played, const std::string& mode) {
  return played.name + "/" + mode + (played.look == "full" ? "" : "/" + played.look);
}

std::optional<Suite> parseSuite(std::string_view text, const std::string& file, Diagnostics& out) {
  return SuiteParser(text, file, out, false).run();
}

std::optional<Suite> loadSuite(const std::string& path, Diagnostics& out) {
  const Result<std::string> text = readPlainFile(path, kMaxFileBytes);
  if (text) return SuiteParser(text.value(), path, out, true).run();
  out.add(text.error());
  return std::nullopt;
}

}  // namespace stadion::regression
