/// Hashes of pictures as lines, for runs without an output folder.

#include "show/output/hash_stream.h"
#include "show/session/session_part.h"

#include <fmt/format.h>

namespace stadion {
namespace {

class HashStreamPart final : public SessionPart {
public:
  explicit HashStreamPart(SessionState& session) : session_(session) {}

  void beforeFrames(ShowParts& stages, FrameLoopOptions& loop) override {
    stream_.reset();  // of the group before
    stream_ = std::make_unique<HashStream>(HashStreamOptions{session_.player->walls().names(),
                                                             session_.settings.record.hashLines, stages.sink,
                                                             loop.delivery == Delivery::Every});
    stages.sink = stream_.get();
  }
  void ended(EndedLoop&) override { leftOut_ += stream_->finish(); }
  void report(SessionReport& report) override {
    if (leftOut_ == 0) return;
    report.summary.remarks.push_back(
        fmt::format("the pictures of {} frames have no hash: the show went on without waiting", leftOut_));
  }

private:
  SessionState& session_;
  std::unique_ptr<HashStream> stream_;
  std::uint64_t leftOut_ = 0;
};

}  // namespace

std::unique_ptr<SessionPart> makeHashStreamPart(SessionState& session, Diagnostics&) {
  const RecordSettings& record = session.settings.record;
  const bool asked = record.hashes && record.out.empty() && record.hashLines;
  return asked ? std::make_unique<HashStreamPart>(session) : nullptr;
}

}  // namespace stadion
