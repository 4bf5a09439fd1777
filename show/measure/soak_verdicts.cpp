#include "show/measure/soak_verdicts.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace stadion {
namespace {

constexpr double kMostSlope = 1024;  ///< [byte] in 10 000 frames
constexpr std::uint64_t kSlopeFrames = 10'000;
constexpr double kMostOfVisit = 4096;  ///< [byte] from visit to visit

class Verdicts {
public:
  void add(bool ok, std::string what) { all_.push_back({ok, std::move(what)}); }
  void addLasting(bool ok, std::string what) { all_.push_back({ok, std::move(what), true}); }
  void addOpen(std::string what) { all_.push_back({std::nullopt, std::move(what)}); }
  std::vector<SoakVerdict> take() { return std::move(all_); }

private:
  std::vector<SoakVerdict> all_;
};

/// Memory, in a visit or from visit to visit, handles and threads. What could not be judged is no pass, but
/// where the soak was stopped no failure either.
void judgeGrowth(Verdicts& v, const SoakRecord& record, std::uint64_t warmUp, bool stopped) {
  constexpr std::size_t kFewest = 10;
  const std::vector<SoakSample> samples = afterWarmUp(record.samples(), warmUp);
  const auto slope = [&](std::uint64_t SoakSample::*figure) {
    return slopeOf(samples, figure).value_or(0) * static_cast<double>(kSlopeFrames);
  };
  const bool inVisit = samples.size() >= kFewest;
  if (inVisit) {
    const double resident = slope(&SoakSample::residentBytes);
    v.addLasting(
        resident < kMostSlope,
        fmt::format("memory in a visit: {:+.1f} bytes in 10 000 frames (RSS; less than {} is asked for), "
                    "{:+.1f} of them asked for by the program; {} samples",
                    resident, kMostSlope, slope(&SoakSample::heapBytes), samples.size()));
  } else {
    v.addOpen(fmt::format("memory in a visit: {} samples after its first {} frames are too few",
                          samples.size(), warmUp));
  }
  const auto more = slopeOfVisits(record.samples(), &SoakSample::heapBytes);
  if (more)
    v.addLasting(
        *more < kMostOfVisit,
        fmt::format("memory from visit to visit: {:+.1f} bytes more asked for by the program (less than {}); "
                    "{:+.1f} bytes of RSS",
                    *more, kMostOfVisit, *slopeOfVisits(record.samples(), &SoakSample::residentBytes)));
  else
    v.addOpen("memory from visit to visit: too few visits (--visit)");
  if (!inVisit && !more && stopped)
    v.addOpen("memory was not judged: the soak was stopped");
  else if (!inVisit && !more)
    v.add(false,
          "memory was not judged: more --frames are needed, or --no-memory says that it is not asked for");
  if (record.samples().size() < kFewest) return;
  const auto handles = growthOf(record.samples(), &SoakSample::handles),
             threads = growthOf(record.samples(), &SoakSample::threads);
  v.addLasting(handles <= 0, fmt::format("handles: {:+} of {}", handles, record.samples().back().handles));
  v.addLasting(threads <= 0, fmt::format("threads: {:+} of {}", threads, record.samples().back().threads));
}

}  // namespace

bool isWell(const std::vector<SoakVerdict>& verdicts) {
  return std::ranges::all_of(verdicts, [](const SoakVerdict& v) { return v.ok.value_or(true); });
}

std::vector<std::string> failuresToKeep(const std::vector<SoakVerdict>& verdicts) {
  std::vector<std::string> failed;
  for (const SoakVerdict& v : verdicts)
    if (v.stays && v.ok == false) failed.push_back(v.what);
  return failed;
}

std::vector<SoakVerdict> verdictsOf(const SoakRecord& record, std::uint64_t wanted, bool judgesMemory) {
  const SoakCounts& c = record.counts;
  Verdicts v;
  v.add(c.wrongSteps == 0, fmt::format("time steps: {} of {} frames are not one tick after the one before",
                                       c.wrongSteps, c.frames));
  v.add(c.wrongHashes == 0,
        fmt::format("states: {} of {} histories compared differ", c.wrongHashes, c.compared));
  if (judgesMemory)
    judgeGrowth(v, record, std::min<std::uint64_t>(100'000, std::max(wanted, c.frames) / 5),
                c.frames < wanted);
  std::vector<SoakVerdict> all = v.take();
  const std::vector<std::string> failed = failuresToKeep(all);
  for (const std::string& what : record.failed())
    if (std::ranges::find(failed, what) == failed.end()) all.push_back({false, "before: " + what});
  return all;
}

}  // namespace stadion
