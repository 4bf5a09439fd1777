#pragma once
/// What drawing costs when nothing overlaps it: from an idle rasteriser to an idle rasteriser.
///
/// Software     processor time of the calling thread and of Mesa's rasteriser threads (OpenGL's own timer
///              queries say 30 to 100 times too little there). Expects that no other context of the process
///              draws meanwhile (GlRenderer: a turn).
/// Hardware     a query of the time that passed between the first and the last command.
///
/// Threads  the thread on which the context is current.

#include "pipeline/gl/gl_table.h"

#include <cstdint>
#include <ctime>
#include <vector>

namespace stadion {

class IsolatedDrawTimer {
public:
  explicit IsolatedDrawTimer(const GlTable& gl);
  ~IsolatedDrawTimer();
  IsolatedDrawTimer(const IsolatedDrawTimer&) = delete;
  IsolatedDrawTimer& operator=(const IsolatedDrawTimer&) = delete;

  /// Waits until everything that was told before is done.
  void begin();
  /// Waits until everything since begin() is done. Returns what it took [ms].
  double end();

private:
  void findRasteriser();
  double processorMs() const;

  const GlTable& gl_;
  bool software_;
  std::vector<clockid_t> rasteriser_;  ///< clocks of the rasteriser's threads
  GLuint query_ = 0;
  double began_ = 0;
};

}  // namespace stadion
