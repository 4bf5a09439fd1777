#include "show/cluster/cluster_nodes.h"

#include "show/base/process_status.h"
#include "show/base/stop_signal.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <csignal>
#include <sys/stat.h>
#include <thread>
#include <utility>

namespace stadion {
namespace {

constexpr std::chrono::milliseconds kLookEvery{20};
/// A process that played for so long did not crash at its start.
constexpr std::chrono::seconds kSteady{1};
constexpr std::size_t kMostDeaths = 10;  ///< in a row
/// Files that differ from those of the leader will not be equal at once.
constexpr std::chrono::seconds kTryAgain{5};
/// A process that ends for its files after so long had the right ones before.
constexpr std::chrono::seconds kPlayedLong{60};

bool wasAskedToEnd(int status) {
  return status == kStopped + SIGINT || status == kStopped + SIGTERM;
}

bool hasFailed(int status) {
  return status != kPlayed && !wasAskedToEnd(status);
}

std::string howItEnded(int status) {
  return status > kStopped ? fmt::format("was ended by signal {}", status - kStopped)
                           : fmt::format("ended with exit code {}", status);
}

std::string wholeContentOf(const FileDescriptor& file) {
  struct stat about {};
  if (!file || fstat(file.get(), &about) != 0) return {};
  return contentOf(file, static_cast<std::size_t>(about.st_size));
}

}  // namespace

void ClusterNodes::add(std::string name, std::vector<std::string> words, std::unique_ptr<Journal> journal) {
  Node& node = nodes_.emplace_back();
  node.name = std::move(name);
  node.words = std::move(words);
  node.journal = std::move(journal);
}

void ClusterNodes::watchLead(std::unique_ptr<SharedProgress> progress, Nanoseconds after) {
  progress_ = std::move(progress);
  hangsAfter_ = after;
}

void ClusterNodes::sayOf(const Node& node, const std::string& what) {
  say(node.name + " " + what);
  const auto why = node.journal ? node.journal->add("cluster: " + node.name + " " + what) : std::nullopt;
  if (why) say("--journal: " + *why + "; lines are lost");
}

bool ClusterNodes::begin(Node& node) {
  node.said = makeMemoryFile();
  node.begun = Clock::now();
  ++node.starts;
  if (progress_ && &node == &nodes_[lead_]) {
    progress_->enter(SharedProgress::Phase::Opening);
    watch_.emplace(*progress_, hangsAfter_);
  }
  const bool well = !node.child.start(node.words, {-1, node.said.get(), 2});
  node.state = well ? State::Plays : State::Ended;
  if (well) return true;
  node.status = kFailed;
  sayOf(node, "cannot be started");
  return false;
}

int ClusterNodes::play() {
  const std::atomic<bool>& stop = catchStopSignals();
  outliveReaders();
  stop_ = &stop;
  for (Node& node : nodes_)
    if (!begin(node)) return kFailed;
  for (bool forwarded = false; anyLeft(); std::this_thread::sleep_for(kLookEvery)) {
    if (stop && !std::exchange(forwarded, true)) ask(stopSignal());
    for (Node& node : nodes_) poll(node);
    killHangingLead();
    endLeadOfEndedShow();
    endWithLead();
    killHangingNodes();
  }
  return code();
}

void ClusterNodes::poll(Node& node) {
  if (node.state == State::Plays) {
    if (const auto status = node.child.wait(std::chrono::milliseconds(0))) ended(node, *status);
  } else if (node.state == State::Pauses) {
    if (*stop_) node.status = kStopped + stopSignal();  // it will not fail any more
    const auto now = Clock::now();
    if (*stop_ || leadIsGone())
      node.state = State::Ended;
    else if (now >= node.notBefore && node.restarts.due(now))
      begin(node);
  }
}

void ClusterNodes::ended(Node& node, int status) {
  const bool over = once_ || *stop_ || leadIsGone();
  node.state = State::Ended;
  node.status = status;
  if (isIncomplete(node)) {
    sayOf(node, "was not done when the show was over: what it has written may not be whole");
    node.status = node.died != 0 ? node.died : kRefused;
    return;
  }
  if (!hasFailed(status)) return;
  const std::string how = howItEnded(status);
  if (over || !isDeath(node)) return sayOf(node, how);
  const auto now = Clock::now();
  if (node.died == 0) node.died = status;
  if (status == kOtherFiles) {
    node.state = State::Pauses;
    node.notBefore = now + kTryAgain;
    const bool played = now - node.begun >= kPlayedLong;
    if (std::exchange(node.waitsForFiles, true) && !played) return;
    return sayOf(node, fmt::format("has other files than {}, and comes again until they are alike",
                                   nodes_[lead_].name));
  }
  node.waitsForFiles = false;
  if (now - node.begun >= kSteady) node.restarts = {};
  node.restarts.died(now);
  const std::size_t deaths = node.restarts.deaths();
  if (deaths >= kMostDeaths)
    return sayOf(node, fmt::format("{}, {} times in a row, and is given up", how, deaths));
  node.state = State::Pauses;
  sayOf(node, how + (deaths == 1 ? " and restarts"
                                 : fmt::format(", {} times in a row, and restarts after a pause", deaths)));
}

/// The show has come to its end, and this node, which went on or still waited, had to be asked to end.
bool ClusterNodes::isIncomplete(const Node& node) const {
  return needsAll_ && nodes_[lead_].status == kPlayed && othersAsked_ && !*stop_ && node.asked &&
         wasAskedToEnd(node.status);
}

/// A scene differed, and the cluster file says that the show is to end then.
bool ClusterNodes::isStop(const Node& node) const {
  return stopOnDifference_ && &node == &nodes_[lead_] && node.status == kFailed;
}

/// An error in the show or its options would come again. But the scripts may be changing: with the next group
/// they may be equal.
bool ClusterNodes::isDeath(const Node& node) const {
  return node.status > kStopped || node.status == kOtherFiles || (node.status == kFailed && !isStop(node));
}

/// The leader tells the followers that the show is over. A follower that still runs after `patience` has
/// missed it, and would wait for ever.
void ClusterNodes::endWithLead() {
  if (othersAsked_ || !leadIsGone()) return;
  if (!goneSince_) goneSince_ = Clock::now();
  const Node& lead = nodes_[lead_];
  const bool hasTold = !hasFailed(lead.status) || isStop(lead);
  if (hasTold && Clock::now() - *goneSince_ < patience_) return;
  othersAsked_ = true;
  if (anyLeft()) say(lead.name + ", which leads, is gone; the others end");
  ask(SIGINT);
}

void ClusterNodes::ask(int signal) {
  if (!askedSince_) askedSince_ = Clock::now();
  for (Node& node : nodes_)
    if (node.child.running()) {
      kill(node.child.pid(), signal);
      node.asked = true;
    }
}

/// A process that hangs in the system may outlive even that. It is not waited for.
void ClusterNodes::killHangingNodes() {
  if (!askedSince_ || Clock::now() - *askedSince_ < patience_) return;
  for (Node& node : nodes_) {
    if (!node.child.running()) continue;
    sayOf(node, fmt::format("has not ended {:g} s after it was asked to, and is killed",
                            std::chrono::duration<double>(patience_).count()));
    node.child.kill();
    node.child.wait(std::chrono::seconds(1));
    node.state = State::Ended;
    node.status = kStopped + SIGKILL;
  }
}

void ClusterNodes::killHangingLead() {
  Node& lead = nodes_[lead_];
  const auto silent = watch_ && lead.child.running() ? watch_->hangs() : std::nullopt;
  if (!silent) return;
  sayOf(lead, fmt::format("has shown nothing for {:g} s, and is killed", toSeconds(*silent)));
  lead.child.kill();
  watch_.reset();
}

/// The leader has crashed, but the show was over for the followers. Restarted, it would play the show once
/// more, alone.
void ClusterNodes::endLeadOfEndedShow() {
  Node& lead = nodes_[lead_];
  const auto isOther = [&](const Node& node) { return &node != &lead; };
  const auto isDone = [](const Node& node) { return node.state == State::Ended && node.status == kPlayed; };
  const bool opens = lead.state == State::Plays && lead.died != 0 && progress_ &&
                     progress_->phase() == SharedProgress::Phase::Opening;
  if (lead.state != State::Pauses && !opens) return;
  if (std::ranges::none_of(nodes_, isDone)) return;
  if (std::ranges::any_of(nodes_, [&](const Node& n) { return isOther(n) && n.state != State::Ended; }))
    return;
  if (lead.child.running()) {
    lead.child.kill();
    lead.child.wait(std::chrono::seconds(1));
  }
  lead.state = State::Ended;
  lead.status = lead.died;
  sayOf(lead, "does not play again: the show is over");
}

bool ClusterNodes::anyLeft() const {
  return std::ranges::any_of(nodes_, [](const Node& node) { return node.state != State::Ended; });
}

/// Returns the exit code: a failure comes before a stop that was asked for.
int ClusterNodes::code() const {
  const auto failed = std::ranges::find_if(nodes_, hasFailed, &Node::status);
  if (failed != nodes_.end()) return failed->status;
  if (*stop_) return kStopped + stopSignal();
  for (const Node& node : nodes_)
    if (wasAskedToEnd(node.status) && !node.asked) return node.status;
  return kPlayed;
}

std::string ClusterNodes::said() const {
  std::string all;
  for (const Node& node : nodes_)
    all += fmt::format("-- {}{}\n{}", node.name,
                       node.starts > 1 ? fmt::format(", begun {} times", node.starts) : "",
                       wholeContentOf(node.said));
  return all;
}

std::string ClusterNodes::saidAsJson() const {
  std::string all;
  for (const Node& node : nodes_) {
    std::string summary = wholeContentOf(node.said);
    if (!nlohmann::json::accept(summary)) summary = "null";  // it has died before it could say anything
    while (summary.ends_with('\n')) summary.pop_back();
    all += fmt::format("{}\"{}\": {}", all.empty() ? "{" : ",\n", node.name, summary);
  }
  return all + "}\n";
}

}  // namespace stadion
