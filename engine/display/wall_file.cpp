#include "engine/display/wall_file.h"

#include "engine/base/folder_names.h"
#include "engine/base/plain_file.h"
#include "engine/display/hall_reader.h"
#include "engine/display/hall_statements.h"
#include "engine/display/output_reader.h"
#include "engine/display/wall_lint.h"
#include "engine/display/wall_words.h"
#include "engine/loudspeakers/loudspeaker_text.h"
#include "engine/plain_text/statement_reader.h"
#include "engine/plain_text/suggestion.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

namespace stadion {
namespace {

constexpr std::size_t kMaxFileBytes = 4 << 20;

class WallParser {
public:
  WallParser(std::string_view text, const std::string& file, Diagnostics& out)
      : in_(text, file, out), lengths_(in_), hall_(in_, lengths_, walls_),
        loudspeakers_(
            in_, [this](std::string_view of, Vec3& target) { return lengths_.point(of, target); },
            walls_.loudspeakers) {
    walls_.file = file;
  }

  std::optional<WallFile> run() {
    while (!tooMany_ && !hall_.tooMany() && !loudspeakers_.tooMany() && in_.next())
      in_.read(*this, kStatements);
    if (in_.failed()) return std::nullopt;
    if (walls_.walls.empty()) {
      in_.errorOfFile(walls_.screens.empty()
                          ? "there is no wall in the file; add a line such as: wall front  lower-left -1.5 "
                            "1.5 0  lower-right 1.5 1.5 0  upper-left -1.5 1.5 3"
                          : "the file has screens and no projector; add a line such as: projector one  "
                            "screen NAME  pixels 1920 1200  at X Y Z  look-at X Y Z  throw 1.5");
      return std::nullopt;
    }
    for (WallEntry& entry : walls_.walls)
      if (entry.pixels.width == 0) entry.pixels = pixels_;
    const bool shown = giveOutputs();
    if (!hall_.finish() || !shown) return std::nullopt;
    walls_.loudspeakers.ear = walls_.visitor.eye;
    walls_.loudspeakers.reach = walls_.visitor.reach;
    return std::move(walls_);
  }

private:
  static const Statement<WallParser> kStatements[14];
  static const StatementField<WallParser> kFields[5];

  void unit() {
    const auto unit = lengthUnit(in_);
    if (!unit || !in_.finished()) return;
    if (lengths_.used())
      return in_.error(in_.keyword(), "the unit must stand before the first length; move this line up");
    walls_.metresPerUnit = unit->metres;
    lengths_.setUnit(unit->metres);
  }

  void positive(std::string_view what, double lo, double hi, double& target) {
    const auto value = lengths_.length(what, lo, hi);
    if (value && in_.finished()) target = *value;
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
    in_.error(in_.keyword(),
              fmt::format("near ({} m) must be less than far ({} m)", walls_.depth.near, walls_.depth.far));
    walls_.depth = {};
  }

  void pixels() {
    if (readPixelSize(in_, pixels_)) in_.finished();
  }

  void screen() { hall_.screen(); }
  void projector() { hall_.projector(); }
  void panorama() { hall_.panorama(); }
  void visitor() { hall_.visitor(); }
  void control() { hall_.control(); }
  void loudspeaker() { loudspeakers_.loudspeaker(); }
  void sound() { loudspeakers_.sound(); }

  // The fields of a wall; they fill entry_ and corners_.

  struct Corner {
    const char* name;
    Vec3 Wall::*place;
  };
  static constexpr Corner kCorners[] = {
      {"lower-left", &Wall::lowerLeft}, {"lower-right", &Wall::lowerRight}, {"upper-left", &Wall::upperLeft}};

  bool corner(std::size_t which) {
    if (!lengths_.point(kCorners[which].name, entry_.wall.*kCorners[which].place)) return false;
    return corners_[which] = true;
  }
  bool lowerLeft() { return corner(0); }
  bool lowerRight() { return corner(1); }
  bool upperLeft() { return corner(2); }
  bool wallPixels() { return readPixelSize(in_, entry_.pixels); }
  bool card() { return readCard(in_, entry_.card); }

  void wall() {
    const auto name = in_.name("the wall's name", "a wall");
    if (!name) return;
    const Word nameWord = in_.last();
    entry_ = {};
    corners_ = {};
    entry_.wall.name = *name;
    entry_.line = in_.line();
    entry_.column = nameWord.column;
    entry_.excerpt = in_.excerpt();
    if (!in_.fields(*this, kFields, "a wall")) return;
    for (std::size_t i = 0; i < corners_.size(); ++i)
      if (!corners_[i])
        return in_.errorAtEnd(
            fmt::format("wall \"{}\" has no {}; add: {} X Y Z", *name, kCorners[i].name, kCorners[i].name));
    if (walls_.walls.size() == WallFile::kMaxWalls) return refuseMore("walls");
    for (const WallEntry& other : walls_.walls)
      if (other.wall.name == *name)
        return in_.error(nameWord,
                         fmt::format("there is a {} \"{}\" already, on line {}; give this one another "
                                     "name",
                                     other.noun(), *name, other.line));
    walls_.walls.push_back(std::move(entry_));
  }

  /// Ends the reading: more lines would only repeat the error.
  void refuseMore(std::string_view what) {
    in_.error(in_.keyword(), fmt::format("a file has at most {} {}; delete this line and those after it",
                                         WallFile::kMaxWalls, what));
    tooMany_ = true;
  }

  void output() {
    const auto name = in_.name("the name of the output's wall", "a wall");
    if (!name) return;
    const Word nameWord = in_.last();
    const auto read = readOutput(in_);
    if (!read) return;
    if (outputs_.size() == WallFile::kMaxWalls) return refuseMore("outputs");
    for (const NamedOutput& other : outputs_)
      if (other.wall == *name)
        return in_.error(nameWord, fmt::format("wall \"{}\" has an output already, on line {}; keep one of "
                                               "them",
                                               *name, other.at.where.line));
    outputs_.push_back({*name, *read, in_.place(nameWord)});
  }

  /// Gives each wall its output. Called after the last line, as walls may stand below their outputs.
  bool giveOutputs() {
    bool good = true;
    for (const NamedOutput& o : outputs_) {
      const auto wall =
          std::ranges::find_if(walls_.walls, [&](const WallEntry& e) { return e.wall.name == o.wall; });
      if (wall != walls_.walls.end()) {
        wall->output = o.output;
        continue;
      }
      in_.errorAt(o.at, fmt::format("there is no wall {}{}", quotedWord(o.wall),
                                    didYouMeanOrKnown(o.wall, walls_.names())));
      good = false;
    }
    return good;
  }

  struct NamedOutput {
    std::string wall;
    WallOutput output;
    StatementPlace at;
  };

  StatementReader in_;
  LengthReader lengths_;
  WallFile walls_;
  HallReader hall_;
  LoudspeakerReader loudspeakers_;
  PixelSize pixels_;
  WallEntry entry_;                ///< the wall of this line
  std::array<bool, 3> corners_{};  ///< which of its corners the line has
  std::vector<NamedOutput> outputs_;
  bool tooMany_ = false;  ///< walls or outputs
};

constexpr Statement<WallParser> WallParser::kStatements[14] = {
    {"wall", &WallParser::wall, true},
    {"output", &WallParser::output, true},
    {"unit", &WallParser::unit},
    {"eye-separation", &WallParser::eyeSeparation},
    {"near", &WallParser::near},
    {"far", &WallParser::far},
    {"pixels", &WallParser::pixels},
    {"screen", &WallParser::screen, true},
    {"projector", &WallParser::projector, true},
    {"panorama", &WallParser::panorama, true},
    {"visitor", &WallParser::visitor},
    {"control", &WallParser::control, true},
    {"loudspeaker", &WallParser::loudspeaker, true},
    {"sound", &WallParser::sound}};

constexpr StatementField<WallParser> WallParser::kFields[5] = {{"lower-left", &WallParser::lowerLeft},
                                                               {"lower-right", &WallParser::lowerRight},
                                                               {"upper-left", &WallParser::upperLeft},
                                                               {"pixels", &WallParser::wallPixels},
                                                               {"card", &WallParser::card}};

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

bool namesFiles(const WallFile& walls) {
  return std::ranges::any_of(walls.screens,
                             [](const Screen& s) { return std::holds_alternative<MeshScreen>(s.surface); }) ||
         std::ranges::any_of(walls.walls, [](const WallEntry& e) {
           return e.projector && std::holds_alternative<MeasuredImage>(e.projector->image);
         });
}

std::string_view unitName(double metres) {
  for (const LengthUnit& unit : kLengthUnits)
    if (unit.metres == metres) return unit.name;
  return "m";
}

std::string formatWall(const WallEntry& entry, double unit) {
  const auto corner = [&](const Vec3& p) {
    return fmt::format("{} {} {}", p.x() / unit, p.y() / unit, p.z() / unit);
  };
  std::string text =
      fmt::format("wall {}  lower-left {}  lower-right {}  upper-left {}", entry.wall.name,
                  corner(entry.wall.lowerLeft), corner(entry.wall.lowerRight), corner(entry.wall.upperLeft));
  if (entry.pixels.width > 0) text += fmt::format("  pixels {} {}", entry.pixels.width, entry.pixels.height);
  if (entry.card) text += fmt::format("  card {}", *entry.card);
  return text + '\n';
}

}  // namespace

std::optional<WallFile> parseWalls(std::string_view text, const std::string& file, Diagnostics& out) {
  return WallParser(text, file, out).run();
}

std::optional<WallFile> loadWalls(const std::string& nameOrPath, const std::string& folder,
                                  Diagnostics& out) {
  std::string path = nameOrPath;
  if (!looksLikePath(nameOrPath)) {
    const std::vector<std::string> names = shippedNames(folder);
    if (std::ranges::find(names, nameOrPath) == names.end()) {
      out.error({}, fmt::format("there are no walls named {}{}", quotedWord(nameOrPath),
                                names.empty() ? fmt::format(" in {}", folder)
                                              : didYouMeanOrKnown(nameOrPath, names)));
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
  if (!walls || !loadHallFiles(*walls, out)) return std::nullopt;
  Diagnostics findings;
  lintWalls(*walls, findings);
  out.append(findings);
  if (findings.hasErrors()) return std::nullopt;
  return walls;
}

std::string formatWalls(const WallFile& walls) {
  // Files that the hall names have lengths in the unit of the wall file.
  const bool named = namesFiles(walls);
  const double unit = named ? walls.metresPerUnit : 1;
  std::string text = fmt::format("unit {}\neye-separation {}\nnear {}\nfar {}\n", unitName(unit),
                                 walls.eyeSeparation / unit, walls.depth.near / unit, walls.depth.far / unit);
  const bool hall = !std::ranges::all_of(walls.walls, &WallEntry::isFlat);
  if (hall || !walls.screens.empty() || !walls.loudspeakers.empty())
    text += formatVisitor(walls.visitor, unit);
  for (const Screen& screen : walls.screens) text += formatScreen(screen, unit);
  for (const WallEntry& entry : walls.walls) {
    text += entry.projector  ? formatProjector(entry, walls.screens[entry.projector->screen].name, unit)
            : entry.panorama ? formatPanorama(entry, unit)
                             : formatWall(entry, unit);
    if (entry.output) text += fmt::format("output {}{}\n", entry.wall.name, formatOutput(*entry.output));
    if (entry.control)
      text += fmt::format("control {}  {}\n", entry.wall.name, formatControl(*entry.control));
  }
  return text + formatLoudspeakers(walls.loudspeakers, unit);
}

}  // namespace stadion
