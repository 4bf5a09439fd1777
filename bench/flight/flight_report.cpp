#include "bench/flight/flight_report.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace stadion::bench {
namespace {

const char* nameOf(Thing thing) {
  return factsOf(thing).name;
}

std::string ladderText(const Ladder& ladder) {
  std::string text = fmt::format(
      "Models against the exact ones: errors of range and landing in % (rms), of attitude in degrees (mean)\n"
      "  {:<9}{:<18}{:^28}{:^38}\n  {:<27}{:>9}{:>9}{:>10}{:>10}{:>9}{:>9}{:>10}\n",
      "", "", "reference flights", "held-out flights", "", "range", "landing", "attitude", "range", "landing",
      "most", "attitude");
  for (const RungResult& r : ladder.rungs)
    text += fmt::format("  {:<9}{:<18}{:>9.3f}{:>9.3f}{:>10.2f}{:>10.3f}{:>9.3f}{:>9.3f}{:>10.2f}\n",
                        nameOf(r.thing), r.rung, 100 * r.reference.range, 100 * r.reference.landing,
                        r.reference.attitude, 100 * r.heldOut.range, 100 * r.heldOut.landing,
                        100 * r.heldOut.landingMost, r.heldOut.attitude);
  return text;
}

std::string integratorText(const Integrators& all) {
  std::string text =
      "Integrators with the exact models, on the reference flights: landing (rms) in parts of the range;\n"
      "order: how fast it falls with the rate, between 1e-13 (rounding) and 1e-2 (lost)\n";
  for (const Thing thing : {Thing::Javelin, Thing::Discus, Thing::Ball}) {
    text += fmt::format("  {:<9}{:<10}{:>10}{:>11}{:>12}{:>9}{:>9}\n", nameOf(thing), "scheme", "Hz",
                        "landing", "attitude", "ns", "order");
    for (const IntegratorResult& r : all.results) {
      if (r.thing != thing) continue;
      const double order = all.order(thing, r.scheme);
      const bool last = r.hz == 960;
      text +=
          fmt::format("  {:<9}{:<10}{:>10}{:>11.2e}{:>12.2e}{:>9.0f}{:>9}\n", "", r.scheme, r.hz, r.landing,
                      r.attitude, r.ns, last && std::isfinite(order) ? fmt::format("{:.2f}", order) : "");
    }
  }
  return text;
}

/// Returns the rung's error on held-out flights of the object for which the cost was measured.
const RungResult* errorOf(const Ladder& ladder, const std::string& rung) {
  const Thing thing = rung == "plate" || rung == "table" ? Thing::Discus
                      : rung == "ball"                   ? Thing::Ball
                                                         : Thing::Javelin;
  const auto found = std::ranges::find_if(
      ladder.rungs, [&](const RungResult& r) { return r.thing == thing && r.rung == rung; });
  return found == ladder.rungs.end() ? nullptr : &*found;
}

std::string costText(const Costs& costs, const Ladder& ladder) {
  std::string text =
      fmt::format("What a step of 1/60 s costs a body, and how far off it is (held-out flights)\n"
                  "  {:<18}{:>8}{:>12}{:>11}{:>10}{:>12}{:>12}{:>11}\n",
                  "rung", "ns", "of 1000", "/single", "/free", "/bias=paper", "landing %", "attitude");
  for (const StepCost& s : costs.steps) {
    const RungResult* error = errorOf(ladder, s.rung);
    text += fmt::format("  {:<18}{:>8.1f}{:>12}{:>11}{:>10.2f}{:>12.2f}{:>12.3f}{:>11.2f}\n", s.rung, s.ns,
                        s.batch > 0 ? fmt::format("{:.1f}", s.batch) : "-",
                        s.batch > 0 ? fmt::format("{:.2f}", s.batchOfOne) : "-", s.ofFree, s.ofBias,
                        error ? 100 * error->heldOut.landing : NAN, error ? error->heldOut.attitude : NAN);
  }
  return text;
}

std::string checkText(const Check& c) {
  const std::string unit = c.unit.empty() ? "" : " " + c.unit;
  std::string range = fmt::format("at most {:.6g}", c.most);
  if (c.least > 0) range = fmt::format("{:.6g} to {:.6g}", c.least, c.most);
  return fmt::format("  {:<8}{}: {:.3g}{}, {}{}\n", c.met() ? "met" : "MISSED", c.what, c.value, unit, range,
                     unit);
}

nlohmann::ordered_json numberOrNull(double x) {
  return std::isfinite(x) ? nlohmann::ordered_json(x) : nlohmann::ordered_json();
}

nlohmann::ordered_json errorsJson(const SetErrors& e) {
  return {{"range_rms", e.range},
          {"landing_rms", e.landing},
          {"landing_max", e.landingMost},
          {"attitude_mean_deg", e.attitude}};
}

}  // namespace

Checks FlightReport::checks() const {
  Checks all;
  for (const Checks* some : {&ladder.checks, &integrators.checks, &costs.checks, &published.checks, &hard})
    all.insert(all.end(), some->begin(), some->end());
  return all;
}

bool allMet(const FlightReport& report) {
  return std::ranges::all_of(report.checks(), &Check::met);
}

std::string textOf(const FlightReport& report) {
  std::string text = ladderText(report.ladder) + "\n" + integratorText(report.integrators) + "\n" +
                     costText(report.costs, report.ladder) + "\n";
  const PublishedThrows& p = report.published;
  text +=
      fmt::format("Best throw of a discus at 25 m/s, 42 rad/s: {:.2f} m, released at {:.1f}, pitched {:.1f}, "
                  "rolled {:.1f} degrees\n\nLimits\n",
                  p.discusRange, p.gamma, p.pitch, p.roll);
  const Checks checks = report.checks();
  for (const Check& c : checks) text += checkText(c);
  const auto met = std::ranges::count_if(checks, &Check::met);
  return text +
         fmt::format("{} limits met, {} missed\n", met, static_cast<std::ptrdiff_t>(checks.size()) - met);
}

namespace {

nlohmann::ordered_json objectOf(const FlightReport& report) {
  using Json = nlohmann::ordered_json;
  Json json{{"bench", "flight"}, {"ok", allMet(report)}};
  for (const RungResult& r : report.ladder.rungs)
    json["ladder"].push_back({{"object", nameOf(r.thing)},
                              {"rung", r.rung},
                              {"reference", errorsJson(r.reference)},
                              {"held_out", errorsJson(r.heldOut)}});
  for (const IntegratorResult& r : report.integrators.results)
    json["integrators"].push_back({{"object", nameOf(r.thing)},
                                   {"scheme", r.scheme},
                                   {"hz", r.hz},
                                   {"landing_rms", numberOrNull(r.landing)},
                                   {"landing_max", numberOrNull(r.worst)},
                                   {"attitude_mean_deg", numberOrNull(r.attitude)},
                                   {"ns_per_step", r.ns},
                                   {"order", numberOrNull(report.integrators.order(r.thing, r.scheme))}});
  for (const StepCost& s : report.costs.steps) {
    const RungResult* error = errorOf(report.ladder, s.rung);
    json["costs"].push_back({{"rung", s.rung},
                             {"ns", s.ns},
                             {"ns_in_batches_of_1000", s.batch > 0 ? Json(s.batch) : Json()},
                             {"of_force_free", s.ofFree},
                             {"of_paper_bias", s.ofBias},
                             {"landing_rms", error ? numberOrNull(error->heldOut.landing) : Json()},
                             {"attitude_mean_deg", error ? numberOrNull(error->heldOut.attitude) : Json()}});
  }
  const PublishedThrows& p = report.published;
  json["discus_optimum"] = {
      {"range_m", p.discusRange}, {"release_deg", p.gamma}, {"pitch_deg", p.pitch}, {"roll_deg", p.roll}};
  json["javelin_30_34_m"] = p.javelinRange;
  for (const Check& c : report.checks())
    json["limits"].push_back({{"what", c.what},
                              {"value", numberOrNull(c.value)},
                              {"least", numberOrNull(c.least)},
                              {"most", numberOrNull(c.most)},
                              {"unit", c.unit},
                              {"met", c.met()}});
  return json;
}

}  // namespace

std::string jsonOf(const FlightReport& report) {
  return objectOf(report).dump();
}

std::string indentedJsonOf(const FlightReport& report) {
  return objectOf(report).dump(1) + "\n";
}

}  // namespace stadion::bench
