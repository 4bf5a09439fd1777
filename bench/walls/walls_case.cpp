#include "bench/walls/walls_case.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace stadion::bench {
namespace {

/// Long enough to be measured, short enough for five rounds of all.
std::uint64_t framesOf(const std::string& scene, const std::string& kind) {
  const bool tiny = scene == "c", small = kind == "SUBMIT";
  return small ? (tiny ? 40 : 20) : (tiny ? 30 : 12);
}

WallsCase caseOf(const std::string& engine, const std::string& scene, bool flat, const std::string& kind,
                 const std::string& mode) {
  WallsCase c;
  c.engine = engine;
  c.scene = scene;
  c.flat = flat;
  c.kind = kind;
  c.mode = mode;
  if (kind == "SUBMIT") c = small(std::move(c));
  c.frames = framesOf(scene, kind);
  return c;
}

}  // namespace

WallsCase ourCase(const std::string& scene, bool flat, const std::string& kind, const std::string& mode) {
  return caseOf("stadion", scene, flat, kind, mode);
}

WallsCase osgCase(const std::string& scene, bool flat, const std::string& kind, const std::string& mode) {
  WallsCase c = caseOf("osg", scene, flat, kind, mode);
  c.lp = "2";
  return c;
}

WallsCase floorCase(const std::string& scene, const std::string& kind, const std::string& way) {
  WallsCase c = caseOf("floor", scene, true, kind, way);
  c.lp = "0";
  return c;
}

WallsCase small(WallsCase of) {
  of.width = 32;
  of.height = 24;
  return of;
}

WallsCase oneWall(WallsCase of) {
  of.walls = 1;
  of.lp = "0";
  if (of.engine == "stadion") of.mode = "sequential";
  return of;
}

WallsCase lockedCase() {
  WallsCase c = ourCase("c", true, "STRICT");
  c.pace = "lock";
  c.frames = 150;
  return c;
}

WallsCase controlCase() {
  WallsCase c;
  c.engine = "control";
  c.kind = "";
  c.scene = "";
  c.mode = "waiting";
  c.pace = "lock";
  c.walls = 0;
  c.frames = 150;
  return c;
}

std::string nameOf(const WallsCase& c) {
  std::string name = c.engine;
  if (!c.scene.empty()) name += " " + c.scene;
  if (c.scene == "c" && c.engine != "floor" && !c.nodes) name += c.flat ? " flat" : " grid";
  if (!c.kind.empty()) name += " " + c.kind;
  if (!c.mode.empty()) name += " " + c.mode;
  if (c.kind != "SUBMIT" && c.width != 800) name += fmt::format(" {}x{}", c.width, c.height);
  if (c.pace != "free" && c.engine == "stadion") name += " " + c.pace;
  if (c.walls != 4 && c.walls) name += fmt::format(", {} wall{}", c.walls, c.walls == 1 ? "" : "s");
  if (c.nodes) name += fmt::format(", {} nodes", c.nodes);
  if (c.engine == "stadion" && !c.lp.empty()) name += ", LP " + c.lp;
  return name;
}

std::vector<WallsCase> tableCases(const WallsChoice& choice) {
  std::vector<WallsCase> all;
  const auto add = [&](WallsCase c) {
    if (c.engine == "osg" && !choice.osg) return;
    if (c.engine == "floor" && !choice.floor) return;
    // One thread does all work if stages or the floor are compared.
    if (c.engine == "stadion") c.drawnBy = c.mode == "sequential" ? "thread" : choice.drawnBy;
    all.push_back(std::move(c));
  };
  for (const std::string& s : choice.scenes) {
    const bool tiny = s == "c";
    for (const bool flat : tiny ? std::vector<bool>{true, false} : std::vector<bool>{false}) {
      add(ourCase(s, flat, "STRICT"));
      add(osgCase(s, flat, "STRICT", "DPC"));
      add(osgCase(s, flat, "STRICT", "CTPC"));
      if (!tiny) add(ourCase(s, flat, "OPEN"));
      add(osgCase(s, flat, "STRICT", "ST"));
      if (s != "a") add(ourCase(s, flat, "STRICT", "sequential"));
      add(osgCase(s, flat, "SUBMIT", "DPC"));
      add(ourCase(s, flat, "SUBMIT"));
      add(osgCase(s, flat, "SUBMIT", "CTPC"));
      add(small(ourCase(s, flat, "STRICT")));
      if (tiny && flat) continue;  // the floor does not depend on it
      add(floorCase(s, "STRICT"));
      add(floorCase(s, "SUBMIT"));
      add(oneWall(ourCase(s, flat, "STRICT")));
      add(oneWall(floorCase(s, "STRICT")));
    }
    if (s == "a")
      for (const char* way : {"clear", "discard", "instanced", "merged"})
        add(oneWall(floorCase(s, "STRICT", way)));
    if (tiny) {
      add(controlCase());
      add(lockedCase());
    }
  }
  return all;
}

std::vector<std::size_t> scalingNodes() {
  return {1'000, 3'000, 10'000, 30'000, 100'000, 300'000, 1'000'000};
}

WallsCase scalingCase(std::size_t nodes, const std::string& engine) {
  WallsCase c = engine == "floor" ? floorCase("c", "STRICT") : ourCase("c", true, "STRICT", "sequential");
  c.nodes = nodes;
  c.moving = std::min<std::size_t>(100, nodes / 10);
  c.far = 12;  // about one in a hundred is visible
  c.frames = 20;
  return c;
}

std::vector<WallsCase> scalingCases(const WallsChoice& choice) {
  std::vector<WallsCase> all;
  const auto add = [&](WallsCase c) {
    if (c.engine == "osg" ? choice.osg : c.engine == "floor" ? choice.floor : true)
      all.push_back(std::move(c));
  };
  for (const std::size_t nodes : scalingNodes()) {
    add(scalingCase(nodes, "stadion"));
    add(scalingCase(nodes, "floor"));
  }
  for (std::size_t walls = 1; walls <= 6; ++walls)
    for (WallsCase c :
         {ourCase("a", false, "STRICT"), osgCase("a", false, "STRICT", "DPC"), floorCase("a", "STRICT")}) {
      c.walls = walls;
      if (c.engine == "stadion") c.drawnBy = choice.drawnBy;
      add(std::move(c));
    }
  return all;
}

}  // namespace stadion::bench
