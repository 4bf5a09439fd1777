#include "dynamics/flight/trajectory.h"

#include "dynamics/flight/number_columns.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace stadion {
namespace {

constexpr const char* kNames[] = {"t",  "px", "py", "pz", "qw", "qx", "qy",
                                  "qz", "vx", "vy", "vz", "wx", "wy", "wz"};

}  // namespace

Result<Trajectory> readTrajectory(std::string_view text, const std::string& file) {
  const auto read = readNumberColumns(text, file);
  if (!read) return read.error();
  const NumberColumns& table = read.value();
  const auto wrong = [&table](std::size_t row, std::string why) {
    return Diagnostic{Severity::Error, {table.file, table.lines[row], 0}, std::move(why), {}};
  };
  std::array<std::size_t, std::size(kNames)> columns{};
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const auto found = table.column(kNames[i]);
    if (!found)
      return wrong(
          0, fmt::format("there is no column \"{}\": a flight has t, px,py,pz, qw,qx,qy,qz, vx,vy,vz and "
                         "wx,wy,wz",
                         kNames[i]));
    columns[i] = *found;
  }
  Trajectory flight;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const auto n = [&](std::size_t i) { return table.rows[r][columns[i]]; };
    const Quat q(n(4), n(5), n(6), n(7));
    if (!(std::fabs(q.norm() - 1) < 1e-3)) return wrong(r, "qw,qx,qy,qz are not a unit quaternion");
    if (!flight.empty() && !(n(0) > flight.back().t)) return wrong(r, "t must rise from row to row");
    flight.push_back(
        {n(0), {{n(1), n(2), n(3)}, {n(8), n(9), n(10)}, q.normalized(), {n(11), n(12), n(13)}}});
  }
  if (flight.size() < 2) return wrong(0, "a flight needs two rows at least");
  return flight;
}

std::string trajectoryText(const Trajectory& trajectory) {
  std::string text = "t,px,py,pz,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz\n";
  for (const TrajectorySample& s : trajectory)
    text += fmt::format(
        "{:.9g},{:.12g},{:.12g},{:.12g},{:.12g},{:.12g},{:.12g},{:.12g},{:.12g},{:.12g},{:.12g},{:.12g},"
        "{:.12g},{:.12g}\n",
        s.t, s.at.p.x(), s.at.p.y(), s.at.p.z(), s.at.q.w(), s.at.q.x(), s.at.q.y(), s.at.q.z(), s.at.v.x(),
        s.at.v.y(), s.at.v.z(), s.at.w.x(), s.at.w.y(), s.at.w.z());
  return text;
}

RigidFlight sampleAt(const Trajectory& f, double t) {
  if (t <= f.front().t) return f.front().at;
  if (t >= f.back().t) return f.back().at;
  const auto above =
      std::upper_bound(f.begin(), f.end(), t, [](double x, const TrajectorySample& s) { return x < s.t; });
  const TrajectorySample &a = *(above - 1), &b = *above;
  const double h = b.t - a.t, s = (t - a.t) / h;
  const Vec3 rise = b.at.p - a.at.p, d = h * a.at.v, e = h * b.at.v;
  RigidFlight r;
  r.p = a.at.p + s * (d + s * ((3 * rise - 2 * d - e) + s * (d + e - 2 * rise)));
  r.v = (d + s * (2 * (3 * rise - 2 * d - e) + s * 3 * (d + e - 2 * rise))) / h;
  r.q = det::slerp(a.at.q, b.at.q, s);
  r.w = (1 - s) * a.at.w + s * b.at.w;
  return r;
}

}  // namespace stadion
