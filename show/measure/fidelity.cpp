#include "show/measure/fidelity.h"

#include "engine/plain_text/suggestion.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace stadion {
namespace {

constexpr std::uint32_t kFinestSteps = 8;

/// From the finest to the simplest.
constexpr ShapeKind kShapes[] = {ShapeKind::Mesh, ShapeKind::Convex,  ShapeKind::Cylinder,
                                 ShapeKind::Box,  ShapeKind::Capsule, ShapeKind::Ball};

std::size_t detailOf(ShapeKind kind) {
  return static_cast<std::size_t>(std::ranges::find(kShapes, kind) - kShapes);
}

/// The models to play a body with: those that could be the finest, then others from fine to simple.
std::vector<TriedModel> modelsFor(NodeRef ref, const PlayedBody& body, const std::string& truth) {
  std::vector<TriedModel> tried;
  const auto add = [&](std::string name, std::string shape) -> TriedModel& {
    TriedModel& t = tried.emplace_back();
    t.name = std::move(name);
    t.model.body = ref;
    t.model.shape = std::move(shape);
    t.model.dragArea = body.dragArea;
    return t;
  };
  std::vector<std::string> finest{"mesh", "convex"};
  if (!body.exact.empty()) finest.insert(finest.begin(), body.exact);
  if (!truth.empty()) finest = {truth};
  for (const std::string& shape : finest) {
    TriedModel& t = add(fmt::format("shape={}, steps / {}", shape, kFinestSteps), shape);
    t.finest = true;
    t.model.fineness = kFinestSteps;
    t.model.impacts.emplace();
  }
  if (nameOf(body.shape) != finest.front())
    add(fmt::format("as it is, steps / {}", kFinestSteps), "").model.fineness = kFinestSteps;
  add("as it is", "").asIs = true;
  for (const ShapeKind kind : kShapes)
    if (kind != body.shape)
      add(fmt::format("shape={}", nameOf(kind)), nameOf(kind)).simpler =
          detailOf(kind) > detailOf(body.shape);
  using Impacts = ImpactScheme::Kind;
  const bool paper = body.impacts == Impacts::Paper;
  add(paper ? "impact=exact" : "impact=paper", "").model.impacts =
      ImpactScheme{paper ? Impacts::Exact : Impacts::Paper};
  for (const HookedField& f : body.fields) {
    if (f.type != "medium") continue;
    TriedModel& t = add("without " + f.name, "");
    t.simpler = true;
    t.model.without = {f.name};
  }
  return tried;
}

struct Run {
  double milliseconds = 0;  ///< least, of the body's dynamics node
  double spread = 0;        ///< how much more the next least took [ms]; 0 after one round
  std::vector<std::optional<Pose>> places;

  void took(double ms, bool first) {
    if (!first) {
      const double more = std::fabs(ms - milliseconds);
      spread = spread > 0 && ms >= milliseconds ? std::min(spread, more) : more;
    }
    milliseconds = first ? ms : std::min(milliseconds, ms);
  }
};

/// Plays every model in turn, round by round, so that other load on the machine affects all models equally.
/// Of those that could be the finest, keeps the first that can be built.
class ModelTrial {
public:
  ModelTrial(const FidelityOptions& options, NodeRef body, NodeRef dynamics, std::vector<TriedModel>& tried)
      : options_(options), body_(body), dynamics_(dynamics), tried_(tried), runs_(tried.size()) {}

  void play(const std::function<void(const std::string&)>& progress) {
    bool finestFound = false;
    for (std::uint64_t round = 0; round < options_.rounds; ++round) {
      progress(fmt::format("without it (round {} of {})", round + 1, options_.rounds));
      playWithout(round == 0);
      for (std::size_t i = 0; i < tried_.size(); ++i) {
        TriedModel& t = tried_[i];
        if (round > 0 ? !t.played || t.finest : t.finest && finestFound) continue;
        progress(fmt::format("{} (round {} of {})", t.name, round + 1, options_.rounds));
        playOnce(t, runs_[i]);
        finestFound |= t.finest && t.played;
      }
    }
    std::size_t i = 0;
    std::erase_if(runs_, [&](const Run&) { return !tried_[i++].played; });
    std::erase_if(tried_, [](const TriedModel& t) { return !t.played; });
    if (!tried_.empty()) tried_.front().finest = true;
  }

  const std::vector<Run>& runs() const { return runs_; }
  /// The show without the body.
  const Run& without() const { return without_; }

private:
  void playWithout(bool first) {
    BodyModel absent;
    absent.body = body_;
    absent.absent = true;
    Diagnostics findings;
    if (auto played = playWith(options_.show, absent, findings))
      without_.took(played->milliseconds[dynamics_], first);
  }

  void playOnce(TriedModel& t, Run& run) const {
    Diagnostics findings;
    auto played = playWith(options_.show, t.model, findings);
    if (!played) return;
    const auto body = played->bodies.find(t.model.body);
    if (body == played->bodies.end()) return;
    run.took(played->milliseconds[dynamics_], !t.played);
    run.places = std::move(body->second.places);
    t.played = true;
  }

  const FidelityOptions& options_;
  NodeRef body_, dynamics_;
  std::vector<TriedModel>& tried_;
  std::vector<Run> runs_;
  Run without_;
};

void compare(const Run& run, const Run& finest, double rate, double tolerance, TriedModel& t) {
  const std::size_t frames = std::min(run.places.size(), finest.places.size());
  for (std::size_t n = 0; n < frames; ++n) {
    const auto &a = run.places[n], &b = finest.places[n];
    if (!a || !b) continue;
    t.endError = (a->p - b->p).norm();
    t.error = std::max(t.error, t.endError);
    t.turned = std::max(t.turned, a->q.angularDistance(b->q));
    if (t.endError > tolerance && !t.beyondFrom) t.beyondFrom = static_cast<double>(n) / rate;
  }
}

void tryModels(const FidelityOptions& options, NodeRef ref, const PlayedShow& show, BodyFidelity& body,
               const std::function<void(const std::string&)>& progress) {
  body.tried = modelsFor(ref, body.body, options.finest);
  ModelTrial trial(options, ref, body.body.dynamics, body.tried);
  trial.play([&](const std::string& what) { progress(body.body.name + ": " + what); });
  const Run& without = trial.without();
  for (std::size_t i = 0; i < body.tried.size(); ++i) {
    TriedModel& t = body.tried[i];
    const Run& run = trial.runs()[i];
    const double perFrame = 1e3 / static_cast<double>(show.frames);
    t.cost = perFrame * (run.milliseconds - without.milliseconds);
    // A cost cannot be negative, so the measurement is off by at least that much.
    t.noise = std::max(perFrame * std::max(run.spread, without.spread), -t.cost);
    compare(run, trial.runs().front(), show.rate, options.tolerance, t);
  }
}

/// The bodies as the script models them, the most expensive first.
std::vector<std::pair<NodeRef, BodyFidelity>> asPlayed(const PlayedShow& show) {
  std::map<NodeRef, std::uint64_t> arcs;  // of all bodies of a dynamics node
  for (const auto& [ref, body] : show.bodies) arcs[body.dynamics] += body.arcs;
  std::vector<std::pair<NodeRef, BodyFidelity>> all;
  for (const auto& [ref, body] : show.bodies) {
    BodyFidelity b{body};
    const auto took = show.milliseconds.find(body.dynamics);
    if (took != show.milliseconds.end() && arcs[body.dynamics] > 0)
      b.cost = 1e3 * took->second / static_cast<double>(show.frames) * static_cast<double>(body.arcs) /
               static_cast<double>(arcs[body.dynamics]);
    all.emplace_back(ref, std::move(b));
  }
  std::ranges::stable_sort(all, [](const auto& a, const auto& b) { return a.second.cost > b.second.cost; });
  return all;
}

bool namesAreKnown(const std::vector<std::string>& names, const PlayedShow& show, Diagnostics& findings) {
  std::vector<std::string> known;
  for (const auto& [ref, body] : show.bodies) known.push_back(body.name);
  for (const std::string& name : names)
    if (std::ranges::find(known, name) == known.end())
      findings.error(
          {}, fmt::format("no dynamics node moves a body named \"{}\"{}", name, didYouMean(name, known)));
  return !findings.hasErrors();
}

}  // namespace

std::size_t Fidelity::lookedAt() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(bodies, [](const BodyFidelity& b) { return !b.tried.empty(); }));
}

std::optional<Fidelity> measureFidelity(const FidelityOptions& options, Diagnostics& findings,
                                        const std::function<void(const std::string&)>& progress) {
  progress("the show as it is");
  const auto show = playWith(options.show, {}, findings, options.report);
  if (!show || !namesAreKnown(options.bodies, *show, findings)) return {};
  Fidelity fidelity{options.show.script, show->frames, show->rate, options.tolerance, {}};
  std::uint64_t looked = 0;
  for (auto& [ref, body] : asPlayed(*show)) {
    const bool wanted = options.bodies.empty()
                            ? looked < options.most
                            : std::ranges::find(options.bodies, body.body.name) != options.bodies.end();
    if (wanted) {
      ++looked;
      tryModels(options, ref, *show, body, progress);
    }
    fidelity.bodies.push_back(std::move(body));
  }
  return fidelity;
}

std::string cautionAbout(const BodyFidelity& b) {
  const auto in = [&](BodyMode mode) { return b.body.modes[static_cast<std::size_t>(mode)] > 0; };
  const bool lasting =
      in(BodyMode::Contact) || in(BodyMode::Rest) || in(BodyMode::Slide) || in(BodyMode::Roll);
  if (b.tried.empty() || b.tried.front().model.shape != "mesh" || !lasting) return {};
  return "the finest model is a mesh in lasting contact, where a mesh is no exact reference; if the body is "
         "in "
         "truth a simple shape, name it with --finest";
}

std::vector<const TriedModel*> advisable(const BodyFidelity& body) {
  const auto asIs = std::ranges::find_if(body.tried, [](const TriedModel& t) { return t.asIs; });
  const bool good = asIs != body.tried.end() && !asIs->beyondFrom;
  std::vector<const TriedModel*> advised;
  for (const TriedModel& t : body.tried)
    if (!t.beyondFrom && !t.asIs && !t.finest && (t.simpler || !good)) advised.push_back(&t);
  return advised;
}

}  // namespace stadion
