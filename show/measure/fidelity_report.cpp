#include "show/measure/fidelity.h"

#include "engine/maths/angles.h"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace stadion {
namespace {

constexpr double kDegrees = 180 / kPi;
constexpr const char* kModes[] = {"flight", "slide", "roll", "contact", "rest", "held", "quarantined"};
constexpr const char* kFlights[] = {"exact", "order 16", "order 5"};
constexpr const char* kFlightHelp[] = {"in closed form", "by a series of order 16", "by steps of order 5"};

/// "0.39 mm", "1.2 m".
std::string lengthOf(double metres) {
  if (metres == 0) return "0";
  if (metres < 1e-9) return "< 1 nm";
  if (metres < 0.9995e-6) return fmt::format("{:.2g} nm", 1e9 * metres);
  if (metres < 0.9995e-3) return fmt::format("{:.3g} um", 1e6 * metres);
  return metres < 0.9995 ? fmt::format("{:.3g} mm", 1e3 * metres) : fmt::format("{:.3g} m", metres);
}

/// "flight 30 %, rest 70 %".
template <std::size_t N>
std::string shares(const std::array<std::uint64_t, N>& counts, const char* const (&names)[N]) {
  std::uint64_t all = 0;
  for (const std::uint64_t n : counts) all += n;
  std::string text;
  for (std::size_t i = 0; i < N; ++i)
    if (counts[i] > 0)
      text += fmt::format("{}{} {:.3g} %", text.empty() ? "" : ", ", names[i],
                          100 * static_cast<double>(counts[i]) / static_cast<double>(all));
  return text;
}

std::string fieldsOf(const PlayedBody& body) {
  std::string text;
  bool drag = false;
  for (const HookedField& f : body.fields) {
    text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", f.name, f.type);
    drag |= f.type == "medium";
  }
  if (text.empty()) text = "none";
  return text + (drag ? fmt::format("; drag area {:.3g} m2", body.dragArea) : "; no drag");
}

std::string describe(const BodyFidelity& b) {
  const PlayedBody& body = b.body;
  std::string text =
      fmt::format("\n{} ({}:{})\n", body.name.empty() ? "a body" : body.name, body.file, body.line);
  text += fmt::format("  collides as  a {}{}", nameOf(body.shape), body.chosen ? ", by shape=auto" : "");
  text += body.shape == ShapeKind::Mesh
              ? fmt::format(" of {} triangles\n", body.triangles)
              : fmt::format(", within {} of its {} triangles\n", lengthOf(body.deviation), body.triangles);
  text += fmt::format("  fields       {}\n", fieldsOf(body));
  text += fmt::format("  states       {} of its frames\n", shares(body.modes, kModes));
  if (const std::string flights = shares(body.flights, kFlightHelp); !flights.empty())
    text += fmt::format("  flight       {}\n", flights);
  return text + fmt::format("  share        {:.3g} us a frame of its dynamics node, by the arcs it begins\n",
                            b.cost);
}

/// "12.3", or what it is less than as far as can be measured.
std::string costOf(const TriedModel& t) {
  return t.cost > t.noise ? fmt::format("{:.3g}", t.cost)
         : t.noise > 0    ? fmt::format("< {:.2g}", t.noise)
                          : "0";
}

std::string rowOf(const TriedModel& t, double tolerance) {
  std::string remark = t.finest ? "the finest" : "";
  if (!t.finest)
    remark = t.beyondFrom ? fmt::format("beyond {} from {:.3f} s on", lengthOf(tolerance), *t.beyondFrom)
                          : fmt::format("within {}", lengthOf(tolerance));
  return fmt::format("    {:<26} {:>10} {:>10} {:>8.1f} {:>9}  {}\n", t.name, lengthOf(t.error),
                     lengthOf(t.endError), kDegrees * t.turned, costOf(t), remark);
}

std::string adviceFor(const BodyFidelity& b, double tolerance) {
  const bool good = std::ranges::none_of(b.tried, [](const TriedModel& t) { return t.asIs && t.beyondFrom; });
  std::string names;
  for (const TriedModel* t : advisable(b)) names += (names.empty() ? "" : "; ") + t->name;
  const std::string within = lengthOf(tolerance);
  if (good && std::ranges::none_of(b.tried, &TriedModel::simpler))
    return fmt::format("  As it is it stays within {}, and no model is simpler.\n", within);
  if (good)
    return names.empty() ? fmt::format("  As it is it stays within {}; nothing simpler does.\n", within)
                         : fmt::format("  As it is it stays within {}, and so does what is simpler: {}\n",
                                       within, names);
  return names.empty() ? fmt::format("  Only the finest model stays within {}.\n", within)
                       : fmt::format("  As it is it does not stay within {}; this does: {}\n", within, names);
}

nlohmann::json toJson(const TriedModel& t) {
  nlohmann::json j{{"model", t.name},
                   {"shape", t.model.shape},
                   {"steps_divided_by", t.model.fineness},
                   {"without", t.model.without},
                   {"as_is", t.asIs},
                   {"finest", t.finest},
                   {"simpler", t.simpler},
                   {"error_m", t.error},
                   {"end_error_m", t.endError},
                   {"turned_degrees", kDegrees * t.turned}};
  j["cost_us"] = t.cost > t.noise ? nlohmann::json(t.cost) : nlohmann::json();
  j["cost_noise_us"] = t.noise;
  j["beyond_from_s"] = t.beyondFrom ? nlohmann::json(*t.beyondFrom) : nlohmann::json();
  return j;
}

nlohmann::json toJson(const BodyFidelity& b) {
  const PlayedBody& body = b.body;
  nlohmann::json j{{"name", body.name},
                   {"file", body.file},
                   {"line", body.line},
                   {"shape", nameOf(body.shape)},
                   {"auto", body.chosen},
                   {"deviation_m", body.deviation},
                   {"triangles", body.triangles},
                   {"drag_area_m2", body.dragArea},
                   {"cost_us", b.cost}};
  j["fields"] = nlohmann::json::array();
  for (const HookedField& f : body.fields) j["fields"].push_back({{"name", f.name}, {"kind", f.type}});
  for (std::size_t i = 0; i < body.modes.size(); ++i) j["frames"][kModes[i]] = body.modes[i];
  for (std::size_t i = 0; i < body.flights.size(); ++i) j["flight_frames"][kFlights[i]] = body.flights[i];
  j["models"] = nlohmann::json::array();
  for (const TriedModel& t : b.tried) {
    j["models"].push_back(toJson(t));
    if (t.asIs) j["error_m"] = t.error;
  }
  const std::string caution = cautionAbout(b);
  j["caution"] = caution.empty() ? nlohmann::json() : nlohmann::json(caution);
  j["advice"] = nlohmann::json::array();
  for (const TriedModel* t : advisable(b)) j["advice"].push_back(t->name);
  return j;
}

}  // namespace

std::string fidelityTable(const Fidelity& f) {
  std::string text = fmt::format("{}: {} frames at {:g} Hz, {} {} that a dynamics node moves\n", f.show,
                                 f.frames, f.rate, f.bodies.size(), f.bodies.size() == 1 ? "body" : "bodies");
  for (const BodyFidelity& b : f.bodies) {
    if (b.tried.empty()) continue;
    text += describe(b);
    text += fmt::format("    {:<26} {:>10} {:>10} {:>8} {:>9}\n", "model", "error", "at the end", "degrees",
                        "us/frame");
    for (const TriedModel& t : b.tried) text += rowOf(t, f.tolerance);
    if (const std::string caution = cautionAbout(b); !caution.empty())
      text += fmt::format("  Caution: {}.\n", caution);
    text += adviceFor(b, f.tolerance);
  }
  if (f.lookedAt() == f.bodies.size()) return text;
  text += "\nNot played with other models (--most, --body):\n";
  for (const BodyFidelity& b : f.bodies)
    if (b.tried.empty())
      text += fmt::format("  {:<20} a {}, {}; {:.3g} us a frame\n", b.body.name, nameOf(b.body.shape),
                          shares(b.body.modes, kModes), b.cost);
  return text;
}

std::string fidelityJson(const Fidelity& f) {
  nlohmann::json j{{"show", f.show}, {"frames", f.frames}, {"rate", f.rate}, {"tolerance_m", f.tolerance}};
  j["bodies"] = nlohmann::json::array();
  for (const BodyFidelity& b : f.bodies) j["bodies"].push_back(toJson(b));
  return j.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace stadion
