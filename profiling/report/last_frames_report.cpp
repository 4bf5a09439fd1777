#include "profiling/report/last_frames_report.h"

#include "engine/plain_text/markup_text.h"
#include "profiling/report/page_parts.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace stadion {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kStagesOf = 5;  ///< the last frames whose stages are listed

/// Where a stage's time went, on the slowest wall.
struct SlowestStages {
  float app = 0, cull = 0, draw = 0;
};

SlowestStages slowestOf(const FrameFacts& f) {
  SlowestStages s{f.app.ms, 0, 0};
  for (std::uint32_t wall = 0; wall < f.walls; ++wall) {
    s.cull = std::max(s.cull, f.cull[wall].ms);
    s.draw = std::max(s.draw, f.draw[wall].ms);
  }
  return s;
}

/// "frame 812: 16.7 ms after the one before; App 1.1, Cull 0.3, Draw 9.8 ms, of the slowest walls".
std::string stagesText(const FrameFacts& f) {
  const SlowestStages s = slowestOf(f);
  return fmt::format(
      "frame {}: {:.1f} ms after the one before; App {:.1f}, Cull {:.1f}, Draw {:.1f} ms, of the "
      "slowest walls{}{}",
      f.frame, f.period, s.app, s.cull, s.draw, f.name[0] != 0 ? "; most expensive in App: " : "", f.name);
}

std::string causeName(Cause cause) {
  return cause == Cause::None ? "in time" : std::string(nameOf(cause));
}

std::map<Cause, std::uint64_t> causesOf(const BlackBox::Content& content) {
  std::map<Cause, std::uint64_t> causes;
  for (const FrameFacts& f : content.frames) ++causes[f.cause];
  return causes;
}

double shortMs(float ms) {
  return std::round(1e3 * static_cast<double>(ms)) / 1e3;
}

Json stageJson(const StageFacts& s) {
  return {{"ms", shortMs(s.ms)},
          {"processor_ms", shortMs(s.processor)},
          {"turn_ms", shortMs(s.turn)},
          {"loading_ms", shortMs(s.loading)},
          {"delayed_ms", shortMs(s.delayed)},
          {"begins_ms", shortMs(s.at)},
          {"switches", s.switches},
          {"page_faults", s.faults}};
}

Json frameJson(const FrameFacts& f, const std::vector<std::string>& walls) {
  Json j{{"frame", f.frame},
         {"period_ms", shortMs(f.period)},
         {"budget_ms", shortMs(f.budget)},
         {"late", f.cause != Cause::None},
         {"app", stageJson(f.app)},
         {"swap", stageJson(f.swap)}};
  if (f.cause != Cause::None) {
    j["cause"] = nameOf(f.cause);
    j["said"] = toText(f, walls);
  }
  if (f.name[0] != 0) {
    j["most_expensive_node"] = f.name;
    j["most_expensive_node_ms"] = shortMs(f.nodeMs);
  }
  j["walls"] = Json::array();
  for (std::uint32_t wall = 0; wall < f.walls; ++wall)
    j["walls"].push_back({{"cull", stageJson(f.cull[wall])}, {"draw", stageJson(f.draw[wall])}});
  return j;
}

/// Bars of the frames: how long each took, with a mark for the budget. Late ones are red.
class FrameChart {
public:
  explicit FrameChart(const std::vector<FrameFacts>& frames) : frames_(frames) {
    for (const FrameFacts& f : frames) most_ = std::max({most_, f.period, 1.5F * f.budget});
  }

  std::string svg(const std::vector<std::string>& walls) const {
    const double width = kWidth / static_cast<double>(std::max<std::size_t>(1, frames_.size()));
    std::string text = fmt::format(
        "<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"time of each frame\">", kWidth, kHeight + 16);
    for (std::size_t i = 0; i < frames_.size(); ++i) text += bar(i, width, walls);
    const float budget = frames_.empty() ? 0 : frames_.back().budget;
    if (budget > 0)
      text += fmt::format("<line x1=\"0\" x2=\"{0}\" y1=\"{1:.1f}\" y2=\"{1:.1f}\" stroke=\"var(--mark)\" "
                          "stroke-dasharray=\"4 4\"/><text x=\"2\" y=\"{2:.1f}\">{3:.1f} ms</text>",
                          kWidth, kHeight - height(budget), kHeight - height(budget) - 3, budget);
    return text + "</svg>";
  }

private:
  static constexpr double kWidth = 1200, kHeight = 180;

  double height(float ms) const {
    return most_ > 0 ? kHeight * std::min(1.0, static_cast<double>(ms / most_)) : 0;
  }
  std::string bar(std::size_t i, double width, const std::vector<std::string>& walls) const {
    const FrameFacts& f = frames_[i];
    const bool late = f.cause != Cause::None;
    return fmt::format(
        "<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"var(--{})\">"
        "<title>{}</title></rect>",
        static_cast<double>(i) * width, kHeight - height(f.period), std::max(0.5, 0.9 * width),
        height(f.period), late ? "bad" : "frame", markupText(late ? toText(f, walls) : stagesText(f)));
  }

  const std::vector<FrameFacts>& frames_;
  float most_ = 0;
};

std::string lateTable(const BlackBox::Content& content) {
  std::string rows;
  for (const FrameFacts& f : content.frames)
    if (f.cause != Cause::None) {
      const SlowestStages s = slowestOf(f);
      rows += fmt::format("<tr><td>{}</td><td>{:.1f}</td><td>{:.1f}</td><td>{:.1f}</td><td>{:.1f}</td>"
                          "<td>{}</td></tr>\n",
                          f.frame, f.period, s.app, s.cull, s.draw, markupText(toText(f, content.walls)));
    }
  if (rows.empty()) return "<p class=\"say\">No frame was late.</p>";
  return "<table><thead><tr><th>frame</th><th>ms</th><th>App</th><th>Cull</th><th>Draw</th>"
         "<th>cause</th></tr></thead><tbody>\n" +
         rows + "</tbody></table>";
}

}  // namespace

std::string lastFramesText(const BlackBox::Content& content) {
  std::string text;
  for (const FrameFacts& f : content.frames)
    if (f.cause != Cause::None) text += toText(f, content.walls) + "\n";
  const std::vector<FrameFacts>& frames = content.frames;
  for (std::size_t i = frames.size() - std::min(kStagesOf, frames.size()); i < frames.size(); ++i)
    text += stagesText(frames[i]) + "\n";
  text += fmt::format("{} frames:", frames.size());
  for (const auto& [cause, count] : causesOf(content))
    text += fmt::format(" {} {},", count, causeName(cause));
  return text + fmt::format(" the last one {}\n", frames.empty() ? 0 : frames.back().frame);
}

std::string lastFramesJson(const BlackBox::Content& content, const std::string& file) {
  Json j{{"format", "stadion last frames 1"}, {"file", file}, {"walls", content.walls}};
  j["causes"] = Json::object();
  j["frames"] = Json::array();
  for (const auto& [cause, count] : causesOf(content)) j["causes"][causeName(cause)] = count;
  for (const FrameFacts& f : content.frames) j["frames"].push_back(frameJson(f, content.walls));
  return j.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string lastFramesPage(const BlackBox::Content& content, const std::string& file) {
  std::string tiles;
  for (const auto& [cause, count] : causesOf(content))
    tiles += fmt::format("<div class=\"tile {}\"><b>{}</b><span>{}</span></div>",
                         cause == Cause::None ? "good" : "bad", count, markupText(causeName(cause)));
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
      "<title>Stadion: last frames</title>\n<style>{}</style></head><body><main>\n"
      "<header><h1>The last {} frames</h1><p>{}</p></header>\n<div class=\"tiles\">{}</div>\n"
      "<section><h2>Time of each frame</h2><p class=\"say\">Milliseconds since the frame before was "
      "shown; red: late. Point at a bar for its stages.</p>{}</section>\n"
      "<section><h2>Late frames</h2><p class=\"say\">App, Cull and Draw in ms, of the slowest "
      "walls.</p>{}</section>\n</main></body></html>\n",
      report::kStyle, content.frames.size(), markupText(file), tiles,
      FrameChart(content.frames).svg(content.walls), lateTable(content));
}

}  // namespace stadion
