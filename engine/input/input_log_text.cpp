// Reading and writing of input logs (the format is described in input_log.h).

#include "engine/base/plain_file.h"
#include "engine/input/input_log.h"
#include "engine/maths/angles.h"
#include "engine/maths/functions.h"
#include "engine/plain_text/statement_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <span>

namespace stadion {
namespace {

constexpr const char* kFormatName = "stadion-input";
constexpr std::uint64_t kVersion = 1;        ///< of logs that hold input alone
constexpr std::uint64_t kNewestVersion = 2;  ///< of logs that also hold what a clock decided
constexpr std::size_t kMaxLogBytes = std::size_t(1) << 30;
constexpr std::uint64_t kMostFrames = 1'000'000'000'000;
constexpr double kFarthestLogged = 1e6;  ///< of a position [m]
constexpr double kExactlyUnit = 1e-12;   ///< squared norms this near 1 are kept to the bit
constexpr double kNearlyUnit = 2e-3;     ///< nearer than this they are normalised, else it is an error

class LogParser {
public:
  LogParser(std::string_view text, const std::string& file, Diagnostics& out) : in_(text, file, out) {}

  std::optional<InputLog> run() {
    const auto version = in_.heading("an input log", kFormatName, kNewestVersion);
    if (!version) return std::nullopt;
    std::span<const Statement<LogParser>> records(kRecords);
    if (*version == kVersion) records = records.first(kInputRecords);
    while (in_.next()) in_.read(*this, records);
    if (in_.failed()) return std::nullopt;
    return std::move(log_);
  }

private:
  static constexpr std::size_t kInputRecords = 4;  ///< the first ones; the others are decisions
  static const Statement<LogParser> kRecords[10];
  static const StatementField<LogParser> kFields[4];

  // What a clock decided.

  void rate() {
    const auto value = in_.number("frames a second", 1, 1000);
    if (value && in_.finished()) log_.decisions.rate = *value;
  }

  void frame() {
    // Loads may take effect in any order; frames may not.
    decision(log_.decisions.frames, "the frame's number", kMostFrames, true);
  }
  void load() { decision(log_.decisions.loads, "the load's number", 1'000'000'000, false); }

  /// NUMBER SECONDS; if `increasing`, both grow from line to line.
  template <class Number>
  void decision(std::map<Number, Nanoseconds>& known, std::string_view what, std::uint64_t most,
                bool increasing) {
    const auto index = in_.count(what, 1, most);
    if (!index) return;
    const Word numberWord = in_.last();
    if (!in_.more()) return static_cast<void>(in_.word("the time in seconds"));
    const auto time = in_.seconds("the time");
    if (!time || !in_.finished()) return;
    if (known.contains(static_cast<Number>(*index)))
      return in_.error(numberWord, fmt::format("{} is there already", what));
    const bool grows =
        known.empty() || !increasing || (known.rbegin()->first < *index && known.rbegin()->second < *time);
    if (!grows) return in_.error(numberWord, fmt::format("{} must increase, and the time with it", what));
    known.emplace(static_cast<Number>(*index), *time);
  }

  void order() {
    const auto frame = in_.count("the frame's number", 0, kMostFrames);
    const Word* asked = frame ? in_.word("what was asked for") : nullptr;
    if (!asked) return;
    const auto action = operatorActionNamed(asked->text);
    if (!action || !isOfPresentation(*action))
      return in_.unknown(*asked, "is no order",
                         {"black", "test-pattern", "swap-eyes", "eye-separation", "volume"});
    const auto value = in_.number("the figure", 0, 1);
    if (value && in_.finished()) log_.decisions.orders.insert({*frame, {*action, *value, false}});
  }

  void degradation() {
    const auto frame = in_.count("the frame's number", 0, kMostFrames);
    const auto load = frame ? in_.count("the load's number", 1, 1'000'000'000) : std::nullopt;
    const auto position = load ? in_.count("the node's position", 0, 1'000'000'000) : std::nullopt;
    const auto level = position ? in_.count("the level", 0, 100) : std::nullopt;
    if (!level || !in_.finished()) return;
    const auto number = [](std::uint64_t n) { return static_cast<std::uint32_t>(n); };
    decide(*frame, {number(*load), number(*position), number(*level)});
  }

  void stress() {
    const auto frame = in_.count("the frame's number", 0, kMostFrames);
    const auto level = frame ? in_.count("the level", 0, kMostStress) : std::nullopt;
    if (level && in_.finished()) decide(*frame, {0, 0, static_cast<std::uint32_t>(*level)});
  }

  void decide(std::uint64_t frame, const DegradationDecision& decision) {
    DegradationDecisions& known = log_.decisions.degradation;
    if (known.count(frame) == FrameDecisions::kMost)
      return in_.error(in_.keyword(),
                       fmt::format("at most {} of these take effect in one frame", FrameDecisions::kMost));
    const auto [first, last] = known.equal_range(frame);
    for (auto at = first; at != last; ++at)
      if (at->second.load == decision.load && at->second.position == decision.position)
        return in_.error(in_.keyword(), "of this frame and this node that is said already");
    known.insert({frame, decision});
  }

  // What trackers sent.

  /// Takes NAME SECONDS into stamp_. Returns the tracker's records so far; null after an error.
  InputTrack* begin() {
    stamp_ = {};
    const auto name = in_.name("the tracker's name", "a tracker");
    if (!name) return nullptr;
    const Word nameWord = in_.last();
    if (!in_.more()) {
      in_.word("the time in seconds");
      return nullptr;
    }
    const auto time = in_.seconds("the time");
    if (!time) return nullptr;
    stamp_.time = *time;
    InputTrack* track = trackOf(*name, nameWord);
    if (!track || track->stamps.empty() || track->stamps.back().time < *time) return track;
    in_.error(in_.last(), fmt::format("time must increase, but {} s comes after {} s of the same tracker",
                                      formatSeconds(*time), formatSeconds(track->stamps.back().time)));
    return nullptr;
  }

  InputTrack* trackOf(const std::string& name, const Word& where) {
    const auto known = byName_.find(name);
    if (known != byName_.end()) return &log_.tracks[known->second];
    if (log_.tracks.size() == InputLog::kMaxTrackers) {
      in_.error(where, fmt::format("an input log has at most {} trackers", InputLog::kMaxTrackers));
      return nullptr;
    }
    byName_.emplace(name, log_.tracks.size());
    log_.tracks.push_back({name, {}});
    return &log_.tracks.back();
  }

  bool position() {
    for (int axis = 0; axis < 3; ++axis) {
      const auto value = in_.number(fmt::format("{} of the position", "xyz"[axis]));
      if (!value) return false;
      if (std::fabs(*value) > kFarthestLogged) {
        in_.error(in_.last(), "a position must be within 1000 km of the rig (metres)");
        return false;
      }
      stamp_.X_RT.p[axis] = *value;
    }
    return true;
  }

  bool quaternion() {
    double q[4];
    Word first;
    for (std::size_t i = 0; i < 4; ++i) {
      const auto value = in_.number(fmt::format("{} of the unit quaternion w, x, y, z", "wxyz"[i]));
      if (!value) return false;
      q[i] = *value;
      if (i == 0) first = in_.last();
    }
    const double squared = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
    if (!(std::fabs(squared - 1) <= kNearlyUnit)) {
      in_.error(first, fmt::format("the quaternion must have length 1, not {:.6g}", std::sqrt(squared)));
      return false;
    }
    stamp_.X_RT.q = Quat(q[0], q[1], q[2], q[3]);
    if (std::fabs(squared - 1) > kExactlyUnit) stamp_.X_RT.q.coeffs() /= std::sqrt(squared);
    return true;
  }

  // The fields behind the pose.

  bool smooth() { return stamp_.smooth = true; }

  bool turn() {
    double angle[3];
    constexpr std::array<std::string_view, 3> kNames{"roll", "pitch", "yaw"};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto value = in_.number(fmt::format("{} of turn (roll, pitch, yaw in degrees)", kNames[k]));
      if (!value) return false;
      if (std::fabs(*value) > 3600) {
        in_.error(in_.last(), "an angle must be within ten turns (3600 degrees)");
        return false;
      }
      angle[k] = *value * kDegree;
    }
    stamp_.X_RT.q = det::fromEuler(angle[0], angle[1], angle[2]);
    return true;
  }

  bool buttons() {
    const Word* w = in_.word("the buttons' bit mask");
    if (!w) return false;
    const bool hex = w->text.starts_with("0x");
    const std::string_view digits = w->text.substr(hex ? 2 : 0);
    const auto [end, problem] =
        std::from_chars(digits.data(), digits.data() + digits.size(), stamp_.buttons, hex ? 16 : 10);
    if (problem == std::errc() && end == digits.data() + digits.size()) return true;
    in_.error(*w, fmt::format("the buttons must be a bit mask of 32 bits, such as 5 or 0x5, not {}",
                              quotedWord(w->text)));
    return false;
  }

  bool numberFollows() const { return in_.more() && in_.peek()->text.find_first_of("0123456789+-.") == 0; }

  bool axes() {
    if (!in_.more()) return in_.word("the value of the first axis") != nullptr;
    for (std::size_t count = 0; count == 0 || numberFollows(); ++count) {
      const auto value = in_.number("an axis");
      if (!value) return false;
      if (count == kTrackerAxes || std::fabs(*value) > 1) {
        in_.error(in_.last(),
                  count == kTrackerAxes
                      ? fmt::format("a tracker has at most {} axes", kTrackerAxes)
                      : fmt::format("an axis must be from -1 to 1, not {}", quotedWord(in_.last().text)));
        return false;
      }
      stamp_.axes[count] = static_cast<float>(*value);
    }
    return true;
  }

  /// Reads the fields; `turn` is one of a key only.
  bool fields(bool isKey) {
    const std::span<const StatementField<LogParser>> all(kFields);
    return in_.fields(*this, isKey ? all : all.first(all.size() - 1), "a record");
  }

  void pose() {
    InputTrack* track = begin();
    if (track && position() && quaternion() && fields(false)) track->stamps.push_back(stamp_);
  }

  void key() {
    InputTrack* track = begin();
    if (track && position() && fields(true)) track->stamps.push_back(stamp_);
  }

  void controls() {
    InputTrack* track = begin();
    if (!track) return;
    if (!track->stamps.empty()) stamp_.X_RT = track->stamps.back().X_RT;
    stamp_.valid = false;
    stamp_.controlsOnly = true;
    if (fields(false)) track->stamps.push_back(stamp_);
  }

  void lost() {
    InputTrack* track = begin();
    if (!track || !in_.finished()) return;
    if (!track->stamps.empty()) stamp_.X_RT = track->stamps.back().X_RT;
    stamp_.valid = false;
    track->stamps.push_back(stamp_);
  }

  StatementReader in_;
  InputLog log_;
  InputStamp stamp_;  ///< of this line
  std::map<std::string, std::size_t> byName_;
};

constexpr Statement<LogParser> LogParser::kRecords[10] = {
    {"pose", &LogParser::pose, true},          {"key", &LogParser::key, true},
    {"controls", &LogParser::controls, true},  {"lost", &LogParser::lost, true},
    {"rate", &LogParser::rate, true},          {"frame", &LogParser::frame, true},
    {"load", &LogParser::load, true},          {"order", &LogParser::order, true},
    {"relief", &LogParser::degradation, true}, {"stress", &LogParser::stress, true}};

constexpr StatementField<LogParser> LogParser::kFields[4] = {{"smooth", &LogParser::smooth},
                                                             {"buttons", &LogParser::buttons},
                                                             {"axes", &LogParser::axes},
                                                             {"turn", &LogParser::turn}};

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

std::string formatDegradation(std::uint64_t frame, const DegradationDecision& d) {
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
  for (const auto& [frame, decision] : decided.degradation) text += formatDegradation(frame, decision);
  for (const InputTrack& track : log.tracks)
    for (const InputStamp& stamp : track.stamps) text += formatRecord(track.name, stamp);
  return text;
}

}  // namespace stadion
