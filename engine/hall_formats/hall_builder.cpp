#include "engine/hall_formats/hall_builder.h"

#include "engine/plain_text/text_line.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace stadion {
namespace {

constexpr std::size_t kMostNameCharacters = 32;
constexpr std::size_t kMostUnknownNamed = 40;

bool isGoodInName(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_' ||
         c == '.';
}

}  // namespace

HallBuilder::HallBuilder(std::string file, Diagnostics& out) : out_(out) {
  hall_.file = std::move(file);
}

std::string HallBuilder::goodName(const std::string& name, const std::string& otherwise,
                                  std::set<std::string>& taken) {
  std::string good;
  for (const char c : name.substr(0, kMostNameCharacters)) good += isGoodInName(c) ? c : '-';
  while (!good.empty() && (good[0] == '-' || good[0] == '.')) good.erase(0, 1);
  if (good.empty()) good = otherwise;
  const std::string stem = good.substr(0, kMostNameCharacters - 6);
  for (int n = 2; !taken.insert(good).second; ++n) good = fmt::format("{}-{}", stem, n);
  if (good != name && !name.empty() && renamed_.emplace(name, good).second)
    note(fmt::format("{} is named {} here", quotedWord(name), quotedWord(good)));
  return good;
}

std::size_t HallBuilder::addScreen(Screen screen) {
  if (hall_.screens.size() == WallFile::kMaxScreens && !failed_)
    error(fmt::format("the file has too many screens; at most {} are allowed", WallFile::kMaxScreens));
  if (failed_) return 0;
  screen.name = goodName(screen.name, "screen", screenNames_);
  if (auto* wall = std::get_if<Wall>(&screen.surface)) wall->name = screen.name;
  hall_.screens.push_back(std::move(screen));
  return hall_.screens.size() - 1;
}

void HallBuilder::add(WallEntry entry) {
  if (hall_.walls.size() == WallFile::kMaxWalls && !failed_)
    error(fmt::format("the file has too many walls and projectors; at most {} are allowed",
                      WallFile::kMaxWalls));
  if (failed_) return;
  entry.wall.name = goodName(entry.wall.name, "view", wallNames_);
  hall_.walls.push_back(std::move(entry));
}

void HallBuilder::notUnderstood(const SourcePosition& where, const std::string& place,
                                const std::string& effect) {
  if (++unknown_ <= kMostUnknownNamed)
    out_.warning(where, fmt::format("{} is not understood; {}", printable(place, 200), effect));
}

void HallBuilder::notOfHall(const std::string& name) {
  if (notOfHall_.size() < 100) notOfHall_.insert(printable(name, 80));
}

void HallBuilder::error(std::string message, std::uint32_t line) {
  out_.error({hall_.file, line, 0}, std::move(message));
  failed_ = true;
}

void HallBuilder::warning(std::string message, std::uint32_t line) {
  out_.warning({hall_.file, line, 0}, std::move(message));
}

void HallBuilder::note(std::string message, std::uint32_t line) {
  out_.note({hall_.file, line, 0}, std::move(message));
}

std::optional<WallFile> HallBuilder::finish() {
  if (unknown_ > kMostUnknownNamed)
    warning(fmt::format("{} more places are not understood", unknown_ - kMostUnknownNamed));
  if (!notOfHall_.empty())
    note(fmt::format("these settings say nothing about the hall: {}", fmt::join(notOfHall_, ", ")));
  if (!failed_ && hall_.walls.empty()) error("no picture of the file can be shown here");
  if (failed_) return std::nullopt;
  return std::move(hall_);
}

Projector fillingProjector(std::size_t screen, PixelSize pixels) {
  Projector projector;
  projector.screen = screen;
  projector.width = pixels.width;
  projector.height = pixels.height;
  projector.image = PinnedImage{{Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)}};
  return projector;
}

Wall wallOfEdges(const Vec3& lowerLeft, const Vec3& right, const Vec3& up) {
  Wall wall;
  wall.lowerLeft = lowerLeft;
  wall.lowerRight = lowerLeft + right;
  wall.upperLeft = lowerLeft + up;
  return wall;
}

}  // namespace stadion
