#pragma once
/// Everything that observes the frames of a show: the probe, sums, budgets, the last frames, the trace, and
/// names of nodes.
///
/// Threads  made before the run; see() on the App thread; figures() once the run is over.

#include "profiling/budget/degradation_governor.h"
#include "profiling/record/black_box.h"
#include "profiling/report/report_data.h"
#include "profiling/report/report_recording.h"
#include "profiling/report/show_figures.h"
#include "profiling/trace/trace_file.h"
#include "show/recording/crash_report.h"
#include "show/recording/governor_options.h"

#include <optional>
#include <utility>

namespace stadion {

struct RecordingOptions {
  bool profile = true;  ///< add up by node and stage
  FrameLogOptions log{};
  std::optional<BlackBoxOptions> keep{};  ///< the last frames, in a file
  std::optional<TraceOptions> trace{};    ///< every span, in a file
  /// Frame after frame, for a report.
  struct Report {
    double rate = 60;
    std::vector<std::string> walls;
  };
  std::optional<Report> report{};
  std::optional<GovernorOptions> govern{};  ///< look at budgets
  std::vector<SpanReader*> also{};          ///< further readers, which outlive the recording
};

class ShowRecording {
public:
  /// Null, with the reason in the findings, if a trace or the last frames cannot be kept. Last frames that
  /// were not asked for are left out instead.
  static std::unique_ptr<ShowRecording> create(RecordingOptions options, Diagnostics& findings) {
    std::unique_ptr<ShowRecording> made(new ShowRecording);
    std::vector<SpanReader*> readers;
    if (options.profile) readers.push_back(&made->profile_);
    readers.insert(readers.end(), options.also.begin(), options.also.end());
    if (options.govern) {
      made->governor_ = std::make_unique<DegradationGovernor>(std::move(*options.govern), made->names_);
      readers.push_back(made->governor_.get());
    }
    if (options.keep) {
      if (made->governor_)
        options.keep->overrun = [governor = made->governor_.get()](std::uint64_t frame) {
          return governor->overrunOf(frame);
        };
      const bool wanted = options.keep->wanted;
      auto box = BlackBox::create(std::move(*options.keep), made->names_);
      if (!box && wanted) {
        findings.add(box.error());
        return nullptr;
      }
      if (!box) findings.warning(box.error().where, box.error().message + kBlackBoxElsewhere);
      if (box) {
        made->box_ = std::move(box.value());
        readers.push_back(made->box_.get());
        made->crashFile_.emplace(made->box_->file());
      }
    }
    if (options.report) {
      made->report_ =
          std::make_unique<ReportRecording>(options.report->rate, options.report->walls, made->names_);
      readers.push_back(made->report_.get());
    }
    if (options.trace) {
      made->trace_ = std::make_unique<TraceFile>(std::move(*options.trace), made->names_);
      if (const auto& why = made->trace_->error()) {
        findings.add(*why);
        return nullptr;
      }
      readers.push_back(made->trace_.get());
    }
    made->sampled_ = options.profile;
    made->log_ = std::make_unique<FrameLog>(std::move(readers), options.log);
    return made;
  }

  FrameProbe& probe() { return *log_; }
  void see(const Scene& scene) {
    names_.see(scene);
    if (!governor_) return;
    if (!governor_->followLoads(scene)) return;
    log_->watch(governor_->accounts());
    // A budget on something that is drawn may come with any file.
    log_->setSamples(sampled_ || hasDrawnBudgets(scene));
  }
  /// Decides which nodes are degraded; null if budgets are not watched.
  DegradationGovernor* governor() { return governor_.get(); }
  /// Nothing more will come.
  void finish() { log_->finish(); }
  /// Completes the trace, if there is one.
  void finishTrace(Diagnostics& findings) {
    if (!trace_) return;
    finish();
    if (const auto why = trace_->finish()) findings.add(*why);
    if (const std::string left = trace_->leftOut(); !left.empty())
      findings.warning({}, "the trace leaves out " + left);
  }
  ShowFigures figures(const std::vector<std::string>& walls, std::string_view gl) {
    finish();
    return figuresOf(profile_, names_, walls, gl);
  }
  const ShowProfile& profile() {
    finish();
    return profile_;
  }
  /// Expects that a report was asked for; `figures` must outlive what is returned.
  ReportData report(ReportHead head, const ShowFigures& figures) {
    finish();
    head.frames = profile_.frames();
    head.recording = recordingMs();
    ReportData data{std::move(head), figures, names_, report_->series(), report_->kept(), {}, {}};
    data.threads = report_->threads().threads();
    for (const auto& [key, eye] : profile_.eyes())
      data.eyes.push_back(
          {key.first, key.second, eye.whole.mean(), eye.whole.percentile(95), eye.whole.count()});
    return data;
  }
  const BlackBox* blackBox() const { return box_.get(); }
  /// The run has failed: the file of the last frames stays.
  void keepLastFrames() {
    if (box_) box_->stay();
  }
  std::uint64_t lost() const { return log_->lost(); }

private:
  static constexpr const char* kBlackBoxElsewhere =
      "; the show is played without; --black-box FILE says where they could be, if frames come late";
  ShowRecording() = default;

  /// Returns the time that recording takes on all threads, a frame [ms].
  double recordingMs() const {
    double spans = 0;
    for (const auto& [key, total] : profile_.spans()) spans += static_cast<double>(total.ms.count());
    const SpanOverhead& each = log_->overhead();
    return 1e-6 * spans * (each.inside + each.outside) /
           static_cast<double>(std::max<std::uint64_t>(1, profile_.frames()));
  }

  bool sampled_ = false;  ///< drawing, also without a budget
  NodeNames names_;
  ShowProfile profile_{&names_};
  std::unique_ptr<DegradationGovernor> governor_;
  std::unique_ptr<BlackBox> box_;
  std::optional<CrashFileRegistration> crashFile_;  ///< names the file of the black box in a crash message
  std::unique_ptr<TraceFile> trace_;
  std::unique_ptr<ReportRecording> report_;
  std::unique_ptr<FrameLog> log_;
};

}  // namespace stadion
