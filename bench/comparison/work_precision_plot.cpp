#include "bench/comparison/work_precision_plot.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <set>

namespace stadion::bench {
namespace {

constexpr double kWidth = 860, kHeight = 520;
constexpr double kLeft = 80, kRight = 640, kTop = 50, kBottom = 460;
constexpr double kLeastError = 1e-16;
constexpr double kLabelWidth = 16, kLabelHeight = 12, kDotRadius = 4, kLetter = 7;  ///< [px]

/// From decades of a value to a place on the paper.
struct Axis {
  int first, last;  ///< decades
  double from, to;  ///< [px]

  double at(double value) const { return from + (std::log10(value) - first) / (last - first) * (to - from); }
};

Axis axisFor(const std::vector<double>& values, double from, double to) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  const int first = static_cast<int>(std::floor(std::log10(*least)));
  const int last = static_cast<int>(std::ceil(std::log10(*most)));
  return {first, std::max(last, first + 1), from, to};
}

struct Dot {
  int n;
  double cost, error;
};

using Series = std::pair<std::string, std::vector<Dot>>;

std::vector<Series> seriesOf(const std::vector<Measurement>& measurements) {
  std::vector<Series> all;
  for (const Measurement& m : measurements) {
    const double error = std::fabs(m.metric("err"));
    if (!m.played() || !(m.ns > 0) || !std::isfinite(error)) continue;
    auto found = std::find_if(all.begin(), all.end(), [&m](const Series& s) { return s.first == m.engine; });
    if (found == all.end()) found = all.insert(all.end(), {m.engine, {}});
    found->second.push_back({m.n, m.ns, std::max(error, kLeastError)});
  }
  for (Series& s : all)
    std::sort(s.second.begin(), s.second.end(), [](const Dot& a, const Dot& b) { return a.n < b.n; });
  return all;
}

std::string text(double x, double y, const std::string& anchor, const std::string& what) {
  return fmt::format("<text x='{:.1f}' y='{:.1f}' text-anchor='{}'>{}</text>\n", x, y, anchor, what);
}

std::string line(double x1, double y1, double x2, double y2) {
  return fmt::format("<line x1='{:.1f}' y1='{:.1f}' x2='{:.1f}' y2='{:.1f}' stroke='#ddd'/>\n", x1, y1, x2,
                     y2);
}

std::string gridOf(const Axis& cost, const Axis& error) {
  std::string svg;
  for (int d = cost.first; d <= cost.last; ++d) {
    const double x = cost.at(std::pow(10, d));
    svg += line(x, kTop, x, kBottom) + text(x, kBottom + 18, "middle", fmt::format("1e{}", d));
  }
  const int each = (error.last - error.first) / 10 + 1;
  for (int d = error.first; d <= error.last; d += each) {
    const double y = error.at(std::pow(10, d));
    svg += line(kLeft, y, kRight, y) +
           text(kLeft - 8, y + 4, "end", std::pow(10, d) > kLeastError ? fmt::format("1e{}", d) : "to 0");
  }
  return svg;
}

/// The numbers beside dots that are so close that their labels would overlap.
struct Label {
  double x, y;  ///< of the first dot
  std::set<int> n;
};

std::vector<Label> labelsOf(const std::vector<Series>& all, const Axis& cost, const Axis& error) {
  std::vector<Label> labels;
  for (const Series& s : all)
    for (const Dot& d : s.second) {
      const double x = cost.at(d.cost), y = error.at(d.error);
      auto near = std::ranges::find_if(labels, [&](const Label& l) {
        return std::fabs(l.x - x) < kLabelWidth && std::fabs(l.y - y) < kLabelHeight;
      });
      if (near == labels.end()) near = labels.insert(labels.end(), {x, y, {}});
      near->n.insert(d.n);
    }
  return labels;
}

/// The place of a label's text on the paper.
struct Words {
  double x, y, width;  ///< left end of the base line [px]
  bool meets(const Words& o) const {
    return x < o.x + o.width && o.x < x + width && std::fabs(y - o.y) < kLabelHeight;
  }
};

/// Draws the labels, each beside its dot unless another label is there already.
std::string drawLabels(const std::vector<Label>& labels) {
  std::vector<Words> taken;
  std::string svg;
  for (const Label& label : labels) {
    std::string numbers = label.n.size() > 1 ? "n=" : "";
    for (const int n : label.n) numbers += (n == *label.n.begin() ? "" : ",") + std::to_string(n);
    const double width = kLetter * static_cast<double>(numbers.size());
    const Words places[] = {{label.x + 7, label.y - 5, width},
                            {label.x + 7, label.y + 14, width},
                            {label.x - 7 - width, label.y - 5, width},
                            {label.x - 7 - width, label.y + 14, width}};
    const auto free = std::ranges::find_if(places, [&](const Words& w) {
      return std::ranges::none_of(taken, [&](const Words& t) { return w.meets(t); });
    });
    const Words& at = free == std::end(places) ? places[0] : *free;
    taken.push_back(at);
    svg += text(at.x, at.y, "start", numbers);
  }
  return svg;
}

/// Returns true if every dot of the series lies under one that is drawn later.
bool hidden(const std::vector<Series>& all, std::size_t number, const Axis& cost, const Axis& error) {
  return std::ranges::all_of(all[number].second, [&](const Dot& d) {
    for (std::size_t later = number + 1; later < all.size(); ++later)
      for (const Dot& o : all[later].second)
        if (std::hypot(cost.at(o.cost) - cost.at(d.cost), error.at(o.error) - error.at(d.error)) < kDotRadius)
          return true;
    return false;
  });
}

std::string draw(const Series& series, std::size_t number, bool under, const Axis& cost, const Axis& error) {
  static constexpr const char* kColours[] = {"#c00000", "#1f77b4", "#17becf", "#2ca02c",
                                             "#8c564b", "#9467bd", "#ff7f0e", "#7f7f7f"};
  const std::string colour = kColours[number % std::size(kColours)];
  std::string path, dots;
  for (const Dot& d : series.second) {
    const double x = cost.at(d.cost), y = error.at(d.error);
    path += fmt::format("{:.1f},{:.1f} ", x, y);
    dots += fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='{}' fill='{}'/>\n", x, y, kDotRadius, colour);
  }
  const double legend = kTop + 20 * static_cast<double>(number);
  return fmt::format("<polyline points='{}' fill='none' stroke='{}' stroke-width='1.5'/>\n", path, colour) +
         dots + fmt::format("<circle cx='{}' cy='{}' r='5' fill='{}'/>\n", kRight + 25, legend - 4, colour) +
         text(kRight + 38, legend, "start", series.first + (under ? " (under others)" : ""));
}

}  // namespace

std::string workPrecisionPlot(const std::string& title, const std::vector<Measurement>& measurements) {
  const std::vector<Series> all = seriesOf(measurements);
  std::string svg =
      fmt::format("<svg xmlns='http://www.w3.org/2000/svg' width='{0}' height='{1}' viewBox='0 0 "
                  "{0} {1}' font-family='sans-serif' font-size='12'>\n"
                  "<rect width='{0}' height='{1}' fill='white'/>\n",
                  kWidth, kHeight);
  svg += text(kLeft, 28, "start", title + ": error against cost (numbers: steps a frame)");
  if (all.empty()) return svg + text(kLeft, kTop + 20, "start", "nothing was measured") + "</svg>\n";
  std::vector<double> costs, errors;
  for (const Series& s : all)
    for (const Dot& d : s.second) {
      costs.push_back(d.cost);
      errors.push_back(d.error);
    }
  const Axis cost = axisFor(costs, kLeft, kRight), error = axisFor(errors, kBottom, kTop);
  svg += gridOf(cost, error);
  for (std::size_t i = 0; i < all.size(); ++i)
    svg += draw(all[i], i, hidden(all, i, cost, error), cost, error);
  svg += drawLabels(labelsOf(all, cost, error));
  svg += text((kLeft + kRight) / 2, kHeight - 16, "middle", "processor time per body and frame [ns]");
  svg += fmt::format("<text x='24' y='{0}' text-anchor='middle' transform='rotate(-90 24 {0})'>error "
                     "(metric \"err\")</text>\n",
                     (kTop + kBottom) / 2);
  return svg + "</svg>\n";
}

}  // namespace stadion::bench
