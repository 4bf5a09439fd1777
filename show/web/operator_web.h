#pragma once
/// The operator's web page of a running show: a further front of the operator console.
///
/// The page shows thumbnails of all views, the state of the show, walls and hosts, late frames with their causes, and
/// the log. Its commands are those of keys and of Open Sound Control, by the same names, and go into the same queue.
/// `/metrics` has figures for Prometheus.
///
/// It listens only if it was asked to, and answers only requests that know its token. It never delays a frame: the
/// show's threads leave what they know without waiting, and the page's threads run when the show leaves a processor
/// free.
///
/// Ownership  owns its server; borrows the reporter, and the queue from listen() on.
/// Threads    create(), listen(), beginShow(), passOnTo() and close() on the thread that opens shows; see() and
///            commanded() on the App thread; say() from any; frameMeter() and late() on the frame log's.
/// Errors     a wrong address, an unreadable token or a taken port is a finding.

#include "pipeline/operator/operator_queue.h"
#include "show/base/reporter.h"
#include "show/web/frame_meter.h"
#include "show/web/show_board.h"
#include "show/web/view_tap.h"
#include "show/web/view_thumbnails.h"
#include "show/web/web_log.h"
#include "show/web/web_server.h"
#include "show/web/web_settings.h"
#include "show/web/web_token.h"

#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

namespace stadion {

class Scene;

class OperatorWeb {
public:
  /// Null if the settings ask for no page, or with the reason in the findings.
  static std::unique_ptr<OperatorWeb> create(const WebSettings& settings, Reporter& reporter,
                                             Diagnostics& findings);
  ~OperatorWeb();

  /// Listens from now on, and reports the address. Commands go to `queue`. Only the first call counts. False, with the
  /// reason in the findings, if it cannot.
  bool listen(OperatorQueue& queue, Diagnostics& findings);
  /// Ends listening. The queue is not used any more.
  void close() { server_.reset(); }
  const WebAddress& address() const { return address_; }

  /// A line of the log.
  void say(const std::string& line);
  void say(const Diagnostics& findings);
  /// Receives the costs of frames.
  FrameMeter& frameMeter() { return meter_; }
  /// Receives late frames of a show with these walls.
  std::function<void(const FrameFacts&)> lateFunction(std::vector<std::string> walls);

  /// A show is about to be played.
  void beginShow(BoardShow show, const BoardFrame& first);
  /// Returns the sink for a show's pictures. It passes them on to `sink`, if there is one.
  PictureSink& sinkBefore(PictureSink* sink);
  /// A frame has been simulated.
  void see(const TimeSignature& now, std::uint64_t group, const OperatorState& state, const Scene& scene);
  /// The operator's commands have changed this.
  void commanded(const OperatorState& state);
  /// All hosts of a cluster.
  void seeHosts(std::vector<BoardHost> hosts);
  /// The show is over, and another one opens or none.
  void endShow(bool isLast);

  /// Answers a request. Any thread.
  WebAnswer answer(const WebRequest& request);

private:
  OperatorWeb(WebSettings settings, WebAddress address, WebToken token, Reporter& reporter);
  bool isAllowed(const WebRequest& request, WebAnswer& refusal) const;
  WebAnswer answerGet(const std::string& path);
  WebAnswer command(const WebRequest& request);
  std::string stateJson();
  std::string metrics() const;
  double uptime() const;

  using Clock = std::chrono::steady_clock;

  const WebSettings settings_;
  WebAddress address_;
  const WebToken token_;
  Reporter& reporter_;
  const Clock::time_point opened_ = Clock::now();
  WebLog log_, lateLog_;
  FrameMeter meter_;
  ShowBoard board_;
  // App's.
  BoardFrame frame_;
  std::uint64_t loadsSeen_ = 0;
  std::optional<std::vector<ShowCue>> cues_{};  ///< not published yet
  // The page's.
  OperatorQueue* queue_ = nullptr;
  std::atomic<std::uint64_t> commands_ = 0, unauthorized_ = 0;
  std::mutex stateMutex_;
  std::string state_;  ///< made at stateMade_, for all clients that ask within a moment
  Clock::time_point stateMade_{};
  ViewTap tap_;
  ViewThumbnails thumbnails_{tap_};
  std::unique_ptr<WebServer> server_;  ///< declared last: its threads use the others
};

}  // namespace stadion
