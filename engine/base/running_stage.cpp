#include "engine/base/running_stage.h"

namespace stadion {
namespace {

// A signal handler must find it without a call that may allocate.
[[gnu::tls_model("initial-exec")]] thread_local constinit StageRecord* volatile runningStage = nullptr;

}  // namespace

StageRecord* RunningStage::current() {
  return runningStage;
}

void RunningStage::begin(StageRecord* stage) {
  runningStage = stage;
}

}  // namespace stadion
