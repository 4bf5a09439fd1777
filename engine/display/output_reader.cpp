#include "engine/display/output_reader.h"

#include "engine/unicode/likeness.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <span>

namespace stadion {
namespace {

class OutputReader {
public:
  explicit OutputReader(LineReader& in) : in_(in) {}

  std::optional<WallOutput> run(std::size_t first) {
    next_ = first;
    while (next_ < in_.words().size())
      if (!field()) return std::nullopt;
    if (!agree()) return std::nullopt;
    return output_;
  }

private:
  struct Field {
    const char* name;
    bool (OutputReader::*read)();
  };
  static constexpr std::size_t kFieldCount = 12;
  static const std::array<Field, kFieldCount>& fields();

  bool field() {
    const Word& key = in_.words()[next_++];
    for (const Field& f : fields()) {
      if (key.text != f.name) continue;
      if (std::ranges::find(given_, f.name) != given_.end())
        return wrong(key, fmt::format("\"{}\" is given twice for this output; keep one of them", f.name));
      given_.emplace_back(f.name);
      return (this->*f.read)();
    }
    std::vector<std::string> known;
    for (const Field& f : fields()) known.emplace_back(f.name);
    const auto near = closest(std::string(key.text.substr(0, 64)), known);
    return wrong(key, quotedWord(key.text) + " is not a field of an output" +
                          (near ? "; " + didYouMeanOne(std::string(key.text), *near)
                                : fmt::format("; known are {}", fmt::join(known, ", "))));
  }

  bool wrong(const Word& at, std::string message) {
    in_.error(at.column, std::move(message));
    return false;
  }

  const Word* word(std::string_view what) {
    if (next_ < in_.words().size()) return &in_.words()[next_++];
    in_.error(in_.endColumn(), fmt::format("{} is missing", what));
    return nullptr;
  }

  std::optional<double> number(std::string_view what, double lo, double hi) {
    const Word* w = word(what);
    if (!w) return std::nullopt;
    const auto value = in_.number(*w, what);
    if (value && !(*value >= lo && *value <= hi))
      return wrong(*w, fmt::format("{} must be from {} to {}, not {}", what, lo, hi, *value)), std::nullopt;
    return value;
  }

  bool text(std::string_view what, std::string& target) {
    const Word* w = word(what);
    if (w) target = std::string(w->text.substr(0, 64));
    return w != nullptr;
  }

  bool screen() {
    const Word* w = word("an X screen, such as :0.1");
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
    const auto x = whole("x of the rectangle [pixels]", -32768, 32767);
    const auto y = x ? whole("y of the rectangle [pixels]", -32768, 32767) : x;
    const auto w = y ? whole("the width of the rectangle [pixels]", 1, 16384) : y;
    const auto h = w ? whole("the height of the rectangle [pixels]", 1, 16384) : w;
    if (!h) return false;
    output_.place.rectangle = {*x, *y, static_cast<std::uint32_t>(*w), static_cast<std::uint32_t>(*h)};
    return true;
  }
  std::optional<std::int32_t> whole(std::string_view what, double lo, double hi) {
    const Word* w = next_ < in_.words().size() ? &in_.words()[next_] : nullptr;
    const auto value = number(what, lo, hi);
    if (!value) return std::nullopt;
    if (*value == std::floor(*value)) return static_cast<std::int32_t>(*value);
    return wrong(*w, fmt::format("{} must be a whole number, not {}", what, *value)), std::nullopt;
  }
  bool fullscreen() { return output_.place.fullscreen = true; }
  bool refresh() {
    const auto hz = whole("the refresh rate [1/s]", 1, 1000);
    if (hz) output_.place.refresh = static_cast<std::uint32_t>(*hz);
    return hz.has_value();
  }
  bool flipH() { return output_.shape.flipH = true; }
  bool flipV() { return output_.shape.flipV = true; }
  bool swapEyes() { return output_.shape.swapEyes = true; }
  bool rotate() {
    const Word* w = word("90, 180 or 270");
    if (!w) return false;
    for (const std::uint32_t degrees : {0u, 90u, 180u, 270u})
      if (w->text == std::to_string(degrees)) return output_.shape.rotate = degrees, true;
    return wrong(*w, quotedWord(w->text) +
                         " is not a turn that a picture can make; write 90, 180 or 270 (clockwise)");
  }

  /// One number for all channels, or three.
  bool channels(std::string_view what, double lo, double hi, std::array<double, 3>& target) {
    const auto first = number(what, lo, hi);
    if (!first) return false;
    target.fill(*first);
    if (!numberFollows()) return true;
    for (const std::size_t i : {1u, 2u}) {
      const auto value = number(fmt::format("{} of {}", what, i == 1 ? "green" : "blue"), lo, hi);
      if (!value) return false;
      target[i] = *value;
    }
    return true;
  }
  bool numberFollows() const {
    if (next_ >= in_.words().size()) return false;
    const char c = in_.words()[next_].text[0];
    return (c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.';
  }
  bool gamma() { return channels("gamma", 0.1, 10, output_.shape.gamma); }
  bool brightness() { return channels("brightness", 0, 1, output_.shape.brightness); }

  bool warp() {
    const Word& key = in_.words()[next_ - 1];
    std::array<Vec2, 4> corners;
    constexpr const char* kNames[] = {"upper left", "upper right", "lower right", "lower left"};
    for (std::size_t i = 0; i < 4; ++i)
      for (int axis = 0; axis < 2; ++axis) {
        const auto value =
            number(fmt::format("{} of the {} corner", axis == 0 ? "x" : "y", kNames[i]), -1, 2);
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
    in_.error(in_.words()[0].column, what);
    return false;
  }

  LineReader& in_;
  std::size_t next_ = 0;
  WallOutput output_;
  std::vector<std::string> given_;
};

const std::array<OutputReader::Field, OutputReader::kFieldCount>& OutputReader::fields() {
  static constexpr std::array<Field, kFieldCount> kFields{{{"screen", &OutputReader::screen},
                                                           {"monitor", &OutputReader::monitor},
                                                           {"rectangle", &OutputReader::rectangle},
                                                           {"fullscreen", &OutputReader::fullscreen},
                                                           {"refresh", &OutputReader::refresh},
                                                           {"flip-h", &OutputReader::flipH},
                                                           {"flip-v", &OutputReader::flipV},
                                                           {"rotate", &OutputReader::rotate},
                                                           {"swap-eyes", &OutputReader::swapEyes},
                                                           {"gamma", &OutputReader::gamma},
                                                           {"brightness", &OutputReader::brightness},
                                                           {"warp", &OutputReader::warp}}};
  return kFields;
}

std::string channelsText(const char* name, const std::array<double, 3>& v) {
  return v == std::array<double, 3>{1, 1, 1} ? "" : fmt::format("  {} {} {} {}", name, v[0], v[1], v[2]);
}

}  // namespace

std::optional<WallOutput> readOutput(LineReader& in, std::size_t first) {
  return OutputReader(in).run(first);
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
