#pragma once
/// What a trace viewer would complain of, or draw wrongly: read as Perfetto's importer reads it.

#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace stadion {

class TraceChecks {
public:
  explicit TraceChecks(const std::string& text) : trace_(nlohmann::json::parse(text, nullptr, false)) {
    if (trace_.is_discarded() || !trace_.contains("traceEvents")) {
      complain("no JSON object with traceEvents");
      return;
    }
    if (trace_["displayTimeUnit"] != "ms") complain("displayTimeUnit is neither ms nor ns");
    for (const auto& e : trace_["traceEvents"]) read(e);
    // Events are sorted by time; of equal times the first one in the file comes first.
    std::ranges::stable_sort(events_, {}, [](const Event& e) { return e.ts; });
    for (const Event& e : events_) play(e);
    for (const auto& [id, flow] : flows_)
      if (flow.points != "stf") complain("flow " + std::to_string(id) + " is " + flow.points + ", not stf");
    for (const std::int64_t tid : tids_)
      if (!names_.contains(tid)) complain("thread " + std::to_string(tid) + " has no name");
  }

  /// The first few.
  const std::vector<std::string>& complaints() const { return complaints_; }
  std::size_t slices() const { return slices_; }
  std::size_t flows() const { return flows_.size(); }
  std::size_t deepest() const { return deepest_; }
  std::set<std::string> threadNames() const {
    std::set<std::string> names;
    for (const auto& [tid, name] : names_) names.insert(name);
    return names;
  }
  const std::set<std::string>& names() const { return sliceNames_; }
  const std::set<std::uint64_t>& frames() const { return frames_; }
  const nlohmann::json& json() const { return trace_; }

private:
  struct Event {
    double ts = 0, dur = 0;
    char ph = 0;
    std::int64_t tid = 0;
    std::uint64_t id = 0, frame = 0;
    std::string name;
  };
  struct Flow {
    std::string points;
    std::uint64_t frame = 0;
  };

  void complain(const std::string& what) {
    if (complaints_.size() < 10) complaints_.push_back(what);
  }

  void read(const nlohmann::json& e) {
    Event event;
    event.ph = e["ph"].get<std::string>()[0];
    if (event.ph == 'M') {
      if (e["name"] == "thread_name") names_[e["tid"]] = e["args"]["name"];
      return;
    }
    event.ts = e["ts"];
    if (event.ts < 0) complain("a negative time stamp is dropped");
    if (event.ph == 'C') return;
    event.tid = e["tid"], event.name = e["name"];
    tids_.insert(event.tid);
    if (event.ph == 'X') {
      event.dur = e["dur"], event.frame = e["args"]["frame"];
      if (event.dur < 0) complain("a negative duration");
      sliceNames_.insert(event.name), frames_.insert(event.frame), ++slices_;
    } else if (event.ph == 's' || event.ph == 't' || event.ph == 'f') {
      event.id = e["id"];
      if (event.ph == 'f' && e["bp"] != "e") complain("a flow's end is not bound to what is around it");
    } else {
      complain(std::string("an event of kind ") + event.ph);
    }
    events_.push_back(std::move(event));
  }

  void play(const Event& e) {
    auto& open = open_[e.tid];
    const auto end = [](const Event& o) { return o.ts + o.dur; };
    while (!open.empty() && (end(open.back()) < e.ts || (end(open.back()) == e.ts && e.ph == 'X' &&
                                                         !(open.back().dur == 0 && e.dur == 0))))
      open.pop_back();
    if (e.ph != 'X') return playFlow(e, open);
    if (!open.empty() && end(e) > end(open.back()))
      complain(e.name + " overlaps the end of " + open.back().name + " and is dropped");
    open.push_back(e);
    deepest_ = std::max(deepest_, open.size());
  }

  void playFlow(const Event& e, const std::vector<Event>& open) {
    const std::string id = std::to_string(e.id);
    const std::string stage = e.ph == 's' ? "App" : e.ph == 't' ? "Cull" : "Draw";
    if (open.empty()) return complain("flow " + id + ": nothing is around its point");
    const Event& outermost = open.front();
    if (outermost.name != stage) complain("flow " + id + ": in " + outermost.name + " instead of " + stage);
    if (e.ts > outermost.ts + outermost.dur) complain("flow " + id + ": its stage is over");
    if (e.ph == 's' && flows_.contains(e.id)) return complain("flow " + id + " begins twice");
    if (e.ph != 's' && !flows_.contains(e.id)) return complain("flow " + id + " has not begun");
    Flow& flow = flows_[e.id];
    if (e.ph == 's') flow.frame = outermost.frame;
    if (flow.frame != outermost.frame) complain("flow " + id + " leads from frame to frame");
    flow.points += e.ph;
  }

  nlohmann::json trace_;
  std::vector<Event> events_;
  std::map<std::int64_t, std::vector<Event>> open_;
  std::map<std::uint64_t, Flow> flows_;
  std::map<std::int64_t, std::string> names_;
  std::set<std::int64_t> tids_;
  std::set<std::string> sliceNames_;
  std::set<std::uint64_t> frames_;
  std::vector<std::string> complaints_;
  std::size_t slices_ = 0, deepest_ = 0;
};

}  // namespace stadion
