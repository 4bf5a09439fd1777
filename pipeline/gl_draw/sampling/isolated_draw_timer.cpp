#include "pipeline/gl_draw/sampling/isolated_draw_timer.h"

#include "engine/base/folder_names.h"

#include <cstdlib>
#include <fstream>
#include <string>

namespace stadion {
namespace {

/// The processor clock of another thread of this process, as Linux numbers them.
clockid_t clockOf(int thread) {
  constexpr int kPerThread = 4, kScheduled = 2;
  return static_cast<clockid_t>((~static_cast<unsigned>(thread)) << 3 | kPerThread | kScheduled);
}

double millisecondsOf(clockid_t clock) {
  timespec now{};
  if (clock_gettime(clock, &now) != 0) return 0;
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

}  // namespace

IsolatedDrawTimer::IsolatedDrawTimer(const GlTable& gl) : gl_(gl), software_(isSoftware(gl)) {
  if (software_)
    findRasteriser();
  else
    gl_.GenQueries(1, &query_);
}

IsolatedDrawTimer::~IsolatedDrawTimer() {
  if (query_) gl_.DeleteQueries(1, &query_);
}

/// Mesa names its threads llvmpipe-0, llvmpipe-1 and so on; they are there once a context is.
void IsolatedDrawTimer::findRasteriser() {
  for (const std::string& thread : namesIn("/proc/self/task")) {
    std::ifstream in("/proc/self/task/" + thread + "/comm");
    std::string name;
    if (std::getline(in, name) && name.starts_with("llvmpipe-"))
      rasteriser_.push_back(clockOf(std::atoi(thread.c_str())));
  }
}

double IsolatedDrawTimer::processorMs() const {
  double ms = millisecondsOf(CLOCK_THREAD_CPUTIME_ID);
  for (const clockid_t clock : rasteriser_) ms += millisecondsOf(clock);
  return ms;
}

void IsolatedDrawTimer::begin() {
  gl_.Finish();
  if (software_)
    began_ = processorMs();
  else
    gl_.BeginQuery(GL_TIME_ELAPSED, query_);
}

double IsolatedDrawTimer::end() {
  if (software_) {
    gl_.Finish();
    return processorMs() - began_;
  }
  gl_.EndQuery(GL_TIME_ELAPSED);
  GLuint64 nanoseconds = 0;
  gl_.GetQueryObjectui64v(query_, GL_QUERY_RESULT, &nanoseconds);
  return 1e-6 * static_cast<double>(nanoseconds);
}

}  // namespace stadion
