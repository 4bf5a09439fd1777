#include "bench/looks/looks_results.h"

#include "bench/looks/rungs.h"

#include <fmt/format.h>

#include <algorithm>

namespace stadion::bench {
namespace {

constexpr double kAlike = 1.02;       ///< errors that differ by less are the same
constexpr double kBetterCost = 2;     ///< largest cost of the better rung, as a multiple of the default's
constexpr double kBetterError = 0.8;  ///< largest error of the better rung, as a multiple of the default's
/// Largest cost of the filled stadium, with ten times the triangles, as a multiple of the other's.
constexpr double kFilledCost = 3;

/// A measure by which less is nearer.
struct Measure {
  const char* name;
  std::optional<double> (*of)(const LooksRow&);
};

constexpr Measure kMeasures[] = {
    {"mean", [](const LooksRow& r) -> std::optional<double> { return r.mean; }},
    {"99 %", [](const LooksRow& r) -> std::optional<double> { return r.p99; }},
    {"most", [](const LooksRow& r) -> std::optional<double> { return r.most; }},
    {"beyond 8", [](const LooksRow& r) -> std::optional<double> { return 1 - r.within8; }},
    {"flicker", [](const LooksRow& r) { return r.flicker; }},
    {"disparity", [](const LooksRow& r) { return r.disparity; }},
    {"butteraugli", [](const LooksRow& r) { return r.butteraugli; }},
    {"ssimulacra", [](const LooksRow& r) { return r.ssimulacra; }},
};

const LooksRow* rowOf(const std::vector<LooksRow>& rows, const LooksRow& where, std::string_view rung) {
  const auto it = std::ranges::find_if(rows, [&](const LooksRow& r) {
    return r.scene == where.scene && r.wall == where.wall && r.rung == rung;
  });
  return it == rows.end() ? nullptr : &*it;
}

/// Pairs of rows of two rungs on the same walls.
std::vector<std::pair<const LooksRow*, const LooksRow*>>
pairsOf(const std::vector<LooksRow>& rows, std::string_view one, std::string_view other) {
  std::vector<std::pair<const LooksRow*, const LooksRow*>> pairs;
  for (const LooksRow& row : rows)
    if (row.rung == one)
      if (const LooksRow* beside = rowOf(rows, row, other)) pairs.emplace_back(&row, beside);
  return pairs;
}

/// The walls on which the default is farther from the reference than OpenGL, by each measure.
void judgeDefault(const std::vector<LooksRow>& rows, std::vector<LooksLimit>& limits) {
  const auto pairs = pairsOf(rows, kDefaultRung, kOpenGlRung);
  if (pairs.empty()) return;
  for (const Measure& measure : kMeasures) {
    int farther = 0, compared = 0;
    for (const auto& [ours, openGl] : pairs) {
      const auto a = measure.of(*ours), b = measure.of(*openGl);
      if (!a || !b) continue;
      farther += *a > *b * kAlike;
      ++compared;
    }
    if (compared > 0)
      limits.push_back(
          {fmt::format("walls, of {}, where the default is farther than OpenGL ({})", compared, measure.name),
           static_cast<double>(farther), 0});
  }
}

void judgeBetter(const std::vector<LooksRow>& rows, std::vector<LooksLimit>& limits) {
  const auto pairs = pairsOf(rows, kBetterRung, kDefaultRung);
  if (pairs.empty()) return;
  double cost = 0, defaultCost = 0, error = 0, defaultError = 0;
  for (const auto& [better, standard] : pairs) {
    cost += better->leastMs;
    defaultCost += standard->leastMs;
    error += better->mean;
    defaultError += standard->mean;
  }
  limits.push_back(
      {"8 samples: cost, of the default's", defaultCost > 0 ? cost / defaultCost : 0, kBetterCost});
  limits.push_back(
      {"8 samples: mean error, of the default's", defaultError > 0 ? error / defaultError : 0, kBetterError});
}

/// What ten times as many triangles cost at the same moment.
void judgeFilled(const std::vector<LooksRow>& rows, std::vector<LooksLimit>& limits) {
  double filled = 0, usual = 0;
  for (const LooksRow& row : rows) {
    if (row.scene != "filled" || row.rung != kDefaultRung) continue;
    const auto beside = std::ranges::find_if(rows, [&](const LooksRow& r) {
      return r.scene == "olympia-1" && r.wall == row.wall && r.rung == row.rung;
    });
    if (beside == rows.end()) continue;
    filled += row.leastMs;
    usual += beside->leastMs;
  }
  if (usual > 0) limits.push_back({"filled stadium: cost, of olympia-1", filled / usual, kFilledCost});
}

std::string shown(const std::optional<double>& value, int digits) {
  return value ? fmt::format("{:.{}f}", *value, digits) : "-";
}

nlohmann::json jsonValue(const std::optional<double>& value) {
  return value ? nlohmann::json(*value) : nlohmann::json(nullptr);
}

}  // namespace

std::vector<LooksLimit> limitsOf(const std::vector<LooksRow>& rows) {
  std::vector<LooksLimit> limits;
  judgeDefault(rows, limits);
  judgeBetter(rows, limits);
  judgeFilled(rows, limits);
  return limits;
}

std::string headOfTable() {
  return "scene      wall   rung       ms a view  least   mean  99 %  most  within 8  flicker  disparity  "
         "butteraugli  ssimulacra\n";
}

std::string lineOf(const LooksRow& r) {
  return fmt::format(
      "{:<10} {:<6} {:<10} {:>9.2f} {:>6.2f} {:>6.2f} {:>5} {:>5} {:>7.2f} % {:>8} {:>10} {:>12} {:>11}\n",
      r.scene, r.wall, r.rung, r.ms, r.leastMs, r.mean, r.p99, r.most, 100 * r.within8, shown(r.flicker, 3),
      shown(r.disparity, 3), shown(r.butteraugli, 2), shown(r.ssimulacra, 4));
}

std::string lineOf(const LooksLimit& l) {
  return fmt::format("{:<72} {:>6.2f}  (at most {})  {}\n", l.what, l.value, l.most,
                     l.met() ? "ok" : "MISSED");
}

nlohmann::json jsonOf(const LooksRow& r) {
  return {{"bench", "looks"},
          {"scene", r.scene},
          {"wall", r.wall},
          {"rung", r.rung},
          {"ms", r.ms},
          {"ms_least", r.leastMs},
          {"mean", r.mean},
          {"p99", r.p99},
          {"max", r.most},
          {"within_8", r.within8},
          {"flicker", jsonValue(r.flicker)},
          {"disparity_px", jsonValue(r.disparity)},
          {"butteraugli", jsonValue(r.butteraugli)},
          {"ssimulacra", jsonValue(r.ssimulacra)}};
}

nlohmann::json jsonOf(const LooksLimit& l) {
  return {{"bench", "looks"}, {"limit", l.what}, {"value", l.value}, {"most", l.most}, {"ok", l.met()}};
}

}  // namespace stadion::bench
