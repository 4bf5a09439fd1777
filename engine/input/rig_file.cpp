#include "engine/input/rig_file.h"

#include "engine/base/plain_file.h"
#include "engine/base/text_line.h"
#include "engine/maths/angles.h"
#include "engine/maths/functions.h"
#include "engine/unicode/likeness.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace stadion {
namespace {

constexpr double kFar = 1e4;  ///< [m]

struct Unit {
  std::string_view name;
  double metres;
};
constexpr std::array<Unit, 5> kUnits{{{"m", 1}, {"cm", 0.01}, {"mm", 0.001}, {"in", 0.0254}, {"ft", 0.3048}}};

class Parser {
public:
  Parser(std::string_view text, const std::string& file, Diagnostics& out)
      : file_(file), out_(out), in_(text, file, out) {}

  std::optional<RigFile> run() {
    if (!heading()) return std::nullopt;
    while (in_.next()) statement();
    if (in_.failed()) return std::nullopt;
    if (rig_.trackers.empty()) rig_.trackers = standardRig().trackers;
    return std::move(rig_);
  }

private:
  struct Statement {
    std::string_view name;
    void (Parser::*read)();
    bool once;
  };
  static constexpr std::size_t kStatements = 9;
  static const std::array<Statement, kStatements>& statements() {
    static constexpr std::array<Statement, kStatements> kAll{{{"unit", &Parser::unit, true},
                                                              {"up", &Parser::up, true},
                                                              {"origin", &Parser::origin, true},
                                                              {"yaw", &Parser::yaw, true},
                                                              {"filter", &Parser::filter, true},
                                                              {"hold", &Parser::hold, true},
                                                              {"ease", &Parser::ease, true},
                                                              {"predict", &Parser::predict, true},
                                                              {"tracker", &Parser::tracker, false}}};
    return kAll;
  }

  bool heading() {
    const bool there = in_.next() && in_.words().size() == 2 && in_.words()[0].text == "stadion-rig" &&
                       in_.words()[1].text == "1";
    if (!there) out_.error({file_, 1, 1}, "this is not a rig file; one begins with the line: stadion-rig 1");
    return there;
  }

  void statement() {
    const Word keyword = in_.words()[0];
    std::vector<std::string> known;
    for (const Statement& s : statements()) {
      known.emplace_back(s.name);
      if (keyword.text != s.name) continue;
      if (s.once && std::ranges::find(seen_, s.name) != seen_.end())
        return in_.error(keyword.column, fmt::format("\"{}\" is given twice; keep one of them", s.name));
      seen_.push_back(s.name);
      return (this->*s.read)();
    }
    const auto near = closest(std::string(keyword.text.substr(0, 64)), known);
    in_.error(keyword.column, fmt::format("{} is not a statement of a rig file; {}", quotedWord(keyword.text),
                                          near ? didYouMeanOne(std::string(keyword.text), *near)
                                               : fmt::format("known are {}", fmt::join(known, ", "))));
  }

  const Word* word(std::size_t index, std::string_view what) {
    if (index < in_.words().size()) return &in_.words()[index];
    in_.error(in_.endColumn(), fmt::format("{} is missing", what));
    return nullptr;
  }
  std::optional<double> number(std::size_t index, std::string_view what, double least, double most) {
    const Word* w = word(index, what);
    const auto value = w ? in_.number(*w, what) : std::nullopt;
    if (!value) return {};
    if (*value >= least && *value <= most) return value;
    in_.error(w->column, fmt::format("{} must be from {} to {}", what, least, most));
    return {};
  }
  std::optional<Vec3> vector(std::size_t index, std::string_view what, double most) {
    Vec3 v;
    for (int i = 0; i < 3; ++i) {
      const auto x = number(index + static_cast<std::size_t>(i), what, -most, most);
      if (!x) return {};
      v[i] = *x;
    }
    return v;
  }
  void nothingAfter(std::size_t count) {
    if (in_.words().size() > count)
      in_.error(in_.words()[count].column,
                fmt::format("{} is one word too many here", quotedWord(in_.words()[count].text)));
  }

  void unit() {
    const Word* w = word(1, "the unit");
    if (!w) return;
    for (const Unit& u : kUnits)
      if (w->text == u.name) return rig_.unit = u.metres, nothingAfter(2);
    in_.error(w->column, fmt::format("{} is not a unit; known are m, cm, mm, in, ft", quotedWord(w->text)));
  }
  void up() {
    const Word* w = word(1, "the axis");
    if (!w) return;
    if (w->text != "y" && w->text != "z")
      return in_.error(w->column, fmt::format("{} is not z or y", quotedWord(w->text)));
    rig_.upIsY = w->text == "y";
    nothingAfter(2);
  }
  void origin() {
    if (const auto v = vector(1, "the origin", kFar)) rig_.origin = *v, nothingAfter(4);
  }
  void yaw() {
    if (const auto d = number(1, "the yaw", -3600, 3600)) rig_.yaw = *d * kDegree, nothingAfter(2);
  }
  void filter() {
    const auto cutoff = number(1, "the filter's lowest cutoff", 0, 1000);
    const auto beta = cutoff ? number(2, "the filter's beta", 0, 10000) : std::nullopt;
    if (beta) rig_.cutoff = *cutoff, rig_.beta = *beta, nothingAfter(3);
  }
  void seconds(double& value, std::string_view what, double most) {
    if (const auto s = number(1, what, 0, most)) value = *s, nothingAfter(2);
  }
  void hold() { seconds(rig_.hold, "the time to hold", 60); }
  void ease() { seconds(rig_.ease, "the time to ease", 60); }
  void predict() { seconds(rig_.predict, "the time to predict", 0.1); }

  void tracker() {
    const Word* w = word(1, "the tracker's name");
    const auto name = w ? in_.name(*w, "a tracker") : std::nullopt;
    if (!name) return;
    if (rig_.find(*name)) return in_.error(w->column, fmt::format("there are two trackers \"{}\"", *name));
    if (rig_.trackers.size() == RigFile::kMostTrackers)
      return in_.error(w->column, fmt::format("a rig has at most {} trackers", RigFile::kMostTrackers));
    RigTracker t{*name, {}, {}};
    for (std::size_t i = 2; i < in_.words().size(); i += 4) {
      const Word key = in_.words()[i];
      if (key.text != "offset" && key.text != "turn" && key.text != "safe")
        return in_.error(key.column, fmt::format("{} is not expected here; known are offset, turn, safe",
                                                 quotedWord(key.text)));
      const auto v = vector(i + 1, key.text, key.text == "turn" ? 3600 : kFar);
      if (!v) return;
      if (key.text == "offset") t.X_DT.p = *v;
      if (key.text == "turn") t.X_DT.q = det::fromEuler(v->x() * kDegree, v->y() * kDegree, v->z() * kDegree);
      if (key.text == "safe") t.safe = *v;
    }
    rig_.trackers.push_back(std::move(t));
  }

  std::string file_;
  Diagnostics& out_;
  LineReader in_;
  RigFile rig_;
  std::vector<std::string_view> seen_;
};

/// roll, pitch, yaw about fixed axes, as fromEuler takes them [degrees].
Vec3 eulerOf(const Quat& q) {
  const Mat3 m = q.toRotationMatrix();
  const double pitch = det::asin(-m(2, 0));
  const bool upright = std::fabs(m(2, 0)) < 1 - 1e-12;
  const double roll = upright ? det::atan2(m(2, 1), m(2, 2)) : 0;
  const double yaw = upright ? det::atan2(m(1, 0), m(0, 0)) : det::atan2(-m(0, 1), m(1, 1));
  return Vec3(roll, pitch, yaw) / kDegree;
}

}  // namespace

const RigTracker* RigFile::find(std::string_view name) const {
  const auto at = std::ranges::find(trackers, name, &RigTracker::name);
  return at == trackers.end() ? nullptr : &*at;
}

// A turn of a quarter about X takes a frame with +Y up to one with +Z up, for places and for axes alike.
Pose RigFile::levelled(const Pose& X_SD) const {
  Pose X{unit * X_SD.p, X_SD.q};
  if (!upIsY) return X;
  const double half = std::sqrt(0.5);
  const Quat quarter(half, half, 0, 0);
  return {quarter * X.p, (quarter * X.q * quarter.conjugate()).normalized()};
}

Pose RigFile::sensorInRig(const Pose& X_SD) const {
  return Pose{origin, det::fromEuler(0, 0, yaw)}.inverse() * levelled(X_SD);
}

Pose RigFile::inRig(const Pose& X_SD, const RigTracker& tracker) const {
  return sensorInRig(X_SD) * tracker.X_DT;
}

RigFile standardRig() {
  RigFile rig;
  rig.trackers.push_back({"head", {}, Vec3(0, 0, 1.7)});
  rig.trackers.push_back({"wand", {}, {}});
  return rig;
}

std::optional<RigFile> parseRigFile(std::string_view text, const std::string& file, Diagnostics& out) {
  return Parser(text, file, out).run();
}

std::optional<RigFile> loadRigFile(const std::string& path, Diagnostics& out) {
  const auto text = readPlainFile(path, 1 << 20);
  if (text) return parseRigFile(text.value(), path, out);
  out.add(text.error());
  return std::nullopt;
}

std::string formatRigFile(const RigFile& rig) {
  const auto vector = [](const Vec3& v) { return fmt::format("{:.6g} {:.6g} {:.6g}", v.x(), v.y(), v.z()); };
  std::string text = "stadion-rig 1\n";
  for (const Unit& u : kUnits)
    if (u.metres == rig.unit) text += fmt::format("unit {}\n", u.name);
  text += fmt::format("up {}\norigin {}\nyaw {:.6g}\n", rig.upIsY ? "y" : "z", vector(rig.origin),
                      rig.yaw / kDegree);
  text += fmt::format("filter {:g} {:g}\nhold {:g}\nease {:g}\npredict {:g}\n", rig.cutoff, rig.beta,
                      rig.hold, rig.ease, rig.predict);
  for (const RigTracker& t : rig.trackers) {
    text +=
        fmt::format("tracker {}  offset {}  turn {}", t.name, vector(t.X_DT.p), vector(eulerOf(t.X_DT.q)));
    text += t.safe ? fmt::format("  safe {}\n", vector(*t.safe)) : "\n";
  }
  return text;
}

}  // namespace stadion
