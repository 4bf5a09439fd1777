#include "profiling/regression/page.h"

#include "engine/plain_text/markup_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

namespace stadion::regression {
namespace {

constexpr const char* kHead = R"(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>Stadion: regression suite</title>
<style>
body{font:15px/1.5 system-ui,sans-serif;max-width:72rem;margin:2rem auto;padding:0 1rem;color:#1c2733;background:#fff}
h1{font-size:1.5rem;margin:0}h2{font-size:1.1rem;margin:2rem 0 .5rem}.said{color:#5a6775;margin:.2rem 0 1.5rem}
.tiles{display:flex;gap:.8rem;margin:1rem 0}.tile{border:1px solid #d7dee6;border-radius:6px;padding:.5rem 1rem;min-width:6rem}
.tile b{display:block;font-size:1.5rem}.bad b{color:#b3261e}.good b{color:#1f7a3d}
table{border-collapse:collapse;width:100%}td,th{text-align:left;padding:.35rem .7rem;border-bottom:1px solid #e3e8ee;vertical-align:top}
th{color:#5a6775;font-weight:600}td.o{white-space:nowrap;font-weight:600}.passed{color:#1f7a3d}.failed{color:#b3261e}.skipped{color:#7a8794}
.moved{display:block;color:#b3261e}.plots{display:grid;grid-template-columns:repeat(auto-fill,minmax(21rem,1fr));gap:1rem}
figure{margin:0;border:1px solid #e3e8ee;border-radius:6px;padding:.5rem}figcaption{font-size:.85rem;color:#33414f}
svg{width:100%;height:auto;display:block}svg text{font:10px system-ui,sans-serif;fill:#5a6775}
details{margin:.6rem 0}summary{cursor:pointer;color:#33414f}
</style></head><body>
)";

/// In five characters or so: 210.5k.
std::string shortNumber(double v) {
  const double size = std::abs(v);
  if (size >= 1e9) return fmt::format("{:.4g}G", v / 1e9);
  if (size >= 1e6) return fmt::format("{:.4g}M", v / 1e6);
  if (size >= 1e4) return fmt::format("{:.4g}k", v / 1e3);
  return fmt::format("{:.4g}", v);
}

std::string tile(std::size_t count, const char* what, const char* kind) {
  return fmt::format("<div class=\"tile {}\"><b>{}</b>{}</div>", count > 0 ? kind : "", count, what);
}

std::string row(const CaseResult& c, const Check& k) {
  const char* outcome = k.outcome == Outcome::Passed   ? "passed"
                        : k.outcome == Outcome::Failed ? "failed"
                                                       : "skipped";
  return fmt::format("<tr><td>{}</td><td>{}</td><td class=\"o {}\">{}</td><td>{}{}</td></tr>\n",
                     markupText(c.name), markupText(k.metric), outcome, outcome, markupText(k.said),
                     k.culprit.empty() ? ""
                                       : "<span class=\"moved\">moved: " + markupText(k.culprit) + "</span>");
}

struct Point {
  double value;
  bool failed;
  const HistoryEntry* entry;
};

/// The least range of a plot relative to its middle value [1]: changes within a tolerance look flat.
constexpr double kLeastSpan = 0.06;

/// Points from left to right, the oldest first, on an axis from the least to the greatest value.
std::string plot(const std::vector<Point>& points) {
  constexpr double kWidth = 340, kHeight = 110, kLeft = 60, kRight = 12, kTop = 10, kBottom = 20;
  double low = points.front().value, high = low;
  for (const Point& p : points) {
    low = std::min(low, p.value);
    high = std::max(high, p.value);
  }
  const double middle = (low + high) / 2, least = middle == 0 ? 1 : kLeastSpan * std::abs(middle);
  if (high - low < least) {
    low = middle - least / 2;
    high = middle + least / 2;
  }
  const double room = 0.08 * (high - low);
  low -= room;
  high += room;
  const double step =
      points.size() > 1 ? (kWidth - kLeft - kRight) / static_cast<double>(points.size() - 1) : 0;
  const auto x = [&](std::size_t i) { return kLeft + step * static_cast<double>(i); };
  const auto y = [&](double v) { return kTop + (high - v) / (high - low) * (kHeight - kTop - kBottom); };

  std::string svg = fmt::format("<svg viewBox=\"0 0 {} {}\" role=\"img\">", kWidth, kHeight);
  for (const double v : {low + room, high - room}) {
    svg += fmt::format("<line x1=\"{}\" x2=\"{}\" y1=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"#e3e8ee\"/>", kLeft,
                       kWidth - kRight, y(v), y(v));
    svg += fmt::format("<text x=\"{}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>", kLeft - 5, y(v) + 3,
                       shortNumber(v));
  }
  svg += "<polyline fill=\"none\" stroke=\"#2f6fb0\" stroke-width=\"1.5\" points=\"";
  for (std::size_t i = 0; i < points.size(); ++i)
    svg += fmt::format("{:.1f},{:.1f} ", x(i), y(points[i].value));
  svg += "\"/>";
  for (std::size_t i = 0; i < points.size(); ++i)
    svg += fmt::format(
        "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\" fill=\"{}\"><title>{:.6g}, {}, {}</title></circle>",
        x(i), y(points[i].value), points[i].failed ? "#b3261e" : "#2f6fb0", points[i].value,
        markupText(points[i].entry->when), markupText(points[i].entry->program));
  svg += fmt::format("<text x=\"{}\" y=\"{}\">{}</text>", kLeft, kHeight - 5,
                     points.front().entry->when.substr(0, 10));
  if (points.size() > 1)
    svg += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"end\">{}</text>", kWidth - kRight, kHeight - 5,
                       points.back().entry->when.substr(0, 10));
  return svg + "</svg>";
}

std::string figureOf(const std::string& name, const std::vector<Point>& points) {
  return fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n", plot(points), markupText(name));
}

/// Times and instructions come first; counts, which hardly ever change, are folded away.
std::string historyOf(const std::string& name, const std::vector<HistoryEntry>& history) {
  std::set<std::string> figures;
  for (const HistoryEntry& e : history)
    if (const auto c = e.cases.find(name); c != e.cases.end())
      for (const auto& [figure, value] : c->second.figures) figures.insert(figure);
  std::string costs, counts;
  for (const std::string& figure : figures) {
    std::vector<Point> points;
    for (const HistoryEntry& e : history)
      if (const auto c = e.cases.find(name); c != e.cases.end())
        if (const auto v = c->second.figures.find(figure); v != c->second.figures.end())
          points.push_back({v->second, c->second.failedFigures.contains(figure), &e});
    (figure.ends_with("]") ? costs : counts) += figureOf(figure, points);
  }
  std::string text;
  if (!costs.empty()) text += "<div class=\"plots\">" + costs + "</div>\n";
  if (!counts.empty())
    text += "<details><summary>counts</summary><div class=\"plots\">" + counts + "</div></details>\n";
  return text;
}

std::string warningsOf(const SuiteResult& result) {
  if (result.warnings() == 0) return {};
  std::string text = "<h2>Warnings of shows</h2><ul>\n";
  for (const CaseResult& c : result.cases)
    for (const std::string& warning : c.warnings) text += "<li>" + markupText(warning) + "</li>\n";
  return text + "</ul>\n";
}

}  // namespace

std::string pageOf(const SuiteResult& result, const std::vector<HistoryEntry>& history) {
  std::string page = kHead;
  page += fmt::format("<h1>{}</h1><p class=\"said\">{} &middot; {}{}</p>\n", markupText(result.suite),
                      result.when, markupText(result.program),
                      result.against.empty() ? "" : " against " + markupText(result.against));
  page += "<div class=\"tiles\">" + tile(result.count(Outcome::Passed), "passed", "good") +
          tile(result.count(Outcome::Failed), "failed", "bad") +
          tile(result.faults(), "could not be played", "bad") +
          tile(result.count(Outcome::Skipped), "not compared", "") + "</div>\n";
  page +=
      "<table><thead><tr><th>case</th><th>compared</th><th>outcome</th><th>found</th></tr></thead><tbody>\n";
  for (const CaseResult& c : result.cases) {
    if (!c.fault.empty()) page += row(c, {"play", Outcome::Failed, c.fault});
    for (const Check& k : c.checks) page += row(c, k);
  }
  page += "</tbody></table>\n" + warningsOf(result) + "<h2>History</h2><p class=\"said\">The oldest of " +
          std::to_string(history.size()) +
          " runs is on the left; red is a figure that was not as it should be.</p>\n";
  for (const CaseResult& c : result.cases)
    page += "<h2>" + markupText(c.name) + "</h2>\n" + historyOf(c.name, history);
  return page + "</body></html>\n";
}

}  // namespace stadion::regression
