#include "show/adjust/hall_adjuster.h"

#include "engine/base/atomic_file.h"
#include "engine/base/plain_file.h"
#include "engine/plain_text/suggestion.h"
#include "engine/plain_text/text_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr std::size_t kMostWallFileBytes = 4 << 20;
constexpr double kFarthestPin = 10;  ///< as wall files have it
constexpr std::size_t kMostUndo = 10000;
constexpr const char* kPinNames[] = {"upper left", "upper right", "lower right", "lower left"};
constexpr PixelSize kUnknownOutput{1920, 1080};  ///< of an output that states no size

std::array<double, 8> flat(const std::array<Vec2, 4>& pins) {
  std::array<double, 8> values{};
  for (std::size_t i = 0; i < 8; ++i) values[i] = pins[i / 2][static_cast<int>(i % 2)];
  return values;
}

std::array<Vec2, 4> pinsFrom(const std::array<double, 8>& values) {
  std::array<Vec2, 4> pins;
  for (std::size_t i = 0; i < 8; ++i) pins[i / 2][static_cast<int>(i % 2)] = values[i];
  return pins;
}

}  // namespace

Result<HallAdjuster> HallAdjuster::open(const WallFile& hall) {
  using Opened = Result<HallAdjuster>;
  if (!hall.file.ends_with(".walls"))
    return Opened::failure(
        fmt::format("{} is no wall file, and numbers are written back to wall files only; convert "
                    "it first: stadion walls {} --write hall.walls",
                    hall.file, hall.file));
  const Result<std::string> text = readPlainFile(hall.file, kMostWallFileBytes);
  if (!text) return text.error();
  HallAdjuster adjuster(hall, text.value());
  if (adjuster.entries_.empty())
    return Opened::failure(
        fmt::format("{} has nothing to adjust: corner pins and edges belong to projectors, and to "
                    "walls with an output",
                    hall.file));
  adjuster.choose(0);
  adjuster.message_.clear();
  return adjuster;
}

HallAdjuster::HallAdjuster(const WallFile& hall, std::string text)
    : hall_(hall), text_(text), saved_(std::move(text)) {
  for (std::size_t i = 0; i < hall_.walls.size(); ++i)
    if (pinsOf(i) || hasEdges(i)) entries_.push_back(i);
}

bool HallAdjuster::hasEdges(std::size_t entry) const {
  const auto& projector = hall_.walls[entry].projector;
  return projector && !std::holds_alternative<FisheyeImage>(projector->image);
}

std::optional<std::array<Vec2, 4>> HallAdjuster::pinsOf(std::size_t entry) const {
  const WallEntry& e = hall_.walls[entry];
  if (e.projector) {
    const auto* pinned = std::get_if<PinnedImage>(&e.projector->image);
    return pinned ? std::optional(pinned->pins) : std::nullopt;
  }
  if (e.panorama || !e.output) return std::nullopt;
  return e.output->shape.warp.value_or(std::array<Vec2, 4>{Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)});
}

void HallAdjuster::setPins(std::size_t entry, const std::array<double, 8>& values) {
  WallEntry& e = hall_.walls[entry];
  if (e.projector)
    std::get<PinnedImage>(e.projector->image).pins = pinsFrom(values);
  else
    e.output->shape.warp = pinsFrom(values);
}

void HallAdjuster::setEdges(std::size_t entry, const std::array<double, 8>& values) {
  std::copy_n(values.begin(), 4, hall_.walls[entry].projector->blend.edges.begin());
}

PixelSize HallAdjuster::sizeOf(std::size_t entry) const {
  const WallEntry& e = hall_.walls[entry];
  if (e.projector) return e.outputSize();
  if (e.output && e.output->place.rectangle)
    return {e.output->place.rectangle->width, e.output->place.rectangle->height};
  return e.pixels.width > 0 ? e.pixels : kUnknownOutput;
}

std::optional<std::size_t> HallAdjuster::pin() const {
  return handle_.isEdge ? std::nullopt : std::optional(handle_.number);
}

std::optional<PictureEdge> HallAdjuster::edge() const {
  return handle_.isEdge ? std::optional(static_cast<PictureEdge>(handle_.number)) : std::nullopt;
}

void HallAdjuster::choose(std::size_t number) {
  chosen_ = number;
  const bool pinned = pinsOf(chosen()).has_value();
  if (handle_.isEdge ? !hasEdges(chosen()) : !pinned) handle_ = {!pinned, 0};
  message_ = "chosen";
}

AdjustOutcome HallAdjuster::apply(const AdjustCommand& command) {
  using Kind = AdjustCommand::Kind;
  const bool quits = command.kind == Kind::Quit;
  if (!quits) asked_ = false;
  message_.clear();
  switch (command.kind) {
  case Kind::Next: choose((chosen_ + 1) % entries_.size()); break;
  case Kind::Previous: choose((chosen_ + entries_.size() - 1) % entries_.size()); break;
  case Kind::Projector: {
    std::vector<std::string> names;
    for (const std::size_t entry : entries_) names.push_back(hall_.walls[entry].wall.name);
    const auto at = std::ranges::find(names, command.name);
    if (at == names.end())
      return refuse(fmt::format("there is nothing to adjust at {}{}", quotedWord(command.name),
                                didYouMeanOrKnown(command.name, names)));
    choose(static_cast<std::size_t>(at - names.begin()));
    break;
  }
  case Kind::Pin:
    if (!pins()) return refuse("it has no corner pins");
    handle_ = {false, command.number};
    break;
  case Kind::Edge:
    if (!hasEdges(chosen())) return refuse("it has no edges");
    handle_ = {true, command.number};
    break;
  case Kind::Move: return move(command.right, command.down);
  case Kind::Undo: return goBack();
  case Kind::Redo: return goForward();
  case Kind::Save: return save();
  case Kind::Quit: return quit();
  case Kind::Show: break;
  }
  return {};
}

AdjustOutcome HallAdjuster::move(double right, double down) {
  const PixelSize size = sizeOf(chosen());
  const Vec2 by(right / size.width, down / size.height);
  return handle_.isEdge ? moveEdge(by) : movePin(by);
}

AdjustOutcome HallAdjuster::movePin(const Vec2& by) {
  const std::size_t entry = chosen();
  Change change{.entry = entry, .isEdge = false, .before = flat(*pinsOf(entry)), .after = {}, .line = {}};
  change.after = change.before;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    double& value = change.after[2 * handle_.number + axis];
    value = asWritten(std::clamp(value + by[static_cast<int>(axis)], -kFarthestPin, kFarthestPin));
  }
  if (!squareToQuad(pinsFrom(change.after))) {
    return refuse("there the corners would make no picture");
  }
  const bool projector = hall_.walls[entry].projector.has_value();
  return keep(change, projector ? "projector" : "output", projector ? "pins" : "warp", change.after);
}

AdjustOutcome HallAdjuster::moveEdge(const Vec2& by) {
  const std::size_t entry = chosen();
  const auto which = static_cast<PictureEdge>(handle_.number);
  const bool across = which == PictureEdge::Left || which == PictureEdge::Right;
  const bool inwards = which == PictureEdge::Left || which == PictureEdge::Top;
  const double step = across ? by.x() : by.y();
  if (step == 0) {
    return refuse(across ? "this edge moves to the left and right" : "this edge moves up and down");
  }
  Change change{.entry = entry, .isEdge = true, .before = {}, .after = {}, .line = {}};
  std::ranges::copy(hall_.walls[entry].projector->blend.edges, change.before.begin());
  change.after = change.before;
  double& share = change.after[handle_.number];
  share = asWritten(std::clamp(share + (inwards ? step : -step), 0.0, kMostEdge));
  return keep(change, "projector", fmt::format("edge-{}", edgeName(which)),
              std::span(change.after).subspan(handle_.number, 1));
}

AdjustOutcome HallAdjuster::keep(Change change, std::string_view statement, std::string_view field,
                                 std::span<const double> values) {
  if (change.after == change.before) {
    return refuse("it goes no farther");
  }
  auto line = text_.set(statement, hall_.walls[change.entry].wall.name, field, values);
  if (!line) {
    return refuse("the statement was not found in the file");
  }
  change.line = std::move(*line);
  (change.isEdge ? setEdges(change.entry, change.after) : setPins(change.entry, change.after));
  undone_.clear();
  if (done_.size() == kMostUndo) done_.erase(done_.begin());
  done_.push_back(std::move(change));
  message_ = "moved";
  return {.changed = done_.back().entry, .ended = false, .refused = false};
}

AdjustOutcome HallAdjuster::write(const Change& change, const std::array<double, 8>& values,
                                  const char* did) {
  (change.isEdge ? setEdges(change.entry, values) : setPins(change.entry, values));
  choose(static_cast<std::size_t>(std::ranges::find(entries_, change.entry) - entries_.begin()));
  if (handle_.isEdge != change.isEdge) handle_ = {change.isEdge, 0};
  for (std::size_t i = 0; i < 8; ++i)
    if (change.before[i] != change.after[i]) handle_.number = change.isEdge ? i : i / 2;
  message_ = did;
  return {.changed = change.entry, .ended = false, .refused = false};
}

AdjustOutcome HallAdjuster::goBack() {
  if (done_.empty()) {
    return refuse("there is nothing to undo");
  }
  undone_.push_back(std::move(done_.back()));
  done_.pop_back();
  text_.undo(undone_.back().line);
  return write(undone_.back(), undone_.back().before, "undone");
}

AdjustOutcome HallAdjuster::goForward() {
  if (undone_.empty()) {
    return refuse("there is nothing to redo");
  }
  done_.push_back(std::move(undone_.back()));
  undone_.pop_back();
  text_.redo(done_.back().line);
  return write(done_.back(), done_.back().after, "redone");
}

AdjustOutcome HallAdjuster::refuse(std::string why) {
  message_ = std::move(why);
  return {.changed = {}, .ended = false, .refused = true};
}

AdjustOutcome HallAdjuster::save() {
  const std::string text = text_.text();
  const Result<std::string> there = readPlainFile(hall_.file, kMostWallFileBytes);
  if (!there) return refuse(fmt::format("not saved: {}", there.error().message));
  if (there.value() != saved_)
    return refuse(fmt::format("not saved: {} has been changed by somebody else since it was read; quit, then "
                              "start --adjust on the new file",
                              hall_.file));
  Diagnostics findings;
  if (!parseWalls(text, hall_.file, findings))
    return refuse(fmt::format("not saved: {}", findings.all().empty() ? "" : findings.all()[0].message));
  if (const auto wrong = writeFile(hall_.file, text))
    return refuse(fmt::format("not saved: {}", wrong->message));
  saved_ = text;
  message_ = "saved";
  return {};
}

AdjustOutcome HallAdjuster::quit() {
  if (!unsaved() || asked_) return {.changed = {}, .ended = true, .refused = false};
  asked_ = true;
  message_ = "changes are not saved: save, or quit again to leave them";
  return {};
}

std::string HallAdjuster::state() const {
  const PixelSize size = sizeOf(chosen());
  std::string text = hall_.walls[chosen()].wall.name + ": ";
  if (handle_.isEdge) {
    const auto which = static_cast<PictureEdge>(handle_.number);
    const bool across = which == PictureEdge::Left || which == PictureEdge::Right;
    const double share = hall_.walls[chosen()].projector->blend.edges[handle_.number];
    text += fmt::format("edge {} at {} ({:.1f} pixels)", edgeName(which), numberText(share),
                        share * (across ? size.width : size.height));
  } else {
    const Vec2 place = (*pins())[handle_.number];
    text += fmt::format("pin {} ({}) at {} {} ({:.1f} {:.1f} pixels)", handle_.number + 1,
                        kPinNames[handle_.number], numberText(place.x()), numberText(place.y()),
                        place.x() * size.width, place.y() * size.height);
  }
  if (!message_.empty()) text += "; " + message_;
  if (unsaved()) text += " [not saved]";
  return text;
}

}  // namespace stadion
