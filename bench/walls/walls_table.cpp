#include "bench/walls/walls_table.h"

#include "bench/walls/walls_judge.h"

#include <fmt/format.h>

namespace stadion::bench {
namespace {

std::string cell(std::optional<double> value, int decimals) {
  return value ? fmt::format("{:.{}f}", *value, decimals) : "-";
}

/// Returns the row to compare a case with: OpenSceneGraph's best of the same scene at the same size.
std::string barFor(const nlohmann::json& row, const WallsResults& results) {
  const std::string engine = row.value("engine", "");
  if ((engine != "stadion" && engine != "osg") || row.value("walls", 0) != 4 || row.contains("nodes"))
    return {};
  return bestOsg(results, row.value("scene", ""), row.value("flat", 0) == 1,
                 row.value("width", 800) == 32 ? "SUBMIT" : "STRICT");
}

std::string lineOf(const std::string& name, const WallsResults& results) {
  const auto of = [&](const char* field) { return results.median(name, field); };
  const std::string bar = barFor(results.rowsOf(name).front(), results);
  const auto against = [&](const char* field) -> std::optional<double> {
    const auto ours = of(field), theirs = results.median(bar, field);
    if (bar.empty() || !ours || !theirs || *theirs <= 0) return std::nullopt;
    return *ours / *theirs;
  };
  return fmt::format("{:44} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8} {:>6} {:>6} {:>3}\n", name,
                     cell(of("fps"), 2), cell(of("frame_ms_median"), 1), cell(of("frame_ms_p99"), 1),
                     cell(of("latency_ms_median"), 1), cell(of("app_ms"), 3), cell(of("cull_ms_sum"), 3),
                     cell(of("draw_ms_sum"), 1), cell(of("cpu_ms_per_frame"), 1),
                     cell(of("draws_per_frame"), 0), cell(against("fps"), 2),
                     cell(against("cpu_ms_per_frame"), 2), results.count(name));
}

}  // namespace

std::string tableOf(const WallsResults& results) {
  std::string text =
      fmt::format("{:44} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8} {:>6} {:>6} {:>3}\n",
                  "[ms a frame, medians]", "fps", "frame", "p99", "latency", "app", "cull", "draw", "cpu",
                  "draws", "x fps", "x cpu", "n");
  for (const std::string& name : results.names())
    if (!name.starts_with("pictures ")) text += lineOf(name, results);
  return text;
}

std::string picturesOf(const WallsResults& results) {
  std::string text;
  for (const std::string& name : results.names()) {
    if (!name.starts_with("pictures ")) continue;
    const nlohmann::json& row = results.rowsOf(name).front();
    const double pixels = row.value("width", 0.0) * row.value("height", 0.0);
    const double worst = results.median(name, "beyond_share").value_or(1);
    const std::string view = row.value("worst_view", "");
    text += fmt::format("{}: {:.4f} % of all pixels differ from OpenSceneGraph's by more than 2/255, at most "
                        "{:.0f} of {:.0f} ({:.4f} %) of one view{}; the worst by {:.0f}\n",
                        name, 100 * results.median(name, "beyond_share_frame").value_or(1), worst * pixels,
                        pixels, 100 * worst, view.empty() ? "" : ", " + view,
                        results.median(name, "worst").value_or(255));
  }
  return text;
}

}  // namespace stadion::bench
