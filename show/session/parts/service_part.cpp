/// The service manager that started this process, such as systemd. A supervised player has none: its supervisor
/// speaks for it.

#include "show/session/session_part.h"

#include <fmt/format.h>

namespace stadion {
namespace {

constexpr Nanoseconds kStatusEvery = fromSeconds(10);

class ServicePart final : public SessionPart {
public:
  ServicePart(SessionState& session, std::unique_ptr<ServiceNotifier> service)
      : session_(session), service_(std::move(service)) {
    session.service = service_.get();
  }

  bool opened(Diagnostics&) override {
    session_.console->seen = [this] { service_->pictureShown(plays()); };
    return true;
  }
  void beforeFrames(ShowParts&, FrameLoopOptions&) override {
    service_->mayPause(false);
    // A show that waits for files does not hang.
    session_.player->tellWaiting([this](bool waits) { service_->mayPause(waits); });
  }
  void afterFrame(const TimeSignature& now, const InputSample&, const Scene&) override {
    if (!service_->isReady() || machineClock() < next_) return;
    next_ = machineClock() + kStatusEvery;
    service_->status(
        fmt::format("{}: frame {}, {:.3f} s of show time", plays(), now.frame, toSeconds(now.time)));
  }
  void ended(EndedLoop& show) override {
    if (show.ends)
      service_->stopping();
    else
      service_->mayPause(true);  // the next group's show opens
  }
  SessionEnd closed(SessionEnd end) override {
    service_->stopping();
    return end;
  }

private:
  std::string plays() const { return "plays " + session_.settings.show.script; }

  SessionState& session_;
  std::unique_ptr<ServiceNotifier> service_;
  Nanoseconds next_ = 0;  ///< when the status is sent again
};

}  // namespace

std::unique_ptr<SessionPart> makeServicePart(SessionState& session, Diagnostics&) {
  const SupervisionSettings& s = session.settings.supervision;
  if (s.progress >= 0) return nullptr;
  auto service = ServiceNotifier::open(s.service);
  return service ? std::make_unique<ServicePart>(session, std::move(service)) : nullptr;
}

}  // namespace stadion
