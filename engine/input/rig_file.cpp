#include "engine/input/rig_file.h"

#include "engine/base/plain_file.h"
#include "engine/input/tracker_names.h"
#include "engine/maths/angles.h"
#include "engine/maths/functions.h"
#include "engine/plain_text/statement_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr double kFarthestPlace = 1e4;  ///< [m]

class RigParser {
public:
  RigParser(std::string_view text, const std::string& file, Diagnostics& out) : in_(text, file, out) {}

  std::optional<RigFile> run() {
    if (!in_.heading("a rig file", "stadion-rig")) return std::nullopt;
    while (in_.next()) in_.read(*this, kStatements);
    if (in_.failed()) return std::nullopt;
    if (rig_.trackers.empty()) rig_.trackers = standardRig().trackers;
    return std::move(rig_);
  }

private:
  static const Statement<RigParser> kStatements[9];
  static const StatementField<RigParser> kFields[4];

  std::optional<Vec3> vector(std::string_view what, double most) {
    Vec3 v;
    for (int i = 0; i < 3; ++i) {
      const auto x = in_.number(what, -most, most);
      if (!x) return {};
      v[i] = *x;
    }
    return v;
  }

  void unit() {
    const auto unit = lengthUnit(in_);
    if (unit && in_.finished()) rig_.unit = unit->metres;
  }
  void up() {
    static constexpr std::string_view kAxes[] = {"z", "y"};
    const auto axis = in_.choice("an axis that can point up", kAxes);
    if (axis && in_.finished()) rig_.upIsY = *axis == 1;
  }
  void origin() {
    const auto v = vector("the origin", kFarthestPlace);
    if (v && in_.finished()) rig_.origin = *v;
  }
  void yaw() {
    const auto d = in_.number("the yaw", -3600, 3600);
    if (d && in_.finished()) rig_.yaw = *d * kDegree;
  }
  void filter() {
    const auto cutoff = in_.number("the filter's lowest cutoff", 0, 1000);
    const auto beta = cutoff ? in_.number("the filter's beta", 0, 10000) : std::nullopt;
    if (beta && in_.finished()) {
      rig_.cutoff = *cutoff;
      rig_.beta = *beta;
    }
  }
  void seconds(double& value, std::string_view what, double most) {
    const auto s = in_.number(what, 0, most);
    if (s && in_.finished()) value = *s;
  }
  void hold() { seconds(rig_.hold, "the time to hold", 60); }
  void ease() { seconds(rig_.ease, "the time to ease", 60); }
  void predict() { seconds(rig_.predict, "the time to predict", 0.1); }

  // The fields of a tracker; they fill tracker_.

  bool offset() {
    const auto v = vector("offset", kFarthestPlace);
    if (v) tracker_.X_DT.p = *v;
    return v.has_value();
  }
  bool turn() {
    const auto v = vector("turn", 3600);
    if (v) tracker_.X_DT.q = det::fromEuler(v->x() * kDegree, v->y() * kDegree, v->z() * kDegree);
    return v.has_value();
  }
  bool safe() {
    tracker_.safe = vector("safe", kFarthestPlace);
    return tracker_.safe.has_value();
  }

  bool sentAs() {
    const auto device = in_.name("the device's name", "a device");
    if (!device) return false;
    const auto other = std::ranges::find(rig_.trackers, *device, &RigTracker::sentAs);
    if (other != rig_.trackers.end()) {
      in_.error(in_.last(), fmt::format("tracker \"{}\" is \"{}\" already; a device is one tracker",
                                        other->name, *device));
      return false;
    }
    tracker_.sentAs = *device;
    return true;
  }

  void tracker() {
    const auto name = in_.name("the tracker's name", "a tracker");
    if (!name) return;
    if (rig_.find(*name))
      return in_.error(in_.last(),
                       fmt::format("there are two trackers \"{}\"; give this one another name", *name));
    if (rig_.trackers.size() == RigFile::kMostTrackers)
      return in_.error(in_.last(), fmt::format("a rig has at most {} trackers; leave this one out",
                                               RigFile::kMostTrackers));
    tracker_ = {*name, {}, {}, {}};
    if (in_.fields(*this, kFields, "a tracker")) rig_.trackers.push_back(std::move(tracker_));
  }

  StatementReader in_;
  RigFile rig_;
  RigTracker tracker_;  ///< of this line
};

constexpr Statement<RigParser> RigParser::kStatements[9] = {
    {"unit", &RigParser::unit}, {"up", &RigParser::up},           {"origin", &RigParser::origin},
    {"yaw", &RigParser::yaw},   {"filter", &RigParser::filter},   {"hold", &RigParser::hold},
    {"ease", &RigParser::ease}, {"predict", &RigParser::predict}, {"tracker", &RigParser::tracker, true}};

constexpr StatementField<RigParser> RigParser::kFields[4] = {{"offset", &RigParser::offset},
                                                             {"turn", &RigParser::turn},
                                                             {"safe", &RigParser::safe},
                                                             {"sent-as", &RigParser::sentAs}};

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
  rig.trackers.push_back({kHeadTracker, {}, Vec3(0, 0, 1.7)});
  rig.trackers.push_back({kWandTracker, {}, {}});
  return rig;
}

std::optional<RigFile> parseRigFile(std::string_view text, const std::string& file, Diagnostics& out) {
  return RigParser(text, file, out).run();
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
  for (const LengthUnit& u : kLengthUnits)
    if (u.metres == rig.unit) text += fmt::format("unit {}\n", u.name);
  text += fmt::format("up {}\norigin {}\nyaw {:.6g}\n", rig.upIsY ? "y" : "z", vector(rig.origin),
                      rig.yaw / kDegree);
  text += fmt::format("filter {:g} {:g}\nhold {:g}\nease {:g}\npredict {:g}\n", rig.cutoff, rig.beta,
                      rig.hold, rig.ease, rig.predict);
  for (const RigTracker& t : rig.trackers) {
    text +=
        fmt::format("tracker {}  offset {}  turn {}", t.name, vector(t.X_DT.p), vector(eulerOf(t.X_DT.q)));
    if (t.safe) text += fmt::format("  safe {}", vector(*t.safe));
    if (!t.sentAs.empty()) text += "  sent-as " + t.sentAs;
    text += '\n';
  }
  return text;
}

}  // namespace stadion
