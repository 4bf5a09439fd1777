#include "engine/hall_formats/ndisplay_scene.h"

#include "engine/display/screen_mesh.h"
#include "engine/hall_formats/light_map_file.h"
#include "engine/hall_formats/mpcdi_reader.h"
#include "engine/hall_formats/number_line.h"
#include "engine/maths/angles.h"
#include "engine/maths/functions.h"
#include "engine/plain_text/suggestion.h"
#include "engine/plain_text/text_line.h"

#include <fmt/format.h>

#include <algorithm>

namespace stadion {
namespace {

constexpr int kMostParents = 64;

/// Unreal's axes to the rig's.
Vec3 fromUnreal(const Vec3& v) {
  return {v.y(), v.x(), v.z()};
}

/// The axes of a rotator, in its parent's: yaw about Z to the right, then pitch up, then roll clockwise.
Mat3 axesOfRotator(const NdisplayTransform& t) {
  const auto p = det::sincos(t.pitch * kDegree), y = det::sincos(t.yaw * kDegree),
             r = det::sincos(t.roll * kDegree);
  Mat3 axes;
  axes.col(0) = Vec3(p.cos * y.cos, p.cos * y.sin, p.sin);
  axes.col(1) =
      Vec3(r.sin * p.sin * y.cos - r.cos * y.sin, r.sin * p.sin * y.sin + r.cos * y.cos, -r.sin * p.cos);
  axes.col(2) =
      Vec3(-(r.cos * p.sin * y.cos + r.sin * y.sin), y.cos * r.sin - r.cos * p.sin * y.sin, r.cos * p.cos);
  return axes;
}

std::string parameterOf(const NdisplayViewport& viewport, const std::string& key) {
  const auto at = viewport.parameters.find(key);
  return at == viewport.parameters.end() ? "" : at->second;
}

}  // namespace

std::optional<NdisplayScene::Axes> NdisplayScene::axesOf(const std::string& name,
                                                         const NdisplayViewport& viewport) {
  Axes axes;
  std::string at = name;
  for (int depth = 0; !at.empty(); ++depth) {
    const auto found = transforms.find(at);
    if (found == transforms.end() || depth == kMostParents) {
      std::vector<std::string> names;
      for (const auto& [known, transform] : transforms) names.push_back(known);
      const std::string why = depth == kMostParents ? "the parents of {1} form a circle or are too many"
                                                    : "there is no screen or transform {0}{2}";
      builder_.error(
          viewport.place + ": " +
              fmt::format(fmt::runtime(why), quotedWord(at), quotedWord(name), didYouMean(at, names)),
          viewport.line);
      return std::nullopt;
    }
    const NdisplayTransform& t = found->second;
    const Mat3 turned = axesOfRotator(t);
    axes.origin = t.location + turned * axes.origin;
    axes.unreal = turned * axes.unreal;
    at = t.parent;
  }
  return axes;
}

void NdisplayScene::build() {
  for (NdisplayViewport& viewport : viewports) {
    std::string policy = viewport.policy;
    std::ranges::transform(policy, policy.begin(), [](char c) {
      return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    viewport.entry.wall.name = viewport.name;
    if (policy == "simple") {
      nameRest(viewport, {"screen", "mesh_component"});
      buildScreen(viewport, parameterOf(viewport, "screen"));
    } else if (policy == "mesh") {
      const std::string component = parameterOf(viewport, "mesh_component");
      nameRest(viewport, {"mesh_component"});
      const auto screen = transforms.find(component);
      if (screen != transforms.end() && screen->second.width > 0)
        buildScreen(viewport, component);
      else
        leaveOut(viewport, fmt::format("the mesh {} is an asset of the game engine", quotedWord(component)));
    } else if (policy == "mpcdi") {
      buildMpcdi(viewport);
    } else {
      leaveOut(viewport,
               fmt::format("the projection policy {} is not understood", quotedWord(viewport.policy)));
    }
  }
}

void NdisplayScene::leaveOut(const NdisplayViewport& viewport, const std::string& why) {
  builder_.warning(fmt::format("{}: {}; the viewport is left out", viewport.place, why), viewport.line);
}

void NdisplayScene::nameRest(const NdisplayViewport& viewport,
                             std::initializer_list<std::string_view> known) {
  for (const auto& [key, value] : viewport.parameters)
    if (std::ranges::find(known, key) == known.end() && !value.empty())
      builder_.notUnderstood({builder_.file(), viewport.line, 0}, viewport.place + "/" + key,
                             "it has no effect");
}

void NdisplayScene::buildScreen(NdisplayViewport& viewport, const std::string& screen) {
  const auto found = transforms.find(screen);
  const auto axes = axesOf(screen, viewport);
  if (!axes) return;
  if (found == transforms.end() || !(found->second.width > 1e-6 && found->second.height > 1e-6))
    return builder_.error(fmt::format("{}: the screen {} has no size", viewport.place, quotedWord(screen)),
                          viewport.line);
  const Vec3 right = found->second.width * axes->unreal.col(1),
             up = found->second.height * axes->unreal.col(2);
  const std::string name = viewport.entry.wall.name;
  viewport.entry.wall =
      wallOfEdges(fromUnreal(axes->origin - 0.5 * right - 0.5 * up), fromUnreal(right), fromUnreal(up));
  viewport.entry.wall.name = name;
  builder_.add(viewport.entry);
}

void NdisplayScene::buildMpcdi(NdisplayViewport& viewport) {
  if (const std::string pfm = parameterOf(viewport, "pfm"); !pfm.empty()) return buildPfm(viewport, pfm);
  nameRest(viewport, {"file", "buffer", "region", "origin"});
  const std::string file = parameterOf(viewport, "file"), region = parameterOf(viewport, "region");
  const auto bytes = files_(file, kMostMpcdiBytes);
  if (!bytes)
    return builder_.error(fmt::format("{}: {}", viewport.place, bytes.error().message), viewport.line);
  Diagnostics findings;
  const auto hall = readMpcdi(bytes.value(), file, findings);
  builder_.out().append(findings);
  if (!hall)
    return builder_.error(fmt::format("{}: {} is not read", viewport.place, quotedWord(file)), viewport.line);
  const auto entry =
      std::ranges::find_if(hall->walls, [&region](const WallEntry& e) { return e.wall.name == region; });
  if (entry == hall->walls.end() || !entry->projector)
    return builder_.error(fmt::format("{}: {} has no region {}{}", viewport.place, quotedWord(file),
                                      quotedWord(region), didYouMean(region, hall->names())),
                          viewport.line);
  if (!parameterOf(viewport, "origin").empty())
    builder_.warning(viewport.place +
                         ": the origin of the points has no effect; they stand as the MPCDI file says",
                     viewport.line);
  viewport.entry.projector = entry->projector;
  viewport.entry.projector->screen = builder_.addScreen(hall->screens[entry->projector->screen]);
  builder_.add(viewport.entry);
}

void NdisplayScene::buildPfm(NdisplayViewport& viewport, const std::string& file) {
  nameRest(viewport, {"pfm", "scale", "alpha", "alpha_gamma", "beta", "origin", "mpcdiprofile"});
  const std::string stated = parameterOf(viewport, "scale");
  const auto scale = stated.empty() ? std::optional(1.0) : NumberLine::numberIn(stated);
  const auto bytes = files_(file, std::size_t{256} << 20);
  if (!bytes || !scale || !(*scale > 0 && *scale < 1e6))
    return builder_.error(fmt::format("{}: {}", viewport.place,
                                      bytes ? "scale must be a number above 0" : bytes.error().message),
                          viewport.line);
  Diagnostics findings;
  const auto grid = readPointGrid(bytes.value(), file, *scale * 0.01, findings);
  auto mesh = grid ? meshOfGrid(*grid, file, findings) : std::nullopt;
  builder_.out().append(findings);
  if (!mesh)
    return builder_.error(fmt::format("{}: {} is not read", viewport.place, quotedWord(file)), viewport.line);
  for (Vec3& p : mesh->points) p = fromUnreal(p);
  Screen screen;
  screen.name = viewport.name;
  screen.surface = std::move(*mesh);
  Projector projector = fillingProjector(builder_.addScreen(std::move(screen)), viewport.entry.pixels);
  MeasuredImage image{file, grid->columns, grid->rows, grid->points};
  for (Vec3& p : image.points) p = fromUnreal(p);
  projector.image = std::move(image);
  projector.blend.computed = false;
  const auto gamma = NumberLine::numberIn(parameterOf(viewport, "alpha_gamma"));
  for (const auto& [key, map] :
       {std::pair{"alpha", &ProjectorBlend::alpha}, std::pair{"beta", &ProjectorBlend::beta}}) {
    const std::string name = parameterOf(viewport, key);
    if (name.empty()) continue;
    const auto png = files_(name, kMostLightMapBytes);
    const auto read = png ? readLightMap(png.value()) : Result<ReadLightMap>(png.error());
    if (!read)
      return builder_.error(fmt::format("{}/{}: {}", viewport.place, key, read.error().message),
                            viewport.line);
    projector.blend.*map = read.value().map;
    (projector.blend.*map)->gamma = gamma && *gamma > 0 && *gamma < 10 ? *gamma : 1;
  }
  viewport.entry.projector = std::move(projector);
  builder_.add(viewport.entry);
}

}  // namespace stadion
