#include "profiling/plan/costs_file.h"

#include "engine/display/wall_file.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace stadion::plan {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kCostsFormat = "stadion-plan-costs 1";
constexpr double kLongest = 1e7;  ///< [ms]
constexpr std::size_t kMostWalls = WallFile::kMaxWalls, kMostPictures = 8;

struct Wrong {
  std::string what;
};

double number(const Json& j, const char* what, double least, double most) {
  if (!j.is_number()) throw Wrong{fmt::format("\"{}\" is not a number", what)};
  const double value = j.get<double>();
  if (!(value >= least && value <= most))
    throw Wrong{fmt::format("\"{}\" is {}, not from {} to {}", what, value, least, most)};
  return value;
}

const Json& member(const Json& j, const char* name) {
  if (!j.is_object() || !j.contains(name)) throw Wrong{fmt::format("has no \"{}\"", name)};
  return j.at(name);
}

double cost(const Json& j, const char* name) {
  return number(member(j, name), name, 0, kLongest);
}

WallCost wallOf(const Json& j) {
  WallCost wall{cost(j, "cull"), {}, 0};
  if (j.contains("cull_beside_draw"))  // files of 0.1 do not have it
    wall.cullBesideDraw = number(j.at("cull_beside_draw"), "cull_beside_draw", 0, kLongest);
  for (const Json& p : member(j, "pictures")) {
    if (!p.is_array() || p.size() != 3) throw Wrong{"a picture is not [calls, raster, threads at a time]"};
    wall.pictures.push_back({number(p[0], "calls", 0, kLongest), number(p[1], "raster", 0, kLongest),
                             number(p[2], "threads at a time", 0, 4096)});
  }
  if (wall.pictures.size() > kMostPictures) throw Wrong{"a wall has more than eight pictures"};
  return wall;
}

FrameCost frameOf(const Json& j, std::size_t walls) {
  FrameCost frame{cost(j, "app"), cost(j, "app_helpers"), {}, cost(j, "swap")};
  for (const Json& w : member(j, "walls")) frame.walls.push_back(wallOf(w));
  if (frame.walls.size() != walls) throw Wrong{"a frame has not as many walls as the file"};
  return frame;
}

bool costsNothing(const FrameCost& f) {
  double sum = f.app + f.appHelpers + f.swap;
  for (const WallCost& w : f.walls) {
    sum += w.cull;
    for (const PictureCost& p : w.pictures) sum += p.calls + p.raster;
  }
  return sum <= 0;
}

ShowCosts costsOf(const Json& whole) {
  const Json& j = whole.is_object() && whole.contains("costs") ? whole.at("costs") : whole;
  if (member(j, "format") != kCostsFormat) throw Wrong{fmt::format("its format is not \"{}\"", kCostsFormat)};
  ShowCosts costs;
  costs.show = member(j, "show").get<std::string>();
  costs.size = member(j, "size").get<std::string>();
  costs.look = j.value("look", costs.look);
  if (costs.look != "full" && costs.look != "plain")
    throw Wrong{fmt::format("\"look\" is \"{}\", neither full nor plain", costs.look)};
  costs.renderer = j.value("renderer", costs.renderer);
  if (costs.renderer != "cpu" && costs.renderer != "gl")
    throw Wrong{fmt::format("\"renderer\" is \"{}\", neither cpu nor gl", costs.renderer)};
  costs.eyes = static_cast<std::size_t>(number(member(j, "eyes"), "eyes", 1, 2));
  costs.walls = member(j, "walls").get<std::vector<std::string>>();
  costs.cores = number(member(j, "cores"), "cores", 1, 4096);
  costs.rasterThreads = number(member(j, "raster_threads"), "raster_threads", 1, 4096);
  costs.waitsInTurn = member(j, "waits_in_turn").get<bool>();
  if (costs.walls.empty() || costs.walls.size() > kMostWalls) throw Wrong{"no walls, or too many"};
  for (const Json& f : member(j, "frames")) costs.frames.push_back(frameOf(f, costs.walls.size()));
  if (costs.frames.empty()) throw Wrong{"has no frames"};
  if (std::ranges::all_of(costs.frames, costsNothing)) throw Wrong{"its frames cost nothing"};
  return costs;
}

double rounded(double ms) {
  return std::round(ms * 1e4) / 1e4;
}

}  // namespace

std::string toJson(const ShowCosts& costs) {
  Json j{{"format", kCostsFormat},
         {"show", costs.show},
         {"size", costs.size},
         {"look", costs.look},
         {"eyes", costs.eyes},
         {"walls", costs.walls},
         {"cores", costs.cores},
         {"renderer", costs.renderer},
         {"raster_threads", costs.rasterThreads},
         {"waits_in_turn", costs.waitsInTurn}};
  j["frames"] = Json::array();
  for (const FrameCost& f : costs.frames) {
    Json frame{{"app", rounded(f.app)}, {"app_helpers", rounded(f.appHelpers)}, {"swap", rounded(f.swap)}};
    frame["walls"] = Json::array();
    for (const WallCost& w : f.walls) {
      Json pictures = Json::array();
      for (const PictureCost& p : w.pictures)
        pictures.push_back({rounded(p.calls), rounded(p.raster), rounded(p.atOnce)});
      frame["walls"].push_back({{"cull", rounded(w.cull)},
                                {"cull_beside_draw", rounded(w.cullBesideDraw)},
                                {"pictures", pictures}});
    }
    j["frames"].push_back(std::move(frame));
  }
  return j.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Result<ShowCosts> readCosts(const std::string& text, const std::string& name) {
  const auto wrong = [&](const std::string& what) {
    return Diagnostic{
        Severity::Error, {name, 0, 0}, what + "; write one with `stadion plan SHOW --json`", {}};
  };
  try {
    return costsOf(Json::parse(text));
  } catch (const Wrong& w) {
    return wrong(w.what);
  } catch (const Json::exception& e) {
    return wrong(std::string("cannot be read: ") + e.what());
  }
}

}  // namespace stadion::plan
