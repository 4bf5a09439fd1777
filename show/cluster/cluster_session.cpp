#include "show/cluster/cluster_session.h"

#include "engine/base/installed_files.h"
#include "engine/base/plain_file.h"
#include "engine/core/state_fields.h"
#include "engine/core/state_hash.h"
#include "engine/plain_text/suggestion.h"
#include "engine/scene/scene_snapshot.h"
#include "pipeline/cluster/interface_check.h"
#include "show/base/stop_signal.h"
#include "show/player/player.h"
#include "show/player/show_files.h"
#include "show/recording/state_file.h"

#include <fmt/format.h>

#include <algorithm>

namespace stadion {
namespace {

/// How long the show waits for missing hosts before it begins.
constexpr std::chrono::seconds kPatience{30};
/// How long answers are awaited after a stop signal.
constexpr std::chrono::seconds kGrace{2};

bool isGivenUp() {
  return sinceStopSignal() > kGrace;
}

std::uint64_t hashOfFile(const std::string& file) {
  constexpr std::size_t kMostBytes = std::size_t{1} << 30;
  const Result<std::string> text = readPlainFile(file, kMostBytes);
  StateHash hash;
  hash.add(std::string_view(text ? text.value() : ""));
  return hash.value();
}

/// Files that scripts name are not in the key: the digests of the scenes cover them.
cluster::CompatibilityKey compatibilityKeyOf(const ShowOptions& show, StereoLayout layout,
                                             const ClusterFile& file) {
  const std::string log = inputLogOf(show.script, show.input);
  cluster::CompatibilityKey key;
  key.script = hashOfFile(show.script);
  key.input = log.empty() ? 0 : hashOfFile(log);
  key.cluster = cluster::hashOf(file);
  key.walls = hashOfFile(wallFileOf(file.walls));
  key.pictures = fmt::format("--look {} --stereo {}{}{}", nameOf(show.look), stereoLayoutName(layout),
                             show.size.empty() ? "" : " --size ", show.size);
  constexpr std::size_t kMostPlugins = 250;  // bytes; with many plugins, a hash stands for them
  key.plugins = show.types->pluginsInWords();
  if (key.plugins.size() > kMostPlugins) {
    StateHash hash;
    hash.add(std::string_view(key.plugins));
    key.plugins = fmt::format("{} in number ({:016x})", show.types->plugins().size(), hash.value());
  }
  return key;
}

}  // namespace

std::unique_ptr<ClusterSession> ClusterSession::create(const ClusterSettings& o, ShowOptions& show,
                                                       StereoLayout layout,
                                                       std::function<void(const std::string&)> say,
                                                       Diagnostics& findings) {
  if (o.file.empty()) return nullptr;
  auto file = loadCluster(o.file, findings);
  if (!file) return nullptr;
  const auto node = file->find(o.node);
  if (!node) {
    findings.error({},
                   fmt::format("--node: {} has no node \"{}\"{}", o.file, o.node,
                               didYouMean(o.node, file->names(),
                                          "; it has " + fmt::format("{}", fmt::join(file->names(), ", ")))));
    return nullptr;
  }
  const auto walls = loadWallsOf(*file, shareFolder() + "/walls", findings);
  Diagnostics ofWalls;
  if (walls) checkWalls(*file, walls->names(), ofWalls);
  if (!o.isChecked || ofWalls.hasErrors()) findings.append(ofWalls);
  checkInterface(*file, findings);
  if (!walls || findings.hasErrors()) return nullptr;
  show.walls = file->walls;
  show.onlyWalls = file->nodes[*node].walls;
  if (show.onlyWalls.empty()) show.onlyWalls = {walls->walls.front().wall.name};
  std::unique_ptr<ClusterSession> part(
      new ClusterSession(show, layout, std::move(*file), *node, std::move(say)));
  if (o.plantDifference > 0) part->planted_ = o.plantDifference;
  return part;
}

void ClusterSession::report(const std::string& what) {
  log_.write(fmt::format("cluster, {}: {}", file_.nodes[node_].name, what));
}

// Computes the compatibility key each time: a script may have been saved since the show before.
bool ClusterSession::openLead(Diagnostics& findings) {
  cluster::LeaderOptions options{file_, compatibilityKeyOf(show_, layout_, file_), kPatience,
                                 [this](const std::string& what) { report(what); }, isGivenUp};
  if (lead_) {
    options.above = lead_->session();
    options.expected = lead_->played();
  }
  lead_.reset();
  auto opened = cluster::ClusterLeader::open(std::move(options));
  if (!opened) {
    findings.add(opened.error());
    return false;
  }
  lead_ = std::move(opened.value());
  return true;
}

bool ClusterSession::join(ShowOptions& show, Diagnostics& findings) {
  if (!leads()) return follow(show, findings);
  if (!openLead(findings)) return false;
  const auto underWay = lead_->takeOver();
  if (!underWay) return true;
  show.state = underWay->state;
  after_ = underWay->last;
  goesOn_ = true;
  files_ = underWay->files;
  operator_.emplace();
  operator_->paused = underWay->still == Standstill::Paused;
  operator_->waiting = underWay->still == Standstill::Waiting;
  operator_->presentation = underWay->presentation;
  return true;
}

bool ClusterSession::follow(ShowOptions& show, Diagnostics& findings) {
  over_ = follower_ && follower_->isOver();
  if (over_) return false;
  const std::uint64_t played = follower_ ? follower_->session() : 0;
  follower_.reset();
  auto opened = cluster::Follower::open({file_, node_, compatibilityKeyOf(show_, layout_, file_),
                                         [this](const std::string& what) { report(what); }, isGivenUp,
                                         [] { return stopSignal() != 0; }, std::move(kept_), played});
  if (!opened) {
    findings.add(opened.error());
    return false;
  }
  follower_ = std::move(opened.value());
  const auto joining = follower_->join();
  over_ = !joining && follower_->isOver();
  otherFiles_ = follower_->isRefused();
  if (!joining) return false;  // it has told why, if there is a reason
  show.rate = joining->rate;
  show.rateGiven = true;
  show.state = joining->state;
  last_ = joining->after;
  if (!joining->playsLog) show.input = "none";  // the leader sends what the input says
  goesOn_ = show.state != nullptr;
  files_ = joining->files;
  after_ = goesOn_ ? std::optional(joining->after) : std::nullopt;
  return true;
}

/// Which files differ is not known here.
void ClusterSession::refuseFiles(Diagnostics& findings) {
  otherFiles_ = true;
  findings.error(
      {},
      fmt::format(
          "the scripts or models that {} has loaded are others than ours; put the same files on all machines",
          file_.nodes[file_.lead].name));
}

bool ClusterSession::restartShow(const Diagnostics& found, Diagnostics& findings) {
  const auto why = std::ranges::find(found.all(), Severity::Error, &Diagnostic::severity);
  report("the scripts or models of the others' show differ from ours: the show restarts" +
         (why == found.all().end() ? "" : " (" + why->message + ")"));
  after_.reset();
  operator_.reset();
  goesOn_ = false;
  return openLead(findings);
}

bool ClusterSession::begin(Player& player, const OperatorQueue& asked, const std::function<bool()>& takeKeys,
                           Diagnostics& findings) {
  player_ = &player;
  if (!leads()) {
    follower_->compareWith([this](const cluster::SavedScene& there) { return differenceTo(there); });
    return true;
  }
  if (lead_->hasBegun()) {  // the next group's show
    if (!openLead(findings)) return false;
    after_.reset();
    goesOn_ = false;
  }
  lead_->saveWith([this] { return saved(); });
  // Start counts once the operator knows which hosts the show waits for: before, it is meant for all.
  std::size_t before = 0;
  const bool begun = lead_->begin(player.rate(), [&](bool told) {
    if (!takeKeys()) return cluster::WaitDecision::GivesUp;
    const std::size_t starts = asked.count(OperatorAction::Start);
    if (!told) before = starts;
    const bool hurries = starts > before || asked.count(OperatorAction::End) > 0;
    return hurries ? cluster::WaitDecision::Ends : cluster::WaitDecision::Lasts;
  });
  return begun && !lead_->hasDouble();
}

cluster::SavedScene ClusterSession::saved() const {
  return {SceneSnapshot::filesOf(player_->scene()), SceneSnapshot(player_->scene()).save()};
}

std::optional<cluster::Follower::Differs>
ClusterSession::differenceTo(const cluster::SavedScene& there) const {
  auto d = savedStateDifference(player_->scene(), there.files, there.bytes);
  if (!d) return {};
  return cluster::Follower::Differs{std::move(d->where), std::move(d->here), std::move(d->there)};
}

void ClusterSession::addTo(FrameLoopOptions& loop, OperatorConsole& console) {
  loop.orders = lead_ ? static_cast<FrameOrders*>(lead_.get()) : follower_.get();
  loop.after = after_;
  if (const auto decided = std::exchange(operator_, {})) console.resume(*decided);
}

InputDevice* ClusterSession::inputOf(Player& player) {
  return lead_ ? &lead_->input(player.input()) : &follower_->input();
}

void ClusterSession::simulated(const TimeSignature& now) {
  const std::uint64_t frame = now.frame;
  last_ = now;
  if (lead_ && lead_->compares(frame)) lead_->simulated(frame, SceneSnapshot(player_->scene()).digest());
  if (follower_ && follower_->compares(frame))
    follower_->simulated(frame, SceneSnapshot(player_->scene()).digest());
  if (planted_ == frame) plantDifference();
}

/// The last bit of a body's path, if there is one.
void ClusterSession::plantDifference() {
  class OneBit final : public StateFields {
    void number(std::uint64_t& bits, Form form) override {
      if (done_ || form != Form::Real || name_ != "c" || bits == 0) return;
      bits ^= 1;
      done_ = true;
    }
    void text(std::string&) override {}
    bool done_ = false;
  } bit;
  player_->scene().tree().forEachNode([&](const Node& node) { const_cast<Node&>(node).state(bit); });
}

bool ClusterSession::hasDouble() const {
  return (lead_ && lead_->hasDouble()) || (follower_ && follower_->hasDouble());
}

void ClusterSession::finish(bool over) {
  if (lead_) lead_->finish(over);
  if (!follower_) return;
  if (follower_->keepsScene()) follower_->keep(last_, saved());
  kept_ = follower_->kept();
  follower_->finish();
}

ClusterSummary ClusterSession::summary() const {
  const cluster::ClusterStats t = lead_ ? lead_->stats() : follower_->stats();
  ClusterSummary s;
  s.node = file_.nodes[node_].name;
  s.nodes = file_.nodes.size();
  s.leads = leads();
  s.orders = t.orders;
  s.orderBytes = t.orders > 0 ? static_cast<double>(t.orderBytes) / static_cast<double>(t.orders) : 0;
  s.mostOrderBytes = t.mostOrderBytes;
  s.barrier = sampleStatisticsOf(t.barrier.values());
  s.stopped = t.stopped > 0;
  s.joined = t.joined;
  s.leftOut = t.leftOut;
  s.compared = t.compared;
  s.differed = t.differed;
  return s;
}

}  // namespace stadion
