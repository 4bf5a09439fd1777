/// The operator's web page.

#include "show/session/session_part.h"

namespace stadion {
namespace {

constexpr std::uint64_t kHostsEvery = 30;  ///< [frames]

std::vector<BoardHost> boardHostsOf(const ClusterSession& cluster) {
  using Is = cluster::HostState::Is;
  std::vector<BoardHost> hosts;
  for (const cluster::HostState& h : cluster.hosts()) {
    const char* const state = h.is == Is::Leads   ? "leads"
                              : h.is == Is::Plays ? "plays"
                              : h.is == Is::Joins ? "joins"
                                                  : "is absent";
    hosts.push_back({h.name, h.differs ? "its scene differs" : state, h.is == Is::Leads,
                     (h.is == Is::Leads || h.is == Is::Plays) && !h.differs});
  }
  return hosts;
}

class WebPart final : public SessionPart {
public:
  explicit WebPart(SessionState& session) : session_(session), web_(*session.web) {
    session.reporter.showIn(&web_);
  }

  bool opened(Diagnostics& findings) override {
    OperatorConsole& console = *session_.console;
    if (!web_.listen(console.queue(), findings)) return false;
    console.commanded = [this](const OperatorState& state) { web_.commanded(state); };
    return true;
  }
  void beforeFrames(ShowParts& stages, FrameLoopOptions&) override {
    const OperatorConsole& console = *session_.console;
    web_.beginShow(boardShowOf(session_.settings.show.script, *session_.player, stages),
                   {0, console.groups(), 0, console.state()});
    stages.sink = &web_.sinkBefore(stages.sink);
  }
  void afterFrame(const TimeSignature& now, const InputSample&, const Scene& scene) override {
    web_.see(now, session_.console->groups(), session_.console->state(), scene);
    if (session_.cluster && now.frame % kHostsEvery == 0) web_.seeHosts(boardHostsOf(*session_.cluster));
  }
  void ended(EndedLoop& show) override { web_.endShow(show.ends && !show.rejoin); }
  SessionEnd closed(SessionEnd end) override {
    web_.close();
    return end;
  }

private:
  SessionState& session_;
  OperatorWeb& web_;
};

}  // namespace

std::unique_ptr<SessionPart> makeWebPart(SessionState& session, Diagnostics&) {
  if (session.settings.console.elsewhere) session.web = nullptr;  // the leader has the operator
  return session.web ? std::make_unique<WebPart>(session) : nullptr;
}

}  // namespace stadion
