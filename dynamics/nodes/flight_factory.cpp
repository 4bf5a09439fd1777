#include "dynamics/nodes/flight_factory.h"

#include "dynamics/flight/flight_shape.h"
#include "dynamics/flight/flight_table.h"
#include "dynamics/nodes/shape_store.h"
#include "engine/base/plain_file.h"
#include "engine/script/attribute_text.h"
#include "engine/script/declaration_check.h"
#include "engine/script/value.h"

#include <fmt/format.h>

namespace stadion {
namespace {

constexpr std::size_t kMostBytes = 1 << 20;     ///< of a table
constexpr std::size_t kSamples = 512;           ///< random vertices, as many as the paper's figure shows
constexpr double kRates[] = {1.8, 0.03, 0.07};  ///< of a bias, where the script states none; by BiasWord

enum class FlightWord : std::uint8_t { Point, Ballistic, Bias, Rod, Plate, Ball, Table };
enum class BiasWord : std::uint8_t { Flow, Paper, Covariance };
enum class AxesWord : std::uint8_t { Area, Vertices };

FlightKind kindOf(FlightWord word) {
  constexpr FlightKind kinds[] = {FlightKind::Ballistic, FlightKind::Ballistic, FlightKind::Bias,
                                  FlightKind::Rod,       FlightKind::Plate,     FlightKind::Ball,
                                  FlightKind::Table};
  return kinds[static_cast<std::size_t>(word)];
}

Diagnostic wrong(const Declaration& d, Attr attr, std::string why) {
  return {Severity::Error, d.where(attr), std::move(why), d.excerpt(attr)};
}

/// "rod takes 6 numbers: axial area [m2], ...".
std::string orderOf(FlightKind kind, std::string_view word) {
  const auto all = coefficientsOf(kind);
  std::string text = fmt::format("flight={} takes {} numbers: ", word, all.size());
  for (const Coefficient& c : all)
    text += fmt::format("{}{}{}", &c == all.data() ? "" : ", ", c.name,
                        *c.unit ? fmt::format(" [{}]", c.unit) : "");
  return text;
}

/// What no body of this length has: many times the coefficients of a flat plate across the wind. Such forces
/// would only make the flight stiff.
std::optional<Diagnostic> tooMuch(const Declaration& d, const Coefficient& c, double value, double length) {
  const std::string_view unit = c.unit;
  const int power = unit == "m" ? 1 : unit == "m2" ? 2 : unit == "m3" ? 3 : unit == "m4" ? 4 : 0;
  double most = 4;
  for (int i = 0; i < power; ++i) most *= length;
  if (power == 0 || std::abs(value) <= most) return std::nullopt;
  return wrong(
      d, Attr("coefficients"),
      fmt::format("{} is {} {}; a body of {:.3g} m has at most {:.3g}", c.name, value, c.unit, length, most));
}

/// With the numbers or the name that the script states.
Result<FlightModel> statedModel(const Declaration& d, FlightKind kind, const FlightShape& shape) {
  const std::string text(d.text("coefficients")), word(d.text("flight"));
  NumberList numbers;
  if (readNumbers(text, numbers, {}, {})) {
    if (auto model = shippedFlight(kind, text, shape)) return *model;
    return wrong(d, "coefficients",
                 fmt::format("flight={} knows no \"{}\"; it knows {}", word, shortened(text),
                             joinWithOr(shippedFlights(kind))));
  }
  const auto order = coefficientsOf(kind);
  if (numbers.count != order.size())
    return wrong(d, "coefficients", fmt::format("{}; not {}", orderOf(kind, word), numbers.count));
  for (std::size_t i = 0; i < order.size(); ++i)
    if (!(numbers.value[i] >= order[i].least && numbers.value[i] <= order[i].most))
      return wrong(d, "coefficients",
                   fmt::format("{} must be {}, not {}", order[i].name,
                               describe(NumberRange{order[i].least, order[i].most}, order[i].unit),
                               numbers.value[i]));
  for (std::size_t i = 0; i < order.size(); ++i)
    if (auto why = tooMuch(d, order[i], numbers.value[i], shape.length)) return *why;
  return *modelFrom(kind, {numbers.value.data(), numbers.count});
}

Result<FlightModel> modelOf(const Declaration& d, FlightKind kind, const FlightShape& shape) {
  if (kind == FlightKind::Ballistic || kind == FlightKind::Bias) return FlightModel{BallisticFlight{}};
  if (d.has("coefficients")) return statedModel(d, kind, shape);
  if (kind == FlightKind::Rod) return FlightModel{rodFrom(shape)};
  if (kind == FlightKind::Plate) return FlightModel{plateFrom(shape)};
  return FlightModel{ballFrom(shape)};
}

/// From the file that the script names.
Result<FlightModel> tableModel(const Declaration& d, const FlightShape& shape, const AssetRoots* roots) {
  const std::string name(d.text("flighttable"));
  const auto found = roots ? roots->open(name)
                           : Result<AssetRoots::Found>(wrong(d, "flighttable", "no folder to look for it"));
  if (!found) return wrong(d, "flighttable", found.error().message);
  const auto text = readPlainFile(found.value().file.get(), found.value().path, kMostBytes);
  if (!text) return wrong(d, "flighttable", text.error().message);
  auto table = readFlightTable(text.value(), found.value().path, shape.elongated() ? 0 : 2, shape.length);
  if (!table) {  // said where the script names the file, and where in the file
    const Diagnostic& e = table.error();
    return wrong(d, "flighttable",
                 fmt::format("{}:{}:{}: {}", e.where.file, e.where.line, e.where.column, e.message));
  }
  return FlightModel{std::move(table.value())};
}

/// A model of rods on what is plainly a disc, and the other way round, flies like neither.
void warnOfForeignModel(const NodeRequest& r, const FlightModel& model, const FlightShape& s) {
  constexpr double kPlainly = 2;
  const bool isLong = s.elongated() && s.length > kPlainly * s.width;
  const bool isFlat = !s.elongated() && s.width > kPlainly * s.thickness;
  const auto* table = std::get_if<TableFlight>(&model);
  const bool forLong = std::holds_alternative<RodFlight>(model) || (table && table->axis == 0);
  const bool forFlat = std::holds_alternative<PlateFlight>(model) || (table && table->axis == 2);
  if (!(isLong && forFlat) && !(isFlat && forLong)) return;
  const Declaration& d = r.declaration;
  const Attr attr = table ? Attr("flighttable") : Attr("flight");
  const std::string what = table ? std::string("axis = ") + (forLong ? "x" : "z") + " in this table"
                                 : fmt::format("flight={}", d.text("flight"));
  r.findings.warning(d.where(attr),
                     fmt::format("{} is for {} bodies; \"{}\" is {} ({:.3g} x {:.3g} x {:.3g} m)", what,
                                 forLong ? "long" : "flat", r.name, isLong ? "long" : "flat", s.length,
                                 s.width, s.thickness),
                     d.excerpt(attr));
}

Bias biasOf(const Declaration& d, const FlightShape& shape) {
  const auto word = static_cast<std::size_t>(d.optionalChoice<BiasWord>("bias").value_or(BiasWord::Flow));
  const double rate = d.optionalNumber("biasrate").value_or(kRates[word]);
  return biasFor(shape, static_cast<BiasForm>(word), rate);
}

/// The other end flies first.
void turnAround(FlightShape& s, double volume) {
  s.q_NA = s.q_NA * Quat(0, 0, 0, 1);  // half a turn about z
  s.sideArm = -s.sideArm;
  s.wetArm = -s.wetArm;
  // The moments of front and back differ by the volume (divergence theorem).
  s.noseArm = s.frontArea > 0 ? volume / s.frontArea - s.noseArm : 0;
}

/// The form of the model, its nose where the script says, its axes as the paper takes them if it says so.
FlightShape formOf(const Declaration& d, const Mesh& mesh, const MassProperties& mass) {
  FlightShape s = measureShape(mesh, mass.centre);
  const Vec3 nose = d.has("nose") ? d.vec3("nose") : s.q_NA * Vec3::UnitX();
  const auto volume = integrateVolume(mesh);
  if (nose.dot(s.q_NA * Vec3::UnitX()) < 0) turnAround(s, volume ? volume.value().volume : 0);
  if (d.optionalChoice<AxesWord>("axes") == AxesWord::Vertices) {
    s.axes = sampledAxes(mesh, kSamples);
    s.q_NA = s.axes.q_NP;
    if (nose.dot(s.q_NA * Vec3::UnitX()) < 0) s.q_NA = s.q_NA * Quat(0, 0, 0, 1);
  }
  return s;
}

}  // namespace

Result<std::shared_ptr<const BodyFlight>> flightOf(const NodeRequest& r, const MassProperties& mass,
                                                   const AssetRoots* roots) {
  const Declaration& d = r.declaration;
  const auto word = d.choice<FlightWord>("flight");
  if (word == FlightWord::Point) return std::shared_ptr<const BodyFlight>();
  const FlightKind kind = kindOf(word);
  const Mesh mesh = scaled(*r.mesh, scaleOf(r.place.X_PN).cast<float>());
  const FlightShape shape = formOf(d, mesh, mass);
  auto flight = std::make_shared<BodyFlight>();
  flight->q_NA = shape.q_NA;
  flight->inVacuum = kind == FlightKind::Ballistic;
  if (kind == FlightKind::Bias) flight->bias = biasOf(d, shape);
  auto model = kind == FlightKind::Table ? tableModel(d, shape, roots) : modelOf(d, kind, shape);
  if (!model) return model.error();
  flight->model = std::move(model.value());
  if (!r.mesh->standIn) warnOfForeignModel(r, flight->model, shape);
  return std::shared_ptr<const BodyFlight>(std::move(flight));
}

/// What only one way of flight has a use for.
void checkFlight(DeclarationCheck& check) {
  using enum FlightWord;
  const Declaration& d = check.declaration();
  const auto flight = d.choice<FlightWord>("flight");
  struct Use {
    std::string_view name;
    std::initializer_list<FlightWord> of;
    const char* words;
  };
  for (const Use& use :
       {Use{"coefficients", {Rod, Plate, Ball}, "rod, plate or ball"}, Use{"flighttable", {Table}, "table"},
        Use{"bias", {Bias}, "bias"}, Use{"biasrate", {Bias}, "bias"}, Use{"axes", {Bias}, "bias"}})
    if (d.has(Attr::of(use.name)) && std::ranges::find(use.of, flight) == use.of.end())
      check.error(Attr::of(use.name), fmt::format("{} is for flight={}, not for flight={}", use.name,
                                                  use.words, d.text("flight")));
  if (d.has("depth") && !d.has("sticks"))
    check.error("depth", "depth is how far in it sticks; it needs sticks: within which angle it does");
  if (flight == Table && !d.has("flighttable"))
    check.error("flight", "flight=table needs a flighttable: the file of its coefficients");
  const double rate = d.optionalNumber("biasrate").value_or(0);
  if (rate > 1 && d.optionalChoice<BiasWord>("bias") == BiasWord::Paper)
    check.error("biasrate",
                fmt::format("with bias=paper, biasrate is a share of the angle, at most 1, not {}", rate));
}

}  // namespace stadion
