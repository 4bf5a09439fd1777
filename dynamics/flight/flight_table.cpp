#include "dynamics/flight/flight_table.h"

#include "dynamics/flight/number_columns.h"
#include "engine/maths/angles.h"
#include "engine/maths/functions.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace stadion {
namespace {

/// A flat plate across the wind has less than half as much, per area.
constexpr double kMostAir = 4;

using Rows = std::vector<FlightTableRow>;

/// The row at angle a on the other side of `about`: lift and perhaps the moment change sign.
FlightTableRow mirrored(const FlightTableRow& r, double about, double moment) {
  return {2 * about - r.alpha, r.drag, -r.lift, moment * r.moment, r.damping};
}

/// Rows beyond both ends as symmetry has them, so that every angle of use lies among rows.
Rows extended(Rows rows, int axis) {
  if (axis == 0 && rows.back().alpha < 0.75 * kPi)  // the table has no data on flying tail first
    for (std::size_t n = rows.size(); n-- > 0;)
      if (rows[n].alpha < 0.5 * kPi - 1e-9) rows.push_back(mirrored(rows[n], 0.5 * kPi, 1));
  if (axis == 2 && rows.front().alpha > -0.25 * kPi) {  // both faces are alike
    Rows all;
    for (std::size_t n = rows.size(); n-- > 0;)
      if (rows[n].alpha > 1e-9) all.push_back(mirrored(rows[n], 0, -1));
    all.insert(all.end(), rows.begin(), rows.end());
    rows = std::move(all);
  }
  // On the axis itself lift and moment pass through zero.
  const double low = axis == 0 ? 0 : -0.5 * kPi, high = low + kPi;
  Rows all;
  for (std::size_t n = std::min<std::size_t>(rows.size(), 3); n-- > 0;)
    if (rows[n].alpha > low + 1e-9) all.push_back(mirrored(rows[n], low, -1));
  all.insert(all.end(), rows.begin(), rows.end());
  for (std::size_t k = 0; k < 3 && k < rows.size(); ++k) {
    const FlightTableRow& r = rows[rows.size() - 1 - k];
    if (r.alpha < high - 1e-9) all.push_back(mirrored(r, high, -1));
  }
  return all;
}

/// Cubic through the rows with the slopes of parabolas through three of them.
class Curve {
public:
  Curve(const Rows& rows, double FlightTableRow::*column) : rows_(rows), column_(column) {}

  double at(double a) const {
    const auto above = std::upper_bound(rows_.begin() + 1, rows_.end() - 1, a,
                                        [](double x, const FlightTableRow& r) { return x < r.alpha; });
    const auto i = static_cast<std::size_t>(above - rows_.begin()) - 1;
    const double h = x(i + 1) - x(i), t = (a - x(i)) / h;
    const double d = slope(i) * h, e = slope(i + 1) * h, rise = y(i + 1) - y(i);
    return y(i) + t * (d + t * ((3 * rise - 2 * d - e) + t * (d + e - 2 * rise)));
  }

private:
  const Rows& rows_;
  double FlightTableRow::*column_;

  double x(std::size_t i) const { return rows_[i].alpha; }
  double y(std::size_t i) const { return rows_[i].*column_; }
  double secant(std::size_t i) const { return (y(i + 1) - y(i)) / (x(i + 1) - x(i)); }
  double slope(std::size_t i) const {
    if (i == 0) return secant(0);
    if (i + 1 == rows_.size()) return secant(i - 1);
    const double before = x(i) - x(i - 1), after = x(i + 1) - x(i);
    return (after * secant(i - 1) + before * secant(i)) / (before + after);
  }
};

struct Terms {
  double across, along, turn, damp;
};

/// The model's four at the angle theta between the axis and the velocity; see flight_table.h and laws.h.
Terms termsAt(double theta, const Rows& rows, double area, double length, int axis) {
  // On the axis itself the quotients are limits.
  theta = std::clamp(theta, 1e-3, kPi - 1e-3);
  const double alpha = axis == 0 ? theta : theta - 0.5 * kPi;
  const double drag = Curve(rows, &FlightTableRow::drag).at(alpha),
               lift = Curve(rows, &FlightTableRow::lift).at(alpha);
  const double moment = Curve(rows, &FlightTableRow::moment).at(alpha);
  const double damping = Curve(rows, &FlightTableRow::damping).at(alpha);
  const auto [sine, cosine] = det::sincos(alpha);
  const double damp = area * length * length * damping;
  if (axis == 0)
    return {area * (drag + lift * cosine / sine), area * (drag * cosine - lift * sine),
            -area * length * moment / sine, damp};
  return {area * (drag - lift * sine / cosine), -area * (lift * cosine + drag * sine),
          -area * length * moment / cosine, damp};
}

/// The cubic through values at 0, 1/3, 2/3 and 1.
std::array<double, 4> cubicThrough(double a, double b, double c, double d) {
  return {a, (-11 * a + 18 * b - 9 * c + 2 * d) / 2, (18 * a - 45 * b + 36 * c - 9 * d) / 2,
          (-9 * a + 27 * b - 27 * c + 9 * d) / 2};
}

/// What laws.h finds at this place.
double angleAt(double place) {
  const double quarter = place <= 1 ? place : 2 - place;
  const double theta = det::atan2(quarter, 1 - quarter);
  return place <= 1 ? theta : kPi - theta;
}

/// Of a row's angle.
Diagnostic wrongAt(const NumberColumns& table, std::size_t row, std::string why) {
  const std::size_t angle = table.column("alpha_deg").value_or(0);
  return {Severity::Error, {table.file, table.lines[row], table.places[row][angle]}, std::move(why), {}};
}

struct Settings {
  double area = 1, length = 1;
  int axis = 0;
};

Diagnostic wrongSetting(const NumberColumns& t, const NumberColumns::Setting& s, const std::string& rule) {
  return {Severity::Error, {t.file, s.line, s.at}, rule + ", not \"" + s.value.substr(0, 40) + "\"", {}};
}

/// What no body of this length has; the coefficients may also be areas themselves, per 1 m2.
std::optional<Diagnostic> readSettings(const NumberColumns& table, double bodyLength, Settings& settings) {
  struct Size {
    const char *name, *unit;
    double *number, most;
  };
  for (const auto& [name, unit, number, most] :
       {Size{"area", "m2", &settings.area, kMostAir * bodyLength * bodyLength},
        Size{"length", "m", &settings.length, kMostAir * bodyLength}}) {
    const auto found = table.settings.find(name);
    if (found == table.settings.end()) continue;
    const std::optional<double> x = numberIn(found->second.value);
    if (!x || !(*x > 0))
      return wrongSetting(table, found->second, std::string(name) + " must be a positive number");
    if (*x > std::max(1.0, most))
      return wrongSetting(table, found->second,
                          fmt::format("{} must be at most {:.3g} {} for a body of {:.3g} m", name,
                                      std::max(1.0, most), unit, bodyLength));
    *number = *x;
  }
  const auto found = table.settings.find("axis");
  if (found == table.settings.end()) return std::nullopt;
  if (found->second.value != "x" && found->second.value != "z")
    return wrongSetting(table, found->second, "axis is x (long bodies) or z (flat ones)");
  settings.axis = found->second.value == "x" ? 0 : 2;
  return std::nullopt;
}

/// More than a body of this length has of air, or what would drive it on: the first such cell.
std::optional<Diagnostic> wrongAir(const NumberColumns& t, const Settings& s, double bodyLength) {
  struct Column {
    const char *name, *unit;
    double least, times, most;  ///< as areas, volumes, ...
  };
  const double l = bodyLength, area = s.area;
  const Column columns[] = {{"CD", "m2", 0, area, kMostAir * l * l},
                            {"CL", "m2", -1, area, kMostAir * l * l},
                            {"CA", "m2", -1, area, kMostAir * l * l},
                            {"CN", "m2", -1, area, kMostAir * l * l},
                            {"CM", "m3", -1, area * s.length, kMostAir * l * l * l},
                            {"CQ", "m4", 0, area * s.length * s.length, kMostAir * l * l * l * l}};
  for (std::size_t row = 0; row < t.rows.size(); ++row)
    for (const Column& c : columns) {
      const auto at = t.column(c.name);
      if (!at) continue;
      const double x = t.rows[row][*at];
      const SourcePosition where{t.file, t.lines[row], t.places[row][*at]};
      if (c.least == 0 && x < 0)
        return Diagnostic{Severity::Error,
                          where,
                          fmt::format("{} must be 0 or more, not {:.6g}: it slows the body", c.name, x),
                          {}};
      if (std::abs(x) * c.times > c.most)
        return Diagnostic{Severity::Error,
                          where,
                          fmt::format("{} of {:.6g} makes {:.3g} {}; a body of {:.3g} m has at most {:.3g}",
                                      c.name, x, x * c.times, c.unit, bodyLength, c.most),
                          {}};
    }
  return std::nullopt;
}

/// Angles that rise through the whole range, or why not.
std::optional<Diagnostic> wrongAngles(const NumberColumns& t, const Rows& rows, int axis) {
  const double low = rows.front().alpha / kDegree, high = rows.back().alpha / kDegree;
  for (std::size_t i = 0; i + 1 < rows.size(); ++i)
    if (!(rows[i + 1].alpha > rows[i].alpha + 1e-6))
      return wrongAt(t, i + 1, "alpha_deg must rise from row to row");
  if (rows.size() < 3) return wrongAt(t, 0, "at least three rows are needed");
  const bool starts = std::fabs(low) < 1e-6 || (axis == 2 && std::fabs(low + 90) < 1e-6);
  if (!starts)
    return wrongAt(
        t, 0, axis == 0 ? "the first row must be at 0 degrees" : "the first row must be at 0 or -90 degrees");
  const bool ends = std::fabs(high - 90) < 1e-6 || (axis == 0 && std::fabs(high - 180) < 1e-6);
  if (!ends)
    return wrongAt(t, rows.size() - 1,
                   axis == 0 ? "the last row must be at 90 or 180 degrees"
                             : "the last row must be at 90 degrees");
  return std::nullopt;
}

}  // namespace

TableFlight tableFrom(const Rows& rows, double area, double length, int axis) {
  const Rows all = extended(rows, axis);
  TableFlight table;
  table.axis = axis;
  const double pieces = TableFlight::kPieces;
  for (std::size_t i = 0; i < TableFlight::kPieces; ++i) {
    Terms at[4];
    for (std::size_t k = 0; k < 4; ++k)
      at[k] = termsAt(angleAt(2 * (static_cast<double>(i) + static_cast<double>(k) / 3) / pieces), all, area,
                      length, axis);
    const auto cubic = [&at](double Terms::*m) {
      return cubicThrough(at[0].*m, at[1].*m, at[2].*m, at[3].*m);
    };
    table.pieces.push_back(
        {cubic(&Terms::across), cubic(&Terms::along), cubic(&Terms::turn), cubic(&Terms::damp)});
  }
  return table;
}

Result<TableFlight> readFlightTable(std::string_view text, const std::string& file, int otherwise,
                                    double bodyLength) {
  const auto read = readNumberColumns(text, file);
  if (!read) return read.error();
  const NumberColumns& t = read.value();
  Settings settings;
  settings.axis = otherwise;
  if (const auto wrong = readSettings(t, bodyLength, settings)) return *wrong;
  const auto alpha = t.column("alpha_deg"), moment = t.column("CM"), damping = t.column("CQ");
  const bool axial = t.column("CA") && t.column("CN");
  const auto first = t.column(axial ? "CA" : "CD"), second = t.column(axial ? "CN" : "CL");
  if (!alpha || !first || !second || !moment)
    return wrongAt(t, 0, "the columns must be alpha_deg, CD, CL (or CA, CN), CM and perhaps CQ");
  if (const auto wrong = wrongAir(t, settings, bodyLength)) return *wrong;
  Rows rows;
  for (std::size_t i = 0; i < t.rows.size(); ++i) {
    const std::vector<double>& r = t.rows[i];
    FlightTableRow row{r[*alpha] * kDegree, r[*first], r[*second], r[*moment], damping ? r[*damping] : 0};
    if (axial) {
      const auto [s, c] = det::sincos(row.alpha);
      const double a = row.drag, n = row.lift;
      row.drag = a * c + n * s;
      row.lift = n * c - a * s;
      if (row.drag < -1e-3 * (std::abs(a) + std::abs(n)))
        return wrongAt(t, i,
                       fmt::format("CA and CN make a drag of {:.3g}, which drives the body on", row.drag));
    }
    rows.push_back(row);
  }
  if (const auto wrong = wrongAngles(t, rows, settings.axis)) return *wrong;
  return tableFrom(rows, settings.area, settings.length, settings.axis);
}

std::string flightTableText(const Rows& rows, double area, double length, int axis) {
  std::string text = fmt::format("# area = {:.6g}\n# length = {:.6g}\n# axis = {}\nalpha_deg,CD,CL,CM,CQ\n",
                                 area, length, axis == 0 ? "x" : "z");
  for (const FlightTableRow& r : rows)
    text += fmt::format("{:.6g},{:.8g},{:.8g},{:.8g},{:.8g}\n", r.alpha / kDegree, r.drag, r.lift, r.moment,
                        r.damping);
  return text;
}

}  // namespace stadion
