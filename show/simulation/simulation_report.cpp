#include "show/simulation/simulation_report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace stadion {
namespace {

/// Pixels in a degree, where an angle between pixels is known.
double perDegree(double degrees) {
  return degrees > 0 ? 1 / degrees : 0;
}

double tooBrightShare(const SimulationResult& r) {
  return r.screenPoints > 0 ? static_cast<double>(r.tooBright) / static_cast<double>(r.screenPoints) : 0;
}

std::string projectorRow(const ProjectorFigures& p) {
  return fmt::format(" {:<20} {:>9.3f} {:>9.3f} {:>9.2f} {:>9.2f} {:>9.1f} {:>9.1f}{}\n", p.name,
                     p.geometry.mean(), p.geometry.most, 100 * p.luminance.mean(), 100 * p.luminance.most,
                     perDegree(p.sparseness.most), perDegree(p.sparseness.mean()),
                     p.lost > 0 ? fmt::format("   {} pixels show a wholly wrong direction", p.lost) : "");
}

nlohmann::ordered_json jsonOf(const ErrorFigures& e) {
  return {{"mean", e.mean()}, {"max", e.most}, {"count", e.count}};
}

}  // namespace

std::string textOf(const SimulationResult& r) {
  std::string text = fmt::format("Simulated {} head position{}, every {} pixel{} across and down.\n\n",
                                 r.heads, r.heads == 1 ? "" : "s", r.every, r.every == 1 ? "" : "s");
  text += fmt::format(" {:<20} {:>19} {:>19} {:>19}\n", "", "geometry [pixels]", "light [% of white]",
                      "pixels per degree");
  text += fmt::format(" {:<20} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9}\n", "projector", "mean", "max", "mean",
                      "max", "least", "mean");
  for (const ProjectorFigures& p : r.projectors) text += projectorRow(p);
  if (!r.seams.empty()) text += fmt::format("\n {:<42}\n", "overlap");
  for (const SeamFigures& s : r.seams)
    text += fmt::format(" {:<20} {:>9.3f} {:>9.3f} {:>9.2f} {:>9.2f}\n", s.one + " + " + s.two,
                        s.geometry.mean(), s.geometry.most, 100 * s.luminance.mean(), 100 * s.luminance.most);
  text += fmt::format(
      "\n largest geometric error  {:.3f} pixels\n largest error of light   {:.2f} % of white, of "
      "which rounding to 8 bits explains up to {:.2f} %\n",
      r.geometryMost(), 100 * r.luminanceMost(), 100 * r.stepsMost());
  text += fmt::format(
      " without light            {:.2f} % of the screens\n not blended              {:.2f} % of the "
      "screens\n",
      100 * r.uncoveredShare(), 100 * tooBrightShare(r));
  if (!r.suspect.empty()) text += fmt::format("\n projector \"{}\" stands out: {}\n", r.suspect, r.reason);
  return text;
}

nlohmann::ordered_json jsonOf(const SimulationResult& r) {
  using Json = nlohmann::ordered_json;
  Json projectors = Json::array(), seams = Json::array();
  for (const ProjectorFigures& p : r.projectors)
    projectors.push_back({{"name", p.name},
                          {"geometry_error_px", jsonOf(p.geometry)},
                          {"wrong_direction_pixels", p.lost},
                          {"luminance_error", jsonOf(p.luminance)},
                          {"luminance_error_alone", jsonOf(p.alone)},
                          {"luminance_steps_8_bit", p.steps},
                          {"pixels_per_degree_least", perDegree(p.sparseness.most)},
                          {"pixels_per_degree_mean", perDegree(p.sparseness.mean())}});
  for (const SeamFigures& s : r.seams)
    seams.push_back({{"projectors", {s.one, s.two}},
                     {"geometry_error_px", jsonOf(s.geometry)},
                     {"luminance_error", jsonOf(s.luminance)}});
  return {{"heads", r.heads},
          {"every", r.every},
          {"geometry_error_px_max", r.geometryMost()},
          {"luminance_error_max", r.luminanceMost()},
          {"luminance_steps_8_bit", r.stepsMost()},
          {"uncovered_fraction", r.uncoveredShare()},
          {"unblended_fraction", tooBrightShare(r)},
          {"suspect", r.suspect},
          {"reason", r.reason},
          {"projectors", projectors},
          {"seams", seams}};
}

}  // namespace stadion
