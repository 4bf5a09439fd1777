#pragma once
/// Everything that looks on where a show's frames go: the probe, who adds up, who judges, and the names.
///
/// Threads  made before the run; see() on the App thread; figures() once the run is over.

#include "profiling/black_box.h"
#include "profiling/load/load_governor.h"
#include "profiling/show_figures.h"

#include <optional>

namespace stadion {

struct RecordingOptions {
  bool profile = true;  ///< add up by node and stage
  FrameLogOptions log{};
  std::optional<BlackBoxOptions> keep{};    ///< the last frames, in a file
  std::optional<GovernorOptions> govern{};  ///< look at budgets
};

class ShowRecording {
public:
  /// Null, with the reason in the findings, if the last frames cannot be kept.
  static std::unique_ptr<ShowRecording> create(RecordingOptions options, Diagnostics& findings) {
    std::unique_ptr<ShowRecording> made(new ShowRecording);
    std::vector<SpanReader*> readers;
    if (options.profile) readers.push_back(&made->profile_);
    if (options.govern) {
      made->governor_ = std::make_unique<LoadGovernor>(std::move(*options.govern), made->names_);
      readers.push_back(made->governor_.get());
    }
    if (options.keep) {
      if (made->governor_)
        options.keep->overrun = [governor = made->governor_.get()](std::uint64_t frame) {
          return governor->overrunOf(frame);
        };
      auto box = BlackBox::create(std::move(*options.keep), made->names_);
      if (!box) return findings.add(box.error()), nullptr;
      made->box_ = std::move(box.value());
      readers.push_back(made->box_.get());
    }
    made->log_ = std::make_unique<FrameLog>(std::move(readers), options.log);
    return made;
  }

  FrameProbe& probe() { return *log_; }
  void see(const Scene& scene) {
    names_.see(scene);
    if (governor_) governor_->see(scene);
  }
  /// Who decides what is given up; null if nobody looks at budgets.
  LoadGovernor* governor() { return governor_.get(); }
  /// Nothing more will come.
  void finish() { log_->finish(); }
  ShowFigures figures(const std::vector<std::string>& walls, bool software) {
    finish();
    return figuresOf(profile_, names_, walls, software);
  }
  const ShowProfile& profile() {
    finish();
    return profile_;
  }
  const BlackBox* blackBox() const { return box_.get(); }
  std::uint64_t lost() const { return log_->lost(); }

private:
  ShowRecording() = default;

  ShowProfile profile_;
  NodeNames names_;
  std::unique_ptr<LoadGovernor> governor_;
  std::unique_ptr<BlackBox> box_;
  std::unique_ptr<FrameLog> log_;
};

}  // namespace stadion
