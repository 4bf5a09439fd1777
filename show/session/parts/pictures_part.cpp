/// The output folder: pictures, contact sheets, a video, hashes.

#include "show/output/run_output.h"
#include "show/session/session_part.h"

#include <fmt/format.h>

namespace stadion {
namespace {

/// Width by height of what is shown.
double aspectOf(const WallEntry& entry) {
  if (!entry.isFlat()) return static_cast<double>(entry.outputSize().width) / entry.outputSize().height;
  const WallBasis shape = basis(entry.wall);
  return shape.width / shape.height;
}

class PicturesPart final : public SessionPart {
public:
  PicturesPart(SessionState& session, std::unique_ptr<OutputFolder> folder)
      : session_(session), folder_(std::move(folder)) {
    session.folder = folder_.get();
  }

  void beforeFrames(ShowParts& stages, FrameLoopOptions&) override {
    if (!output_) begin();
    stages.sink = output_.get();
    stages.drawUnseen = false;
  }
  void report(SessionReport& report) override {
    output_->finish(session_.stages->lastPictures());
    report.summary.files = output_->files();
    report.summary.remarks.insert(report.summary.remarks.end(), output_->remarks().begin(),
                                  output_->remarks().end());
    addFailure(report, output_->failure(), session_.reporter);
  }
  SessionEnd closed(SessionEnd end) override {
    if (session_.reported || !output_) return end;
    output_->finish({});  // the pictures that were shown before are kept
    if (!output_->failure()) return end;
    session_.reporter.fault(output_->failure()->message);
    return endOf(*output_->failure());
  }

private:
  /// Once everything is open: the files of the run before are removed only if this one is played.
  void begin() {
    const SessionSettings& s = session_.settings;
    const bool goesOn =
        session_.cluster && session_.cluster->goesOn();  // the files there belong to the same show
    if (const std::size_t removed = goesOn ? 0 : folder_->clear(); removed > 0)
      session_.reporter.hint(
          fmt::format("removed {} files of an earlier run from {}", removed, s.record.out));
    RunOutputOptions out{*folder_,
                         s.record.pictures,
                         s.record.sheets,
                         s.record.video,
                         s.record.hashes,
                         goesOn,
                         session_.player->rate(),
                         s.draw.layout,
                         {},
                         {}};
    for (const WallEntry& w : session_.player->walls().walls) {
      out.wallNames.push_back(w.wall.name);
      out.wallAspects.push_back(aspectOf(w));
    }
    output_ = std::make_unique<RunOutput>(std::move(out));
  }

  SessionState& session_;
  std::unique_ptr<OutputFolder> folder_;
  std::unique_ptr<RunOutput> output_;
};

}  // namespace

std::unique_ptr<SessionPart> makePicturesPart(SessionState& session, Diagnostics& findings) {
  if (session.settings.record.out.empty()) return nullptr;
  auto folder = OutputFolder::open(session.settings.record.out);
  if (!folder) {
    findings.add(folder.error());
    return nullptr;
  }
  return std::make_unique<PicturesPart>(session, std::move(folder.value()));
}

}  // namespace stadion
