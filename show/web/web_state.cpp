#include "show/web/web_state.h"

#include "show/base/version.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

using PageJson = nlohmann::ordered_json;

constexpr double kSilent = 2;  ///< [s]

/// Milliseconds with two decimals: the page shows no more.
double webMs(double seconds) {
  return std::round(1e5 * seconds) / 100;
}

PageJson summaryJson(const DurationSummary& s) {
  return {{"p50", webMs(s.p50)}, {"p99", webMs(s.p99)}, {"most", webMs(s.most)}};
}

PageJson stageJson(const MeteredFrames& frames, Span stage, std::uint32_t wall) {
  const auto found = frames.stages.find({stage, wall});
  return found == frames.stages.end() ? PageJson() : summaryJson(found->second);
}

std::string dumped(const PageJson& json) {
  return json.dump(-1, ' ', false, PageJson::error_handler_t::replace) + "\n";
}

PageJson wallsJson(const WebState& s) {
  PageJson walls = PageJson::array();
  for (std::size_t w = 0; w < s.status.show.walls.size(); ++w) {
    const BoardWall& wall = s.status.show.walls[w];
    const auto number = static_cast<std::uint32_t>(w);
    PageJson views = PageJson::array();
    for (std::size_t v = 0; v < wall.views.size(); ++v)
      views.push_back({{"name", wall.views[v]}, {"picture", w < s.pictures.size() ? s.pictures[w][v] : 0}});
    const auto ago = s.frames.drawnAgo.find(number);
    walls.push_back(
        {{"name", wall.name},
         {"health", healthOf(number, s.status.show.rate, s.frames)},
         {"cull", stageJson(s.frames, Span::Cull, number)},
         {"draw", stageJson(s.frames, Span::Draw, number)},
         {"drawnAgo",
          ago == s.frames.drawnAgo.end() ? PageJson() : PageJson(std::round(10 * ago->second) / 10)},
         {"views", std::move(views)}});
  }
  return walls;
}

PageJson operatorJson(const OperatorState& o) {
  return {{"waiting", o.waiting},
          {"paused", o.paused},
          {"black", o.presentation.black},
          {"testPattern", o.presentation.pattern},
          {"swapEyes", o.presentation.swapEyes},
          {"eyeSeparation", o.eyeSeparation()},
          {"freezeHead", o.headFrozen},
          {"volume", o.volume},
          {"latency", o.mostInFlight > 0 ? o.mostInFlight : o.runMostInFlight}};
}

}  // namespace

std::string healthOf(std::uint32_t wall, double rate, const MeteredFrames& frames) {
  const auto ago = frames.drawnAgo.find(wall);
  const auto draw = frames.stages.find({Span::Draw, wall});
  if (ago == frames.drawnAgo.end() || draw == frames.stages.end()) return "unknown";
  if (ago->second > kSilent) return "silent";
  return rate > 0 && draw->second.p90 > 1.5 / rate ? "late" : "well";
}

std::string phaseName(const BoardStatus& status) {
  if (status.phase == BoardPhase::Opening) return "opening";
  if (status.phase == BoardPhase::Over) return "over";
  return status.frame.state.waiting ? "waiting" : status.frame.state.paused ? "paused" : "playing";
}

std::string toJson(const WebState& s) {
  const BoardStatus& b = s.status;
  PageJson late{{"total", 0}, {"causes", PageJson::object()}};
  std::uint64_t total = 0;
  for (const auto& [cause, count] : s.frames.late) {
    total += count;
    late["causes"][std::string(nameOf(cause))] = count;
  }
  late["total"] = total;
  PageJson cues = PageJson::array(), hosts = PageJson::array();
  for (const ShowCue& c : b.cues)
    cues.push_back({{"number", c.number}, {"name", c.name}, {"label", c.label}});
  for (const BoardHost& h : b.hosts)
    hosts.push_back({{"name", h.name}, {"leads", h.leads}, {"state", h.state}, {"well", h.isWell}});
  return dumped({{"program", std::string("stadion ") + kVersion},
                 {"show", b.show.script},
                 {"phase", phaseName(b)},
                 {"time", toSeconds(b.frame.time)},
                 {"frame", b.frame.frame},
                 {"group", b.frame.group},
                 {"uptime", std::round(s.uptime)},
                 {"rate", b.show.rate},
                 {"framesPerSecond", std::round(10 * s.frames.framesPerSecond) / 10},
                 {"period", summaryJson(s.frames.period)},
                 {"app", stageJson(s.frames, Span::App, kNoWall)},
                 {"late", std::move(late)},
                 {"operator", operatorJson(b.frame.state)},
                 {"cues", std::move(cues)},
                 {"hosts", std::move(hosts)},
                 {"walls", wallsJson(s)},
                 {"lastLine", s.lastLine},
                 {"lastLate", s.lastLate}});
}

std::string linesJson(const std::vector<WebLogLine>& lines) {
  PageJson list = PageJson::array();
  for (const WebLogLine& l : lines)
    list.push_back({{"number", l.number}, {"uptime", std::round(10 * l.uptime) / 10}, {"text", l.text}});
  return dumped(list);
}

}  // namespace stadion
