#include "bench/walls/walls_program.h"

#include "bench/comparison/program_output.h"
#include "bench/walls/picture_difference.h"

#include <filesystem>
#include <fmt/format.h>
#include <sstream>

namespace stadion::bench {
namespace {

constexpr std::chrono::seconds kLimit{180};  ///< for one run; a million nodes take a while to load

Diagnostic problem(const std::string& what) {
  Diagnostic d;
  d.message = what;
  return d;
}

std::vector<std::string> ourWords(const WallsCase& c) {
  std::vector<std::string> words{"bench", "walls", "--one"};
  if (c.engine == "control") {
    words.insert(words.end(), {"--control"});
    return words;
  }
  words.insert(words.end(), {"--scene", c.scene, "--class", c.kind, "--mode", c.mode, "--layout",
                             c.flat ? "flat" : "grid", "--pace", c.pace, "--gl", "osmesa"});
  if (!c.drawnBy.empty()) words.insert(words.end(), {"--wall-workers", c.drawnBy});
  return words;
}

std::vector<std::string> osgWords(const WallsCase& c) {
  return {"--scene",          c.scene,  "--threading", c.mode,       "--flat",
          c.flat ? "1" : "0", "--geom", "vao",         "--affinity", "0"};
}

std::vector<std::string> floorWords(const WallsCase& c) {
  return {"--scene", c.scene, "--class", c.kind, "--way", c.mode};
}

/// The last line that is an object; null if there is none.
nlohmann::json objectIn(const std::string& text) {
  nlohmann::json found;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    nlohmann::json json = nlohmann::json::parse(line, nullptr, false);
    if (json.is_object()) found = std::move(json);
  }
  return found;
}

std::string environmentOf(const WallsCase& c) {
  return c.lp.empty() ? "LP_NUM_THREADS" : "LP_NUM_THREADS=" + c.lp;
}

}  // namespace

WallsPrograms wallsPrograms(const std::string& stadion) {
  const std::string folder = std::filesystem::path(stadion).parent_path();
  const auto built = [&](const char* name) {
    const std::string path = folder + "/" + name;
    return std::filesystem::exists(path) ? path : std::string();
  };
  return {stadion, built("stadion-walls-osg"), built("stadion-walls-floor")};
}

std::vector<std::string> wordsFor(const WallsCase& c, const WallsPrograms& programs) {
  const bool osg = c.engine == "osg", floor = c.engine == "floor";
  std::vector<std::string> words{osg ? programs.osg : floor ? programs.floor : programs.stadion};
  const std::vector<std::string> own = osg ? osgWords(c) : floor ? floorWords(c) : ourWords(c);
  words.insert(words.end(), own.begin(), own.end());
  const auto add = [&](const char* name, auto value) {
    words.push_back(name);
    words.push_back(fmt::format("{}", value));
  };
  add("--frames", c.frames);
  if (c.engine == "control") return words;
  const bool ours = !osg && !floor;
  add(ours ? "--wall-count" : "--walls", c.walls);
  add("--width", c.width);
  add("--height", c.height);
  add("--warm", c.warm);
  if (c.nodes) add(ours ? "--scene-nodes" : "--nodes", c.nodes);
  if (c.moving) add("--moving", c.moving);
  if (c.far > 0) add("--far", c.far);
  return words;
}

nlohmann::json completed(const WallsCase& c, nlohmann::json row) {
  row["case"] = nameOf(c);
  if (c.engine == "osg") {
    row["engine_version"] = row.value("engine", "");
    row["mode"] = c.mode;
    row["wall_workers"] = "thread";
    const double fps = row.value("fps", 0.0);
    if (fps > 0) row["cpu_ms_per_frame"] = 1e3 * row.value("cpu_cores", 0.0) / fps;
    // For up to 100 frames, p99 is the longest frame.
    if (c.frames <= 100 && row.contains("frame_ms_max")) row["frame_ms_p99"] = row["frame_ms_max"];
  }
  row["engine"] = c.engine;
  if (c.engine == "control") return row;
  row["class"] = c.kind;
  row["scene"] = c.scene;
  row["walls"] = c.walls;
  row["width"] = c.width;
  row["height"] = c.height;
  row["flat"] = c.flat ? 1 : 0;
  if (c.nodes) {
    row["nodes"] = c.nodes;
    row["moving"] = c.moving;
    row["far"] = c.far;
  }
  return row;
}

Result<nlohmann::json> measure(const WallsCase& c, const WallsPrograms& programs) {
  nlohmann::json row = objectIn(outputOf({wordsFor(c, programs), {environmentOf(c)}, kLimit}));
  if (row.is_null()) return problem(nameOf(c) + ": no row came of it");
  return completed(c, std::move(row));
}

WallsCase ourPictures(const PicturesCase& c) {
  WallsCase ours = ourCase(c.scene, true, c.kind);
  ours.walls = 6;
  ours.warm = 2;
  ours.frames = 3;
  ours.drawnBy = c.drawnBy;
  return ours;
}

Result<nlohmann::json> comparePictures(const PicturesCase& c, const WallsPrograms& programs,
                                       const std::string& folder) {
  const WallsCase ours = ourPictures(c);
  WallsCase theirs = osgCase(c.scene, true, c.kind == "SUBMIT" ? c.kind : "STRICT", "ST");
  theirs.walls = ours.walls;
  theirs.warm = ours.warm;
  theirs.frames = ours.frames + 1;  // OpenSceneGraph counts frames from 1: the frame is the same
  const std::string our = folder + "/stadion", their = folder + "/osg";
  const auto draw = [&](const WallsCase& of, const char* option, const std::string& prefix) {
    std::vector<std::string> words = wordsFor(of, programs);
    words.insert(words.end(), {option, prefix});
    return !objectIn(outputOf({words, {environmentOf(of)}, kLimit})).is_null();
  };
  if (!draw(ours, "--out", our)) return problem("Stadion drew no pictures of " + c.scene);
  if (!draw(theirs, "--dump", their)) return problem("OpenSceneGraph drew no pictures of " + c.scene);
  const auto apart = differenceOfViews(their, our + "/picture", ours.walls);
  if (!apart) return apart.error();
  return nlohmann::json{{"case", "pictures " + c.scene + " " + c.kind},
                        {"engine", "pictures"},
                        {"class", c.kind},
                        {"scene", c.scene},
                        {"walls", ours.walls},
                        {"wall_workers", ours.drawnBy},
                        {"width", ours.width},
                        {"height", ours.height},
                        {"beyond_share", apart.value().worstView},
                        {"beyond_share_frame", apart.value().frame},
                        {"worst_view", apart.value().view},
                        {"worst", apart.value().worst}};
}

}  // namespace stadion::bench
