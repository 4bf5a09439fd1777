#include "show/web/web_metrics.h"

#include "show/base/version.h"
#include "show/web/web_state.h"

#include <fmt/format.h>

#include <array>
#include <iterator>

namespace stadion {
namespace {

/// A text between quotes, as a label's value.
std::string labelValue(std::string_view text) {
  std::string value;
  for (const char c : text) {
    if (c == '\n') {
      value += "\\n";
      continue;
    }
    if (c == '\\' || c == '"') value += '\\';
    value += c;
  }
  return value;
}

class MetricsWriter {
public:
  void family(std::string_view name, std::string_view type, std::string_view help) {
    fmt::format_to(out(), "# HELP {} {}\n# TYPE {} {}\n", name, help, name, type);
  }
  void value(std::string_view name, double value, std::string_view labels = "") {
    const char* const open = labels.empty() ? "" : "{";
    const char* const close = labels.empty() ? "" : "}";
    fmt::format_to(out(), "{}{}{}{} {}\n", name, open, labels, close, value);
  }
  void one(std::string_view name, std::string_view type, std::string_view help, double number) {
    family(name, type, help);
    value(name, number);
  }
  void summary(std::string_view name, const DurationSummary& s, const std::string& labels) {
    const std::string comma = labels.empty() ? "" : ",";
    const std::array<std::pair<const char*, double>, 4> quantiles{
        {{"0.5", s.p50}, {"0.9", s.p90}, {"0.99", s.p99}, {"1", s.most}}};
    for (const auto& [quantile, seconds] : quantiles)
      value(name, seconds, fmt::format("{}{}quantile=\"{}\"", labels, comma, quantile));
    value(fmt::format("{}_sum", name), s.sum, labels);
    value(fmt::format("{}_count", name), static_cast<double>(s.count), labels);
  }
  std::string take() { return std::move(text_); }

private:
  std::back_insert_iterator<std::string> out() { return std::back_inserter(text_); }
  std::string text_;
};

std::string wallLabel(const BoardStatus& status, std::uint32_t wall) {
  const std::string name =
      wall < status.show.walls.size() ? status.show.walls[wall].name : std::to_string(wall);
  return fmt::format("wall=\"{}\"", labelValue(name));
}

void writeShow(const WebMetrics& m, MetricsWriter& w) {
  const BoardStatus& s = m.status;
  w.family("stadion_info", "gauge", "The program and its show.");
  w.value("stadion_info", 1,
          fmt::format("version=\"{}\",show=\"{}\"", labelValue(kVersion), labelValue(s.show.script)));
  w.one("stadion_uptime_seconds", "gauge", "Time since the program began.", m.uptime);
  w.one("stadion_show_time_seconds", "gauge", "Time of the show.", toSeconds(s.frame.time));
  w.one("stadion_groups_total", "counter", "Groups of visitors so far, this one included.",
        static_cast<double>(s.frame.group));
  w.family("stadion_phase", "gauge", "What the show does: 1 for the present phase.");
  for (const char* phase : {"opening", "waiting", "paused", "playing", "over"})
    w.value("stadion_phase", phaseName(s) == phase ? 1 : 0, fmt::format("phase=\"{}\"", phase));
  w.one("stadion_black", "gauge", "1 while the walls are black.", s.frame.state.presentation.black ? 1 : 0);
  w.one("stadion_test_pattern", "gauge", "1 while the walls show the test pattern.",
        s.frame.state.presentation.pattern ? 1 : 0);
  w.one("stadion_commands_total", "counter", "Commands from the web page.", static_cast<double>(m.commands));
}

void writeFrames(const WebMetrics& m, MetricsWriter& w) {
  const MeteredFrames& f = m.frames;
  w.one("stadion_frames_shown_total", "counter", "Frames that all walls have shown.",
        static_cast<double>(f.period.count));
  w.one("stadion_frame_rate", "gauge", "Frames a second at present.", f.framesPerSecond);
  w.family("stadion_late_frames_total", "counter", "Frames that came late, by cause.");
  for (auto cause = static_cast<std::uint32_t>(Cause::App);
       cause <= static_cast<std::uint32_t>(Cause::Unknown); ++cause) {
    const auto found = f.late.find(static_cast<Cause>(cause));
    w.value("stadion_late_frames_total", found == f.late.end() ? 0 : static_cast<double>(found->second),
            fmt::format("cause=\"{}\"", nameOf(static_cast<Cause>(cause))));
  }
  w.family("stadion_frame_period_seconds", "summary",
           "From one shown frame to the next; quantiles of the last 600.");
  w.summary("stadion_frame_period_seconds", f.period, "");
  const std::array<std::pair<Span, const char*>, 4> stages{
      {{Span::App, "app"}, {Span::Cull, "cull"}, {Span::Draw, "draw"}, {Span::Swap, "swap"}}};
  w.family("stadion_stage_seconds", "summary", "Duration of a stage; quantiles of the last 600 frames.");
  for (const auto& [stage, name] : stages)
    for (const auto& [key, summary] : f.stages)
      if (key.first == stage)
        w.summary("stadion_stage_seconds", summary,
                  fmt::format("stage=\"{}\"", name) +
                      (key.second == kNoWall ? "" : "," + wallLabel(m.status, key.second)));
}

void writeHealth(const WebMetrics& m, MetricsWriter& w) {
  w.family("stadion_wall_well", "gauge", "1 if the wall draws in time, else 0.");
  for (std::uint32_t wall = 0; wall < m.status.show.walls.size(); ++wall)
    w.value("stadion_wall_well", healthOf(wall, m.status.show.rate, m.frames) == "well" ? 1 : 0,
            wallLabel(m.status, wall));
  if (!m.status.hosts.empty())
    w.family("stadion_host_well", "gauge", "1 if the host of the cluster plays, else 0.");
  for (const BoardHost& host : m.status.hosts)
    w.value("stadion_host_well", host.isWell ? 1 : 0, fmt::format("host=\"{}\"", labelValue(host.name)));
}

void writePage(const WebMetrics& m, MetricsWriter& w) {
  w.family("stadion_web_requests_total", "counter", "Requests to this page, by outcome.");
  const std::array<std::pair<const char*, std::uint64_t>, 4> outcomes{{{"answered", m.gate.answered},
                                                                       {"malformed", m.gate.refused},
                                                                       {"slow", m.gate.slow},
                                                                       {"replaced", m.gate.replaced}}};
  for (const auto& [outcome, count] : outcomes)
    w.value("stadion_web_requests_total", static_cast<double>(count), fmt::format("outcome=\"{}\"", outcome));
  w.one("stadion_web_unauthorized_total", "counter", "Requests without the right token.",
        static_cast<double>(m.unauthorized));
  w.one("stadion_web_connections", "gauge", "Open connections.", static_cast<double>(m.gate.open));
}

}  // namespace

std::string metricsText(const WebMetrics& metrics) {
  MetricsWriter writer;
  writeShow(metrics, writer);
  writeFrames(metrics, writer);
  writeHealth(metrics, writer);
  writePage(metrics, writer);
  return writer.take();
}

}  // namespace stadion
