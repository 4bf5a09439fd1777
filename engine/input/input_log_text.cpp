// Reading and writing of input logs (the format is described in input_log.h).

#include "engine/base/plain_file.h"
#include "engine/base/text_line.h"
#include "engine/input/input_log.h"
#include "engine/maths/functions.h"
#include "engine/unicode/likeness.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>

namespace stadion {
namespace {

constexpr const char* kFormatName = "stadion-input";
constexpr std::uint64_t kVersion = 1;        ///< of logs that hold input alone
constexpr std::uint64_t kNewestVersion = 2;  ///< of logs that also hold what a clock decided
constexpr std::size_t kMaxLogBytes = std::size_t(1) << 30;
constexpr double kFarthestLogged = 1e6;       ///< of a position [m]
constexpr double kExactlyUnit = 1e-12;  ///< squared norms this near 1 are kept to the bit
constexpr double kNearlyUnit = 2e-3;    ///< nearer than this they are normalised, else it is an error
constexpr double kRadiansPerDegree = 3.14159265358979323846 / 180;

std::string logHint(std::string_view word, const std::vector<std::string>& known) {
  const auto near = closest(std::string(word.substr(0, 64)), known);
  return near ? "; " + didYouMeanOne(std::string(word), *near)
              : fmt::format("; known are {}", fmt::join(known, ", "));
}

class LogParser {
public:
  LogParser(std::string_view text, const std::string& file, Diagnostics& out)
      : file_(file), out_(out), in_(text, file, out) {}

  std::optional<InputLog> run() {
    if (!heading()) return std::nullopt;
    while (in_.next()) record();
    if (in_.failed()) return std::nullopt;
    return std::move(log_);
  }

private:
  bool heading() {
    if (!in_.next()) {
      out_.error({file_, 1, 1}, fmt::format("the file is empty; an input log begins with the line: {} {}",
                                            kFormatName, kVersion));
      return false;
    }
    if (in_.words()[0].text != kFormatName) {
      in_.error(
          in_.words()[0].column,
          fmt::format("this is not an input log; one begins with the line: {} {}", kFormatName, kVersion));
      return false;
    }
    const Word* version = word(1, "the version of the format");
    if (!version) return false;
    const auto number = in_.count(*version, "the version of the format", 1, 1'000'000);
    if (!number) return false;
    version_ = *number;
    if (version_ <= kNewestVersion) return nothingAfter(2);
    in_.error(version->column,
              fmt::format("version {} of the format is newer than this program, which reads {}", *number,
                          kNewestVersion));
    return false;
  }

  void record() {
    const Word& kind = in_.words()[0];
    if (kind.text == "pose") return pose(&LogParser::quaternion);
    if (kind.text == "key") return pose(nullptr);
    if (kind.text == "controls") return controls();
    if (kind.text == "lost") return lost();
    if (version_ >= 2 && kind.text == "rate") return rate();
    if (version_ >= 2 && kind.text == "frame")
      return decision(log_.decisions.frames, "the frame's number", 1'000'000'000'000, true);
    if (version_ >= 2 && kind.text == "load")
      return decision(log_.decisions.loads, "the load's number", 1'000'000'000, false);
    if (version_ >= 2 && kind.text == "order") return order();
    if (version_ >= 2 && kind.text == "relief") return relief();
    if (version_ >= 2 && kind.text == "stress") return stress();
    std::vector<std::string> known{"pose", "key", "controls", "lost"};
    if (version_ >= 2) known.insert(known.end(), {"rate", "frame", "load", "order", "relief", "stress"});
    in_.error(kind.column, fmt::format("{} is not a kind of record{}", quotedWord(kind.text),
                                       logHint(kind.text, known)));
  }

  void rate() {
    const auto value = number(1, "frames a second");
    if (!value || !nothingAfter(2)) return;
    if (!(*value >= 1 && *value <= 1000))
      return in_.error(in_.words()[1].column, "the rate must be from 1 to 1000 frames a second");
    log_.decisions.rate = *value;
  }

  /// NUMBER SECONDS; of frames, both grow from line to line.
  template <class Number>
  void decision(std::map<Number, Nanoseconds>& known, std::string_view what, std::uint64_t most,
                bool increasing) {
    const Word* numberWord = word(1, what);
    const Word* timeWord = numberWord ? word(2, "the time in seconds") : nullptr;
    if (!timeWord || !nothingAfter(3)) return;
    const auto index = in_.count(*numberWord, what, 1, most);
    const auto time = in_.seconds(*timeWord, "the time");
    if (!index || !time) return;
    if (known.contains(static_cast<Number>(*index)))
      return in_.error(numberWord->column, fmt::format("{} is there already", what));
    // Loads may take effect in any order; frames may not.
    const bool grows =
        known.empty() || !increasing || (known.rbegin()->first < *index && known.rbegin()->second < *time);
    if (!grows)
      return in_.error(numberWord->column, fmt::format("{} must increase, and the time with it", what));
    known.emplace(static_cast<Number>(*index), *time);
  }

  void order() {
    const Word* frameWord = word(1, "the frame's number");
    const Word* actionWord = frameWord ? word(2, "what was asked for") : nullptr;
    const auto value = actionWord ? number(3, "the figure") : std::nullopt;
    if (!value || !nothingAfter(4)) return;
    const auto frame = in_.count(*frameWord, "the frame's number", 0, 1'000'000'000'000);
    const auto action = operatorActionNamed(actionWord->text);
    if (!action || !isOfPresentation(*action))
      return in_.error(actionWord->column,
                       fmt::format("{} is no order; known are black, swap-eyes, eye-separation, volume",
                                   quotedWord(actionWord->text)));
    if (!(*value >= 0 && *value <= 1))
      return in_.error(in_.words()[3].column, "the figure must be from 0 to 1");
    if (frame) log_.decisions.orders.insert({*frame, {*action, *value, false}});
  }

  void relief() {
    const auto frame = wholeNumber(1, "the frame's number", 0, 1'000'000'000'000);
    const auto load = frame ? wholeNumber(2, "the load's number", 1, 1'000'000'000) : std::nullopt;
    const auto position = load ? wholeNumber(3, "the node's position", 0, 1'000'000'000) : std::nullopt;
    const auto level = position ? wholeNumber(4, "the level", 0, 100) : std::nullopt;
    if (!level || !nothingAfter(5)) return;
    const auto number = [](std::uint64_t n) { return static_cast<std::uint32_t>(n); };
    decide(*frame, {number(*load), number(*position), number(*level)});
  }

  void stress() {
    const auto frame = wholeNumber(1, "the frame's number", 0, 1'000'000'000'000);
    const auto level = frame ? wholeNumber(2, "the level", 0, kMostStress) : std::nullopt;
    if (level && nothingAfter(3)) decide(*frame, {0, 0, static_cast<std::uint32_t>(*level)});
  }

  void decide(std::uint64_t frame, const LoadDecision& decision) {
    LoadDecisions& known = log_.decisions.relief;
    if (known.count(frame) == FrameLoad::kMost)
      return in_.error(in_.words()[0].column,
                       fmt::format("at most {} of these take effect in one frame", FrameLoad::kMost));
    const auto [first, last] = known.equal_range(frame);
    for (auto at = first; at != last; ++at)
      if (at->second.load == decision.load && at->second.position == decision.position)
        return in_.error(in_.words()[0].column, "of this frame and this node that is said already");
    known.insert({frame, decision});
  }

  std::optional<std::uint64_t> wholeNumber(std::size_t index, std::string_view what, std::uint64_t least,
                                           std::uint64_t most) {
    const Word* w = word(index, what);
    return w ? in_.count(*w, what, least, most) : std::nullopt;
  }

  const Word* word(std::size_t index, std::string_view what) {
    if (index < in_.words().size()) return &in_.words()[index];
    in_.error(in_.endColumn(), fmt::format("{} is missing", what));
    return nullptr;
  }

  bool nothingAfter(std::size_t count) {
    if (in_.words().size() <= count) return true;
    in_.error(in_.words()[count].column,
              fmt::format("{} is one word too many here", quotedWord(in_.words()[count].text)));
    return false;
  }

  std::optional<double> number(std::size_t index, std::string_view what) {
    const Word* w = word(index, what);
    return w ? in_.number(*w, what) : std::nullopt;
  }

  /// NAME SECONDS, checked against what the tracker has so far; nullptr after an error.
  InputTrack* begin(InputStamp& stamp) {
    const Word* nameWord = word(1, "the tracker's name");
    const Word* timeWord = nameWord ? word(2, "the time in seconds") : nullptr;
    if (!timeWord) return nullptr;
    const auto name = in_.name(*nameWord, "a tracker");
    const auto time = in_.seconds(*timeWord, "the time");
    if (!name || !time) return nullptr;
    stamp.time = *time;
    InputTrack* track = trackOf(*name, *nameWord);
    if (!track || track->stamps.empty() || track->stamps.back().time < *time) return track;
    in_.error(timeWord->column,
              fmt::format("time must increase, but {} s comes after {} s of the same tracker",
                          formatSeconds(*time), formatSeconds(track->stamps.back().time)));
    return nullptr;
  }

  InputTrack* trackOf(const std::string& name, const Word& where) {
    const auto known = byName_.find(name);
    if (known != byName_.end()) return &log_.tracks[known->second];
    if (log_.tracks.size() == InputLog::kMaxTrackers) {
      in_.error(where.column, fmt::format("an input log has at most {} trackers", InputLog::kMaxTrackers));
      return nullptr;
    }
    byName_.emplace(name, log_.tracks.size());
    log_.tracks.push_back({name, {}});
    return &log_.tracks.back();
  }

  bool position(std::size_t index, Pose& pose) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto value =
          number(index + static_cast<std::size_t>(axis), fmt::format("{} of the position", "xyz"[axis]));
      if (!value) return false;
      if (std::fabs(*value) > kFarthestLogged) {
        in_.error(in_.words()[index + static_cast<std::size_t>(axis)].column,
                  "a position must be within 1000 km of the rig (metres)");
        return false;
      }
      pose.p[axis] = *value;
    }
    return true;
  }

  bool quaternion(std::size_t index, Pose& pose) {
    double q[4];
    for (std::size_t i = 0; i < 4; ++i) {
      const auto value = number(index + i, fmt::format("{} of the unit quaternion w, x, y, z", "wxyz"[i]));
      if (!value) return false;
      q[i] = *value;
    }
    const double squared = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
    if (!(std::fabs(squared - 1) <= kNearlyUnit)) {
      in_.error(in_.words()[index].column,
                fmt::format("the quaternion must have length 1, not {:.6g}", std::sqrt(squared)));
      return false;
    }
    pose.q = Quat(q[0], q[1], q[2], q[3]);
    if (std::fabs(squared - 1) > kExactlyUnit) pose.q.coeffs() /= std::sqrt(squared);
    return true;
  }

  /// The words after the pose; `i` is where they begin.
  bool options(std::size_t i, bool isKey, InputStamp& stamp) {
    std::vector<std::string_view> given;
    while (i < in_.words().size()) {
      const Word key = in_.words()[i++];
      if (std::ranges::find(given, key.text) != given.end()) {
        in_.error(key.column, fmt::format("{} is given twice; keep one of them", quotedWord(key.text)));
        return false;
      }
      given.push_back(key.text);
      if (key.text == "smooth")
        stamp.smooth = true;
      else if (key.text == "turn" && isKey) {
        if (!turn(i, stamp.X_RT)) return false;
      } else if (key.text == "buttons") {
        if (!buttons(i, stamp)) return false;
      } else if (key.text == "axes") {
        if (!axes(i, stamp)) return false;
      } else {
        std::vector<std::string> known{"smooth", "buttons", "axes"};
        if (isKey) known.emplace_back("turn");
        in_.error(key.column, fmt::format("{} is not expected here{}", quotedWord(key.text),
                                          logHint(key.text, known)));
        return false;
      }
    }
    return true;
  }

  bool turn(std::size_t& i, Pose& pose) {
    double angle[3];
    constexpr std::array<std::string_view, 3> kNames{"roll", "pitch", "yaw"};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto value = number(i++, fmt::format("{} of turn (roll, pitch, yaw in degrees)", kNames[k]));
      if (!value) return false;
      if (std::fabs(*value) > 3600) {
        in_.error(in_.words()[i - 1].column, "an angle must be within ten turns (3600 degrees)");
        return false;
      }
      angle[k] = *value * kRadiansPerDegree;
    }
    pose.q = det::fromEuler(angle[0], angle[1], angle[2]);
    return true;
  }

  bool buttons(std::size_t& i, InputStamp& stamp) {
    const Word* w = word(i++, "the buttons' bit mask");
    if (!w) return false;
    const bool hex = w->text.starts_with("0x");
    const std::string_view digits = w->text.substr(hex ? 2 : 0);
    const auto [end, problem] =
        std::from_chars(digits.data(), digits.data() + digits.size(), stamp.buttons, hex ? 16 : 10);
    if (problem == std::errc() && end == digits.data() + digits.size()) return true;
    in_.error(w->column, fmt::format("the buttons must be a bit mask of 32 bits, such as 5 or 0x5, not {}",
                                     quotedWord(w->text)));
    return false;
  }

  static bool beginsNumber(const Word& w) { return w.text.find_first_of("0123456789+-.") == 0; }

  bool axes(std::size_t& i, InputStamp& stamp) {
    std::size_t count = 0;
    for (; i < in_.words().size() && (count == 0 || beginsNumber(in_.words()[i])); ++i, ++count) {
      const Word& w = in_.words()[i];
      const auto value = in_.number(w, "an axis");
      if (!value) return false;
      if (count == kTrackerAxes || std::fabs(*value) > 1) {
        in_.error(w.column, count == kTrackerAxes
                                ? fmt::format("a tracker has at most {} axes", kTrackerAxes)
                                : fmt::format("an axis must be from -1 to 1, not {}", quotedWord(w.text)));
        return false;
      }
      stamp.axes[count] = static_cast<float>(*value);
    }
    return count > 0 || word(i, "the value of the first axis") != nullptr;
  }

  void pose(bool (LogParser::*rotation)(std::size_t, Pose&)) {
    InputStamp stamp;
    InputTrack* track = begin(stamp);
    if (!track || !position(3, stamp.X_RT)) return;
    if (rotation && !(this->*rotation)(6, stamp.X_RT)) return;
    if (!options(rotation ? 10 : 6, !rotation, stamp)) return;
    track->stamps.push_back(stamp);
  }

  void controls() {
    InputStamp stamp;
    InputTrack* track = begin(stamp);
    if (!track) return;
    if (!track->stamps.empty()) stamp.X_RT = track->stamps.back().X_RT;
    stamp.valid = false, stamp.controlsOnly = true;
    if (options(3, false, stamp)) track->stamps.push_back(stamp);
  }

  void lost() {
    InputStamp stamp;
    InputTrack* track = begin(stamp);
    if (!track || !nothingAfter(3)) return;
    if (!track->stamps.empty()) stamp.X_RT = track->stamps.back().X_RT;
    stamp.valid = false;
    track->stamps.push_back(stamp);
  }

  std::string file_;
  Diagnostics& out_;
  LineReader in_;
  InputLog log_;
  std::map<std::string, std::size_t> byName_;
  std::uint64_t version_ = kVersion;
};

}  // namespace

std::optional<InputLog> parseInputLog(std::string_view text, const std::string& file, Diagnostics& out) {
  return LogParser(text, file, out).run();
}

std::optional<InputLog> loadInputLog(const std::string& path, Diagnostics& out) {
  const Result<std::string> text = readPlainFile(path, kMaxLogBytes);
  if (text) return parseInputLog(text.value(), path, out);
  out.add(text.error());
  return std::nullopt;
}

std::string inputLogHeading(double rate) {
  if (rate == 0) return fmt::format("{} {}\n", kFormatName, kVersion);
  return fmt::format("{} {}\nrate {}\n", kFormatName, kNewestVersion, rate);
}

std::string formatFrameTime(std::uint64_t frame, Nanoseconds time) {
  return fmt::format("frame {} {}\n", frame, formatSeconds(time));
}

std::string formatLateLoad(std::uint32_t load, Nanoseconds time) {
  return fmt::format("load {} {}\n", load, formatSeconds(time));
}

std::string formatOrder(std::uint64_t frame, const OperatorCommand& order) {
  return fmt::format("order {} {} {}\n", frame, nameOf(order.action), order.value.value_or(0));
}

std::string formatRelief(std::uint64_t frame, const LoadDecision& d) {
  if (d.load == 0) return fmt::format("stress {} {}\n", frame, d.level);
  return fmt::format("relief {} {} {} {}\n", frame, d.load, d.position, d.level);
}

std::string formatRecord(const std::string& tracker, const InputStamp& stamp) {
  if (!stamp.valid && !stamp.controlsOnly)
    return fmt::format("lost {} {}\n", tracker, formatSeconds(stamp.time));
  const Vec3& p = stamp.X_RT.p;
  const Quat& q = stamp.X_RT.q;
  std::string line =
      fmt::format("{} {} {}", stamp.valid ? "pose" : "controls", tracker, formatSeconds(stamp.time));
  if (stamp.valid)
    line += fmt::format("  {} {} {}  {} {} {} {}", p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z());
  if (stamp.smooth) line += "  smooth";
  if (stamp.buttons != 0) line += fmt::format("  buttons 0x{:x}", stamp.buttons);
  std::size_t used = kTrackerAxes;
  while (used > 0 && stamp.axes[used - 1] == 0) --used;
  if (used > 0) line += "  axes";
  for (std::size_t i = 0; i < used; ++i) line += fmt::format(" {}", stamp.axes[i]);
  return line + "\n";
}

std::string formatInputLog(const InputLog& log) {
  const RunDecisions& decided = log.decisions;
  std::string text = inputLogHeading(decided.rate);
  if (decided.rate == 0 && !decided.empty()) text = fmt::format("{} {}\n", kFormatName, kNewestVersion);
  for (const auto& [frame, time] : decided.frames) text += formatFrameTime(frame, time);
  for (const auto& [load, time] : decided.loads) text += formatLateLoad(load, time);
  for (const auto& [frame, order] : decided.orders) text += formatOrder(frame, order);
  for (const auto& [frame, decision] : decided.relief) text += formatRelief(frame, decision);
  for (const InputTrack& track : log.tracks)
    for (const InputStamp& stamp : track.stamps) text += formatRecord(track.name, stamp);
  return text;
}

}  // namespace stadion
