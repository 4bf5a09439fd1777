#include "pipeline/device/live_trackers.h"

#include "engine/input/tracker_names.h"
#include "engine/plain_text/text_line.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <chrono>
#include <cmath>

namespace stadion {

Nanoseconds steadyNow() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

LiveTrackers::LiveTrackers(const RigFile& rig, Tell tell, std::function<Nanoseconds()> clock)
    : feed_(rig), tell_(std::move(tell)), clock_(std::move(clock)) {}

void LiveTrackers::tellOnce(const std::string& what) {
  if (told_.size() < kMostToldOf && told_.insert(what).second) tell_(what);
}

template <class Take>
void LiveTrackers::take(std::string_view tracker, const Take& measurement) {
  const std::lock_guard lock(mutex_);
  const std::uint64_t unknown = feed_.counts().unknown, refused = feed_.counts().refused;
  measurement();
  if (feed_.counts().unknown != unknown)
    tellOnce(fmt::format("tracker {} is not in the rig file, which has {}; what it says is left out",
                         quotedWord(tracker), fmt::join(names(), ", ")));
  if (feed_.counts().refused != refused)
    tellOnce(
        fmt::format("tracker {} says what cannot be (not finite, too far away, no rotation, no such button "
                    "or axis); it is left out",
                    quotedWord(tracker)));
}

void LiveTrackers::pose(std::string_view tracker, Nanoseconds clock, const Pose& X_SD) {
  take(tracker, [&] { feed_.pose(tracker, clock, X_SD); });
}

void LiveTrackers::button(std::string_view tracker, Nanoseconds clock, std::int64_t index, bool down) {
  take(tracker, [&] { feed_.button(tracker, clock, index, down); });
}

void LiveTrackers::axis(std::string_view tracker, Nanoseconds clock, std::int64_t index, double value) {
  take(tracker, [&] { feed_.axis(tracker, clock, index, value); });
}

void LiveTrackers::late(std::string_view tracker) {
  take(tracker, [&] { feed_.late(); });
}

void LiveTrackers::clockWasSet(std::string_view tracker, Nanoseconds by) {
  const std::lock_guard lock(mutex_);
  if (told_.size() >= kMostToldOf || !told_.insert(fmt::format("clock {}", tracker)).second) return;
  tell_(fmt::format("tracker {}: its sender's clock was set {} by {:.2f} s; its poses go on by the new time",
                    tracker, by < 0 ? "back" : "forward", std::abs(toSeconds(by))));
}

std::string_view LiveTrackers::nameOf(std::string_view device, std::string_view standard) const {
  for (const RigTracker& t : feed_.rig().trackers)
    if (t.sentAs == device) return t.name;
  if (knows(device)) return device;
  const RigTracker* const usual = feed_.rig().find(standard);
  return usual && usual->sentAs.empty() ? std::string_view(usual->name) : device;
}

void LiveTrackers::misunderstood(const std::string& what) {
  const std::lock_guard lock(mutex_);
  tellOnce(what);
}

void LiveTrackers::sampleFrame(Nanoseconds start, Nanoseconds end, InputSample& sample) {
  const std::lock_guard lock(mutex_);
  feed_.sampleFrame(clock_(), start, end, sample);
  reportReception();
}

void LiveTrackers::reportReception() {
  for (const TrackerFeed::Reception& h : feed_.receptionChanges(clock_()))
    tell_(h.heard ? fmt::format("tracker {} is heard of again, after {:.1f} s", h.tracker, h.silent)
                  : fmt::format("tracker {} is silent", h.tracker));
}

bool LiveTrackers::sampleNow(InputSample& sample) {
  const std::lock_guard lock(mutex_);
  feed_.sampleNow(clock_(), sample);
  return true;
}

std::optional<HeadNow> LiveTrackers::headSoon(Nanoseconds ahead) {
  const std::lock_guard lock(mutex_);
  return feed_.predictedHead(kHeadTracker, clock_(), ahead);
}

void LiveTrackers::aimHead(Nanoseconds ahead) {
  const std::lock_guard lock(mutex_);
  feed_.setPrediction(kHeadTracker, ahead);
}

void LiveTrackers::freezeHead(bool frozen) {
  const std::lock_guard lock(mutex_);
  feed_.freeze(kHeadTracker, clock_(), frozen);
}

void LiveTrackers::restart() {
  const std::lock_guard lock(mutex_);
  feed_.restart();
}

FeedCounts LiveTrackers::counts() const {
  const std::lock_guard lock(mutex_);
  return feed_.counts();
}

std::vector<TrackerFeed::Status> LiveTrackers::status() const {
  const std::lock_guard lock(mutex_);
  return feed_.status(clock_());
}

std::vector<std::string> LiveTrackers::names() const {
  std::vector<std::string> names;
  for (const RigTracker& t : feed_.rig().trackers) names.push_back(t.name);
  return names;
}

}  // namespace stadion
