#include "engine/display/wall_file.h"

#include "engine/base/folder_names.h"
#include "engine/base/plain_file.h"
#include "engine/base/text_line.h"
#include "engine/display/output_reader.h"
#include "engine/display/wall_lint.h"
#include "engine/unicode/likeness.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace stadion {
namespace {

constexpr std::size_t kMaxFileBytes = 1 << 20;
constexpr double kMaxLength = 1e7;  ///< of any number before units [m or the file's unit]
constexpr std::uint64_t kMaxPixels = 16384;

struct Unit {
  const char* name;
  double metres;
};
constexpr Unit kUnits[] = {{"m", 1}, {"cm", 0.01}, {"mm", 0.001}, {"in", 0.0254}, {"ft", 0.3048}};

std::string didYouMean(std::string_view word, const std::vector<std::string>& known) {
  const auto near = closest(std::string(word.substr(0, 64)), known);
  if (near) return "; " + didYouMeanOne(std::string(word), *near);
  return fmt::format("; known are {}", fmt::join(known, ", "));
}

/// Reads one file, statement by statement.
class Parser {
public:
  Parser(std::string_view text, const std::string& file, Diagnostics& out)
      : file_(file), out_(out), in_(text, file, out) {}

  std::optional<WallFile> run() {
    walls_.file = file_;
    while (in_.next()) statement();
    if (in_.failed()) return std::nullopt;
    if (walls_.walls.empty()) {
      out_.error({file_, 0, 0},
                 "there is no wall in the file; add a line such as: wall front  lower-left -1.5 1.5 "
                 "0  lower-right 1.5 1.5 0  upper-left -1.5 1.5 3");
      return std::nullopt;
    }
    for (WallEntry& entry : walls_.walls)
      if (entry.pixels.width == 0) entry.pixels = pixels_;
    if (!giveOutputs()) return std::nullopt;
    return std::move(walls_);
  }

private:
  struct Statement {
    const char* name;
    void (Parser::*read)();
    bool once;
  };

  /// What may begin a line.
  static std::span<const Statement> statements() {
    static constexpr Statement kStatements[] = {
        {"wall", &Parser::wall, false},   {"output", &Parser::output, false},
        {"unit", &Parser::unit, true},    {"eye-separation", &Parser::eyeSeparation, true},
        {"near", &Parser::near, true},    {"far", &Parser::far, true},
        {"pixels", &Parser::pixels, true}};
    return kStatements;
  }

  void statement() {
    const Word& keyword = in_.words()[0];
    for (const Statement& s : statements()) {
      if (keyword.text != s.name) continue;
      if (s.once && std::ranges::find(seen_, s.name) != seen_.end())
        return in_.error(keyword.column, fmt::format("\"{}\" is given twice; keep one of them", s.name));
      seen_.emplace_back(s.name);
      return (this->*s.read)();
    }
    std::vector<std::string> known;
    for (const Statement& s : statements()) known.emplace_back(s.name);
    in_.error(keyword.column,
              quotedWord(keyword.text) + " does not begin a statement" + didYouMean(keyword.text, known));
  }

  /// The word at `index`, or an error that says what is missing there.
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

  void unit() {
    const Word* name = word(1, "a unit (m, cm, mm, in, ft)");
    if (!name || !nothingAfter(2)) return;
    if (lengths_ > 0)
      return in_.error(in_.words()[0].column,
                       "the unit must stand before the first length; move this line up");
    std::vector<std::string> known;
    for (const Unit& u : kUnits) {
      if (name->text == u.name) return void(walls_.metresPerUnit = u.metres);
      known.emplace_back(u.name);
    }
    in_.error(name->column, quotedWord(name->text) + " is not a unit" + didYouMean(name->text, known));
  }

  std::optional<double> length(std::size_t index, std::string_view what) {
    const Word* w = word(index, what);
    if (!w) return std::nullopt;
    const auto value = in_.number(*w, what);
    if (!value) return std::nullopt;
    ++lengths_;
    if (std::fabs(*value) <= kMaxLength) return *value * walls_.metresPerUnit;
    in_.error(w->column, fmt::format("{} is too large ({})", quotedWord(w->text), what));
    return std::nullopt;
  }

  void positive(std::string_view what, double lo, double hi, double& target) {
    const auto value = length(1, what);
    if (!value || !nothingAfter(2)) return;
    if (*value >= lo && *value <= hi) return void(target = *value);
    in_.error(in_.words()[1].column,
              fmt::format("{} must be from {} m to {} m, not {} m", what, lo, hi, *value));
  }

  void eyeSeparation() { positive("the eye separation", 0, 0.5, walls_.eyeSeparation); }

  void near() {
    positive("the near distance", 1e-4, 100, walls_.depth.near);
    checkDepth();
  }

  void far() {
    positive("the far distance", 0.01, 1e7, walls_.depth.far);
    checkDepth();
  }

  void checkDepth() {
    if (walls_.depth.near < walls_.depth.far) return;
    in_.error(in_.words()[0].column,
              fmt::format("near ({} m) must be less than far ({} m)", walls_.depth.near, walls_.depth.far));
    walls_.depth = {};
  }

  bool pixelsAt(std::size_t index, PixelSize& target) {
    const Word* w = word(index, "the width in pixels");
    const Word* h = w ? word(index + 1, "the height in pixels") : nullptr;
    if (!h) return false;
    const auto width = in_.count(*w, "the width in pixels", 1, kMaxPixels);
    const auto height = in_.count(*h, "the height in pixels", 1, kMaxPixels);
    if (!width || !height) return false;
    target = {static_cast<std::uint32_t>(*width), static_cast<std::uint32_t>(*height)};
    return true;
  }

  void pixels() {
    if (pixelsAt(1, pixels_)) nothingAfter(3);
  }

  /// The fields of a wall line; each begins with its name, in any order.
  struct Field {
    const char* name;
    std::size_t words;   ///< after the name
    Vec3 Wall::*corner;  ///< nullptr: not a corner
  };
  static constexpr Field kFields[] = {{"lower-left", 3, &Wall::lowerLeft},
                                      {"lower-right", 3, &Wall::lowerRight},
                                      {"upper-left", 3, &Wall::upperLeft},
                                      {"pixels", 2, nullptr}};

  static std::vector<std::string> fieldNames() {
    std::vector<std::string> names;
    for (const Field& f : kFields) names.emplace_back(f.name);
    return names;
  }

  bool corner(std::size_t index, const Field& field, Wall& wall) {
    for (int axis = 0; axis < 3; ++axis) {
      const std::size_t i = index + static_cast<std::size_t>(axis);
      const auto value =
          length(i, fmt::format("{} of {}", std::string_view("xyz").substr(i - index, 1), field.name));
      if (!value) return false;
      (wall.*field.corner)[axis] = *value;
    }
    return true;
  }

  bool fields(WallEntry& entry, std::vector<std::string>& given) {
    for (std::size_t i = 2; i < in_.words().size();) {
      const Word& key = in_.words()[i];
      const auto field = std::ranges::find_if(kFields, [&](const Field& f) { return key.text == f.name; });
      if (field == std::end(kFields)) {
        in_.error(key.column,
                  quotedWord(key.text) + " is not a field of a wall" + didYouMean(key.text, fieldNames()));
        return false;
      }
      if (std::ranges::find(given, field->name) != given.end()) {
        in_.error(key.column,
                  fmt::format("\"{}\" is given twice for this wall; keep one of them", field->name));
        return false;
      }
      given.emplace_back(field->name);
      if (!(field->corner ? corner(i + 1, *field, entry.wall) : pixelsAt(i + 1, entry.pixels))) return false;
      i += 1 + field->words;
    }
    return true;
  }

  void wall() {
    const Word* name = word(1, "the wall's name");
    if (!name) return;
    const auto good = in_.name(*name, "a wall");
    if (!good) return;
    WallEntry entry;
    entry.wall.name = *good;
    entry.line = in_.line();
    entry.column = name->column;
    entry.excerpt = in_.excerpt();
    std::vector<std::string> given;
    if (!fields(entry, given)) return;
    for (const Field& f : kFields)
      if (f.corner && std::ranges::find(given, f.name) == given.end())
        return in_.error(in_.endColumn(),
                         fmt::format("wall \"{}\" has no {}; add: {} X Y Z", *good, f.name, f.name));
    for (const WallEntry& other : walls_.walls)
      if (other.wall.name == *good)
        return in_.error(name->column,
                         fmt::format("there is a wall \"{}\" already, on line {}; give this one another "
                                     "name",
                                     *good, other.line));
    if (walls_.walls.size() == WallFile::kMaxWalls)
      return in_.error(in_.words()[0].column,
                       fmt::format("a file has at most {} walls; leave this one out", WallFile::kMaxWalls));
    walls_.walls.push_back(std::move(entry));
  }

  void output() {
    const Word* wall = word(1, "the name of the output's wall");
    if (!wall) return;
    const auto name = in_.name(*wall, "a wall");
    if (!name) return;
    const auto read = readOutput(in_, 2);
    if (!read) return;
    for (const NamedOutput& other : outputs_)
      if (other.wall == *name)
        return in_.error(wall->column,
                         fmt::format("wall \"{}\" has an output already, on line {}; keep one of "
                                     "them",
                                     *name, other.where.line));
    outputs_.push_back({*name, *read, in_.at(wall->column), in_.excerpt()});
  }

  /// Walls may stand below their outputs, so this is done last.
  bool giveOutputs() {
    bool good = true;
    for (const NamedOutput& o : outputs_) {
      const auto wall =
          std::ranges::find_if(walls_.walls, [&](const WallEntry& e) { return e.wall.name == o.wall; });
      if (wall != walls_.walls.end()) {
        wall->output = o.output;
        continue;
      }
      std::vector<std::string> known;
      for (const WallEntry& e : walls_.walls) known.push_back(e.wall.name);
      out_.error(o.where, fmt::format("there is no wall {}{}", quotedWord(o.wall), didYouMean(o.wall, known)),
                 o.excerpt);
      good = false;
    }
    return good;
  }

  struct NamedOutput {
    std::string wall;
    WallOutput output;
    SourcePosition where;
    std::string excerpt;
  };

  std::string file_;
  Diagnostics& out_;
  LineReader in_;
  WallFile walls_;
  PixelSize pixels_;
  std::vector<NamedOutput> outputs_;
  std::vector<std::string> seen_;
  std::size_t lengths_ = 0;
};

std::vector<std::string> shippedNames(const std::string& folder) {
  std::vector<std::string> names;
  for (const std::string& name : namesIn(folder)) {
    const std::filesystem::path file(name);
    if (file.extension() == ".walls") names.push_back(file.stem().string());
  }
  std::ranges::sort(names);
  return names;
}

bool looksLikePath(const std::string& text) {
  return text.find('/') != std::string::npos || text.ends_with(".walls");
}

}  // namespace

std::optional<WallFile> parseWalls(std::string_view text, const std::string& file, Diagnostics& out) {
  return Parser(text, file, out).run();
}

std::optional<WallFile> loadWalls(const std::string& nameOrPath, const std::string& folder,
                                  Diagnostics& out) {
  std::string path = nameOrPath;
  if (!looksLikePath(nameOrPath)) {
    const std::vector<std::string> names = shippedNames(folder);
    if (std::ranges::find(names, nameOrPath) == names.end()) {
      out.error({},
                fmt::format("there are no walls named {}{}", quotedWord(nameOrPath),
                            names.empty() ? fmt::format(" in {}", folder) : didYouMean(nameOrPath, names)));
      return std::nullopt;
    }
    path = (std::filesystem::path(folder) / (nameOrPath + ".walls")).string();
  }
  const Result<std::string> text = readPlainFile(path, kMaxFileBytes);
  if (!text) {
    out.add(text.error());
    return std::nullopt;
  }
  auto walls = parseWalls(text.value(), path, out);
  if (!walls) return std::nullopt;
  Diagnostics findings;
  lintWalls(*walls, findings);
  out.append(findings);
  if (findings.hasErrors()) return std::nullopt;
  return walls;
}

std::string formatWalls(const WallFile& walls) {
  std::string text = fmt::format("unit m\neye-separation {}\nnear {}\nfar {}\n", walls.eyeSeparation,
                                 walls.depth.near, walls.depth.far);
  const auto corner = [](const Vec3& p) { return fmt::format("{} {} {}", p.x(), p.y(), p.z()); };
  for (const WallEntry& entry : walls.walls) {
    text += fmt::format("wall {}  lower-left {}  lower-right {}  upper-left {}", entry.wall.name,
                        corner(entry.wall.lowerLeft), corner(entry.wall.lowerRight),
                        corner(entry.wall.upperLeft));
    if (entry.pixels.width > 0)
      text += fmt::format("  pixels {} {}", entry.pixels.width, entry.pixels.height);
    text += '\n';
    if (entry.output) text += fmt::format("output {}{}\n", entry.wall.name, formatOutput(*entry.output));
  }
  return text;
}

}  // namespace stadion
