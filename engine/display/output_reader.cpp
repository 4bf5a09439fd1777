#include "engine/display/output_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <span>

namespace stadion {
namespace {

class OutputReader {
public:
  explicit OutputReader(StatementReader& in) : in_(in) {}

  std::optional<WallOutput> run() {
    if (!in_.fields(*this, kFields, "an output") || !agree()) return std::nullopt;
    return output_;
  }

private:
  static const StatementField<OutputReader> kFields[12];

  bool wrong(const Word& at, std::string message) {
    in_.error(at, std::move(message));
    return false;
  }

  bool text(std::string_view what, std::string& target) {
    const Word* w = in_.word(what);
    if (w) target = std::string(w->text.substr(0, 64));
    return w != nullptr;
  }

  bool screen() {
    const Word* w = in_.word("an X screen, such as :0.1");
    if (!w) return false;
    const std::string_view s = w->text;
    const auto digits = [](std::string_view t) {
      return !t.empty() && t.size() < 6 && t.find_first_not_of("0123456789") == t.npos;
    };
    const std::size_t dot = s.find('.');
    const bool good = s.size() > 1 && s[0] == ':' && digits(s.substr(1, dot == s.npos ? dot : dot - 1)) &&
                      (dot == s.npos || digits(s.substr(dot + 1)));
    if (!good) return wrong(*w, quotedWord(s) + " is not an X screen; write :DISPLAY.SCREEN, such as :0.1");
    output_.place.screen = std::string(s);
    return true;
  }
  bool monitor() { return text("a monitor's name or number", output_.place.monitor); }
  bool rectangle() {
    const auto x = in_.whole("x of the rectangle [pixels]", -32768, 32767);
    const auto y = x ? in_.whole("y of the rectangle [pixels]", -32768, 32767) : x;
    const auto w = y ? in_.whole("the width of the rectangle [pixels]", 1, 16384) : y;
    const auto h = w ? in_.whole("the height of the rectangle [pixels]", 1, 16384) : w;
    if (!h) return false;
    output_.place.rectangle = {static_cast<std::int32_t>(*x), static_cast<std::int32_t>(*y),
                               static_cast<std::uint32_t>(*w), static_cast<std::uint32_t>(*h)};
    return true;
  }
  bool fullscreen() { return output_.place.fullscreen = true; }
  bool refresh() {
    const auto hz = in_.whole("the refresh rate [1/s]", 1, 1000);
    if (hz) output_.place.refresh = static_cast<std::uint32_t>(*hz);
    return hz.has_value();
  }
  bool flipH() { return output_.shape.flipH = true; }
  bool flipV() { return output_.shape.flipV = true; }
  bool swapEyes() { return output_.shape.swapEyes = true; }
  bool rotate() {
    const Word* w = in_.word("90, 180 or 270");
    if (!w) return false;
    for (const std::uint32_t degrees : {0u, 90u, 180u, 270u})
      if (w->text == std::to_string(degrees)) {
        output_.shape.rotate = degrees;
        return true;
      }
    return wrong(*w, quotedWord(w->text) +
                         " is not a turn that a picture can make; write 90, 180 or 270 (clockwise)");
  }

  /// One number for all channels, or three.
  bool channels(std::string_view what, double lo, double hi, std::array<double, 3>& target) {
    const auto first = in_.number(what, lo, hi);
    if (!first) return false;
    target.fill(*first);
    if (!numberFollows()) return true;
    for (const std::size_t i : {1u, 2u}) {
      const auto value = in_.number(fmt::format("{} of {}", what, i == 1 ? "green" : "blue"), lo, hi);
      if (!value) return false;
      target[i] = *value;
    }
    return true;
  }
  bool numberFollows() const {
    if (!in_.more()) return false;
    const char c = in_.peek()->text[0];
    return (c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.';
  }
  bool gamma() { return channels("gamma", 0.1, 10, output_.shape.gamma); }
  bool brightness() { return channels("brightness", 0, 1, output_.shape.brightness); }

  bool warp() {
    const Word key = in_.last();
    std::array<Vec2, 4> corners;
    constexpr const char* kNames[] = {"upper left", "upper right", "lower right", "lower left"};
    for (std::size_t i = 0; i < 4; ++i)
      for (int axis = 0; axis < 2; ++axis) {
        const auto value =
            in_.number(fmt::format("{} of the {} corner", axis == 0 ? "x" : "y", kNames[i]), -1, 2);
        if (!value) return false;
        corners[i][axis] = *value;
      }
    if (!squareToQuad(corners))
      return wrong(key,
                   "the corners of warp make no picture; give upper left, upper right, lower right, lower "
                   "left, as shares of the output from its upper left corner (0 0  1 0  1 1  0 1 changes "
                   "nothing)");
    output_.shape.warp = corners;
    return true;
  }

  /// What does not go together.
  bool agree() {
    const OutputPlace& p = output_.place;
    const char* what = nullptr;
    if (p.fullscreen && p.rectangle)
      what = "an output has a rectangle or is fullscreen, not both; leave one of them out";
    else if (p.refresh > 0 && !p.fullscreen)
      what = "only a fullscreen output can choose its refresh rate; add fullscreen, or leave refresh out";
    if (!what) return true;
    in_.error(in_.keyword(), what);
    return false;
  }

  StatementReader& in_;
  WallOutput output_;
};

constexpr StatementField<OutputReader> OutputReader::kFields[12] = {
    {"screen", &OutputReader::screen},         {"monitor", &OutputReader::monitor},
    {"rectangle", &OutputReader::rectangle},   {"fullscreen", &OutputReader::fullscreen},
    {"refresh", &OutputReader::refresh},       {"flip-h", &OutputReader::flipH},
    {"flip-v", &OutputReader::flipV},          {"rotate", &OutputReader::rotate},
    {"swap-eyes", &OutputReader::swapEyes},    {"gamma", &OutputReader::gamma},
    {"brightness", &OutputReader::brightness}, {"warp", &OutputReader::warp}};

std::string channelsText(const char* name, const std::array<double, 3>& v) {
  return v == std::array<double, 3>{1, 1, 1} ? "" : fmt::format("  {} {} {} {}", name, v[0], v[1], v[2]);
}

}  // namespace

std::optional<WallOutput> readOutput(StatementReader& in) {
  return OutputReader(in).run();
}

std::string formatOutput(const WallOutput& output) {
  const OutputPlace& p = output.place;
  const OutputShape& s = output.shape;
  std::string text;
  if (!p.screen.empty()) text += "  screen " + p.screen;
  if (!p.monitor.empty()) text += "  monitor " + p.monitor;
  if (p.rectangle)
    text += fmt::format("  rectangle {} {} {} {}", p.rectangle->x, p.rectangle->y, p.rectangle->width,
                        p.rectangle->height);
  if (p.fullscreen) text += "  fullscreen";
  if (p.refresh > 0) text += fmt::format("  refresh {}", p.refresh);
  if (s.flipH) text += "  flip-h";
  if (s.flipV) text += "  flip-v";
  if (s.rotate > 0) text += fmt::format("  rotate {}", s.rotate);
  if (s.swapEyes) text += "  swap-eyes";
  text += channelsText("gamma", s.gamma) + channelsText("brightness", s.brightness);
  if (s.warp) {
    text += "  warp";
    for (const Vec2& c : *s.warp) text += fmt::format(" {} {}", c.x(), c.y());
  }
  return text;
}

}  // namespace stadion
