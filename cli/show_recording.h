#pragma once
/// Everything that looks on where a show's frames go: the probe, who adds up, and the names.
///
/// Threads  made before the run; see() on the App thread; figures() once the run is over.

#include "profiling/frame_log.h"
#include "profiling/show_figures.h"

namespace stadion {

class ShowRecording {
public:
  explicit ShowRecording(FrameLogOptions options = {}) : log_({&profile_}, options) {}

  FrameProbe& probe() { return log_; }
  void see(const Scene& scene) { names_.see(scene); }
  ShowFigures figures(const std::vector<std::string>& walls, bool software) {
    log_.finish();
    return figuresOf(profile_, names_, walls, software);
  }
  const ShowProfile& profile() {
    log_.finish();
    return profile_;
  }
  std::uint64_t lost() const { return log_.lost(); }

private:
  ShowProfile profile_;
  NodeNames names_;
  FrameLog log_;
};

}  // namespace stadion
