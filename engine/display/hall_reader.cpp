#include "engine/display/hall_reader.h"

#include "engine/display/covered_rectangle.h"
#include "engine/display/hall_statements.h"
#include "engine/plain_text/suggestion.h"

#include <algorithm>

namespace stadion {

bool HallReader::refuseMore(std::size_t count, std::size_t most, std::string_view what) {
  if (count < most) return false;
  in_.error(in_.keyword(),
            fmt::format("a file has at most {} {}; delete this line and those after it", most, what));
  return tooMany_ = true;
}

void HallReader::screen() {
  const auto name = in_.name("the screen's name", "a screen");
  if (!name) return;
  const Word nameWord = in_.last();
  Screen screen;
  screen.name = *name;
  screen.line = in_.line();
  screen.column = nameWord.column;
  screen.excerpt = in_.excerpt();
  if (!readScreen(in_, lengths_, screen)) return;
  if (refuseMore(hall_.screens.size(), WallFile::kMaxScreens, "screens")) return;
  for (const Screen& other : hall_.screens)
    if (other.name == *name)
      return in_.error(nameWord, fmt::format("there is a screen \"{}\" already, on line {}; give this one "
                                             "another name",
                                             *name, other.line));
  hall_.screens.push_back(std::move(screen));
}

std::optional<HallReader::NamedEntry> HallReader::namedEntry(const char* what, const char* whose) {
  const auto name = in_.name(what, whose);
  if (!name) return std::nullopt;
  NamedEntry named{{}, in_.last()};
  named.entry.wall.name = *name;
  named.entry.line = in_.line();
  named.entry.column = named.name.column;
  named.entry.excerpt = in_.excerpt();
  return named;
}

void HallReader::projector() {
  auto named = namedEntry("the projector's name", "a projector");
  if (!named) return;
  auto& [entry, nameWord] = *named;
  const auto screen = readProjector(in_, lengths_, entry);
  if (!screen || !add(std::move(entry), nameWord)) return;
  links_.push_back({hall_.walls.size() - 1, screen->name, screen->at, in_.place(nameWord)});
}

void HallReader::panorama() {
  auto named = namedEntry("the panorama's name", "a panorama");
  if (!named) return;
  auto& [entry, nameWord] = *named;
  if (!readPanorama(in_, lengths_, entry) || !add(std::move(entry), nameWord)) return;
  panoramas_.push_back({hall_.walls.size() - 1, in_.place(nameWord)});
}

bool HallReader::add(WallEntry entry, const Word& name) {
  if (refuseMore(hall_.walls.size(), WallFile::kMaxWalls, "walls and projectors")) return false;
  for (const WallEntry& other : hall_.walls)
    if (other.wall.name == entry.wall.name) {
      in_.error(name, fmt::format("there is a {} \"{}\" already, on line {}; give this one another name",
                                  other.noun(), entry.wall.name, other.line));
      return false;
    }
  hall_.walls.push_back(std::move(entry));
  return true;
}

void HallReader::visitor() {
  VisitorPlace visitor;
  if (!lengths_.point("the visitor's eyes", visitor.eye)) return;
  if (in_.more()) {
    static constexpr std::string_view kWithin[] = {"within"};
    if (!in_.choice("the reach", kWithin)) return;
    const auto reach = lengths_.length("the reach", 0, 100);
    if (!reach || !in_.finished()) return;
    visitor.reach = *reach;
  }
  hall_.visitor = visitor;
}

constexpr StatementField<HallReader> HallReader::kControlFields[2] = {
    {"port", &HallReader::controlPort}, {"password", &HallReader::controlPassword}};

bool HallReader::controlPort() {
  const auto port = in_.count("the port", 1, 65535);
  if (port) controls_.back().control.port = static_cast<std::uint16_t>(*port);
  return port.has_value();
}

bool HallReader::controlPassword() {
  const Word* file = in_.word("the file that has the password");
  if (file) controls_.back().control.passwordFile = std::string(file->text.substr(0, 1000));
  return file != nullptr;
}

void HallReader::control() {
  const auto name = in_.name("the name of a wall or projector", "a wall");
  if (!name) return;
  const Word nameWord = in_.last();
  static constexpr std::string_view kProtocols[] = {"pjlink"};
  if (!in_.choice("the protocol", kProtocols)) return;
  const Word* host = in_.word("the projector's host");
  if (!host) return;
  for (const NamedControl& other : controls_)
    if (other.wall == *name)
      return in_.error(nameWord, fmt::format("\"{}\" has a control already, on line {}; keep one of them",
                                             *name, other.at.where.line));
  if (refuseMore(controls_.size(), WallFile::kMaxWalls, "controls")) return;
  ProjectorControl control;
  control.host = std::string(host->text.substr(0, 253));
  controls_.push_back({*name, std::move(control), in_.place(nameWord)});
  if (!in_.fields(*this, kControlFields, "a control")) controls_.pop_back();
}

bool HallReader::giveControls() {
  bool good = true;
  for (NamedControl& one : controls_) {
    const auto entry =
        std::ranges::find_if(hall_.walls, [&](const WallEntry& e) { return e.wall.name == one.wall; });
    if (entry != hall_.walls.end()) {
      entry->control = std::move(one.control);
      continue;
    }
    in_.errorAt(one.at, fmt::format("there is no wall or projector {}{}", quotedWord(one.wall),
                                    didYouMeanOrKnown(one.wall, hall_.names())));
    good = false;
  }
  return good;
}

bool HallReader::finish() {
  bool good = giveControls();
  for (const ScreenOfProjector& one : links_) good = link(one) && good;
  for (const NamedPanorama& one : panoramas_) good = giveSize(one) && good;
  if (good) placeRectangles(hall_);
  return good;
}

bool HallReader::giveSize(const NamedPanorama& panorama) {
  const WallEntry& entry = hall_.walls[panorama.entry];
  Panorama& p = *hall_.walls[panorama.entry].panorama;
  p.width = entry.pixels.width;
  p.height = entry.pixels.height;
  if (p.width == 0) {
    in_.errorAt(panorama.at,
                fmt::format("panorama \"{}\" has no size; add: pixels WIDTH HEIGHT, here or as a "
                            "line for all",
                            entry.wall.name));
    return false;
  }
  if (sizeFits(p)) return true;
  const Panorama near = withWidth(p, p.width);
  in_.errorAt(
      panorama.at,
      fmt::format("the six squares of a cube stand in three columns and two rows, each with a multiple of "
                  "{} pixels along its side, and {} x {} pixels are not that; write: pixels {} {}",
                  kCubeStep, p.width, p.height, near.width, near.height));
  return false;
}

bool HallReader::link(const ScreenOfProjector& link) {
  WallEntry& entry = hall_.walls[link.entry];
  Projector& projector = *entry.projector;
  const auto screen = std::ranges::find(hall_.screens, link.screen, &Screen::name);
  if (screen == hall_.screens.end()) {
    std::vector<std::string> known;
    for (const Screen& s : hall_.screens) known.push_back(s.name);
    in_.errorAt(link.at, fmt::format("there is no screen {}{}", quotedWord(link.screen),
                                     known.empty() ? "; add a line such as: screen " + link.screen +
                                                         " plane  lower-left X Y Z  lower-right X Y Z  "
                                                         "upper-left X Y Z"
                                                   : didYouMeanOrKnown(link.screen, known)));
    return false;
  }
  projector.screen = static_cast<std::size_t>(screen - hall_.screens.begin());
  projector.width = entry.pixels.width;
  projector.height = entry.pixels.height;
  if (projector.width == 0) {
    in_.errorAt(link.projector,
                fmt::format("projector \"{}\" has no size; add: pixels WIDTH HEIGHT, here or as "
                            "a line for all",
                            entry.wall.name));
    return false;
  }
  if (std::holds_alternative<PinnedImage>(projector.image) &&
      !std::holds_alternative<Wall>(screen->surface)) {
    in_.errorAt(link.projector,
                fmt::format("pins fit plane screens only, and screen \"{}\" is none; use warp FILE.pfm",
                            screen->name));
    return false;
  }
  if (entry.output && entry.output->shape.warp) {
    in_.errorAt(link.projector, fmt::format("projector \"{}\" has an output with warp; leave that warp out: "
                                            "the projector's own image bends the picture",
                                            entry.wall.name));
    return false;
  }
  return true;
}

}  // namespace stadion
