#include "bench/walls/walls_judge.h"

#include <algorithm>
#include <fmt/format.h>

namespace stadion::bench {
namespace {

using Kind = WallsFinding::Kind;
constexpr double kOtherPixels = 0.001;  ///< share that may be off by more than 2 of 255
constexpr double kCalm = 1.1;           ///< p99 of a loop that only waits, relative to its median

WallsFinding found(std::string what, std::optional<double> value, double limit, bool atLeast,
                   const std::string& why) {
  WallsFinding f;
  f.what = std::move(what);
  f.limit = limit;
  f.atLeast = atLeast;
  if (!value) {
    f.why = why;
    return f;
  }
  f.value = *value;
  f.kind = (atLeast ? *value >= limit : *value <= limit) ? Kind::Met : Kind::Missed;
  return f;
}

std::optional<double> ratio(std::optional<double> a, std::optional<double> b) {
  if (!a || !b || *b <= 0) return std::nullopt;
  return *a / *b;
}

/// Compares a figure of one case with that of another.
struct Comparison {
  const WallsResults& results;
  std::vector<WallsFinding>& findings;

  void add(const std::string& what, const WallsCase& ours, const std::string& other, const std::string& field,
           double limit, bool atLeast, const std::string& otherField = {}) const {
    const auto a = results.median(nameOf(ours), field),
               b = results.median(other, otherField.empty() ? field : otherField);
    findings.push_back(found(what, ratio(a, b), limit, atLeast,
                             !a ? "Stadion's was not measured" : "there is nothing to compare with"));
  }
};

std::string osgMode(const std::string& name) {
  return name.find("CTPC") != std::string::npos ? "CTPC" : "DPC";
}

void judgeSpeed(const Comparison& compare, const std::string& scene, bool flat, const std::string& kind,
                double limit) {
  // OPEN draws the same picture as STRICT: OpenSceneGraph has one row for both.
  const std::string best = bestOsg(compare.results, scene, flat, kind == "SUBMIT" ? "SUBMIT" : "STRICT");
  const std::string title = scene + (scene == "c" ? (flat ? " flat " : " grid ") : " ") + kind;
  compare.add(title + ": frames a second, of OpenSceneGraph's " + osgMode(best), ourCase(scene, flat, kind),
              best, "fps", limit, true);
  if (scene == "c" || kind != "STRICT") return;
  compare.add(title + ": latency, of OpenSceneGraph's single-threaded", ourCase(scene, flat, kind),
              nameOf(osgCase(scene, flat, kind, "ST")), "latency_ms_median", 1, false);
  compare.add(title + ": processor time, of OpenSceneGraph's " + osgMode(best), ourCase(scene, flat, kind),
              best, "cpu_ms_per_frame", 0.8, false);
}

void judgeStages(const Comparison& compare, const std::string& scene) {
  const auto single = [&](bool flat) { return nameOf(osgCase(scene, flat, "STRICT", "ST")); };
  const auto ours = [&](bool flat) { return ourCase(scene, flat, "STRICT", "sequential"); };
  if (scene == "b")
    compare.add("b: App with 2000 moving nodes, of OpenSceneGraph's", ours(false), single(false), "app_ms",
                1.0 / 8, false);
  if (scene != "c") return;
  compare.add("c flat: Cull of all views, of OpenSceneGraph's", ours(true), single(true), "cull_ms_sum",
              1.0 / 50, false);
  compare.add("c grid: Cull of all views, of OpenSceneGraph's", ours(false), single(false), "cull_ms_sum",
              1.0 / 15, false);
}

void judgeFloor(const Comparison& compare) {
  compare.add("a STRICT: processor time of one view, of bare OpenGL's",
              oneWall(ourCase("a", false, "STRICT")), nameOf(oneWall(floorCase("a", "STRICT"))),
              "cpu_ms_per_frame", 1.05, false);
}

void judgePace(const WallsResults& results, std::vector<WallsFinding>& findings) {
  const auto calm = results.medianRatio(nameOf(controlCase()), "frame_ms_p99", "frame_ms_median");
  auto ours = results.medianRatio(nameOf(lockedCase()), "frame_ms_p99", "frame_ms_median");
  std::string why = "it was not measured";
  if (!calm || *calm > kCalm) {
    why =
        calm ? fmt::format("the machine is not calm: waiting alone has a p99 of {:.2f} medians", *calm) : why;
    ours.reset();
  }
  findings.push_back(found("c flat STRICT on ticks: p99 of a frame, of its median", ours, 1.5, false, why));
}

/// Judges each view by itself if a thousandth of its pixels is at least one; otherwise all views of the frame
/// together.
void judgePictures(const WallsResults& results, const std::string& scene,
                   std::vector<WallsFinding>& findings) {
  constexpr double kRounding = 1e-9;
  for (const char* kind : {"STRICT", "OPEN", "SUBMIT"}) {
    const WallsCase c = ourCase(scene, true, kind);
    const bool each = kOtherPixels * c.width * c.height >= 1;
    const auto beyond =
        results.median("pictures " + scene + " " + kind, each ? "beyond_share" : "beyond_share_frame");
    findings.push_back(found(scene + " " + kind + ": pixels within 2/255 of OpenSceneGraph's, " +
                                 (each ? "worst view" : "all views together"),
                             beyond ? std::optional(1 - *beyond) : std::nullopt, 1 - kOtherPixels - kRounding,
                             true, "the pictures were not compared"));
  }
}

}  // namespace

std::string bestOsg(const WallsResults& results, const std::string& scene, bool flat,
                    const std::string& kind) {
  std::string best;
  double most = 0;
  for (const char* mode : {"DPC", "CTPC"}) {
    const std::string name = nameOf(osgCase(scene, flat, kind, mode));
    const double fps = results.median(name, "fps").value_or(0);
    if (fps > most) {
      most = fps;
      best = name;
    }
  }
  return best;
}

std::vector<WallsFinding> judgeTable(const WallsResults& results, const std::vector<std::string>& scenes) {
  std::vector<WallsFinding> findings;
  const Comparison compare{results, findings};
  for (const std::string& scene : scenes) {
    judgePictures(results, scene, findings);
    if (scene == "c") {
      judgeSpeed(compare, scene, true, "STRICT", 2.2);
      judgeSpeed(compare, scene, false, "STRICT", 1.6);
      judgeSpeed(compare, scene, true, "SUBMIT", 3.5);
      judgeSpeed(compare, scene, false, "SUBMIT", 3.5);
    } else {
      judgeSpeed(compare, scene, false, "STRICT", 1.4);
      judgeSpeed(compare, scene, false, "OPEN", 2.2);
      judgeSpeed(compare, scene, false, "SUBMIT", 2);
    }
    judgeStages(compare, scene);
    if (scene == "a") judgeFloor(compare);
    if (scene == "c") judgePace(results, findings);
  }
  return findings;
}

std::vector<WallsFinding> judgeScaling(const WallsResults& results) {
  const std::size_t most = scalingNodes().back();
  const std::string million = nameOf(scalingCase(most, "stadion"));
  const std::string before = nameOf(scalingCase(most / 10, "stadion"));
  const std::string why = "it was not measured";
  std::vector<WallsFinding> findings;
  findings.push_back(found("1 000 000 nodes, 100 moving: App and publishing [ms]",
                           results.median(million, "app_ms"), 0.1, false, why));
  findings.push_back(found("1 000 000 nodes, 1 % seen: Cull for all walls [ms]",
                           results.median(million, "cull_ms_sum"), 2, false, why));
  std::optional<double> bytes;
  const auto much = results.median(million, "held_mb"), less = results.median(before, "held_mb");
  if (much && less) bytes = (*much - *less) * 1e6 / static_cast<double>(most - most / 10);
  findings.push_back(found("memory that each further static node holds [bytes]", bytes, 200, false, why));
  return findings;
}

std::string textOf(const std::vector<WallsFinding>& findings) {
  std::string text;
  for (const WallsFinding& f : findings) {
    if (f.kind == Kind::Void) {
      text += fmt::format("  void    {}: {}\n", f.what, f.why);
      continue;
    }
    text += fmt::format("  {}  {}: {:.4g}, {} {:.4g}\n", f.kind == Kind::Met ? "ok    " : "MISSED", f.what,
                        f.value, f.atLeast ? "at least" : "at most", f.limit);
  }
  return text;
}

bool noneMissed(const std::vector<WallsFinding>& findings) {
  return std::ranges::none_of(findings, [](const WallsFinding& f) { return f.kind == Kind::Missed; });
}

}  // namespace stadion::bench
