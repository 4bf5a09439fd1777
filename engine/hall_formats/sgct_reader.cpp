#include "engine/hall_formats/sgct_reader.h"

#include "engine/hall_formats/gl_axes.h"
#include "engine/hall_formats/json_place.h"
#include "engine/hall_formats/light_map_file.h"
#include "engine/hall_formats/source_view.h"
#include "engine/hall_formats/warp_mesh_file.h"
#include "engine/plain_text/text_line.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <map>
#include <tuple>

namespace stadion {
namespace {

constexpr double kSgctPlaneDistance = 10;   ///< [m]
constexpr double kSgctWidestPlane = 20;     ///< of a plane whose distance is not stated [m]
constexpr double kSgctCubeSide = 10;        ///< [m]
constexpr double kSgctDomeDiameter = 14.8;  ///< [m]
constexpr double kSgctCylinderRadius = 5;   ///< [m]
constexpr std::uint32_t kRoundGridColumns = 720;
constexpr std::uint32_t kRoundGridRows = 360;

Vec3 glPoint(JsonPlace& place) {
  const Vec3 p(place.number("x", 0), place.number("y", 0), place.number("z", 0));
  place.done();
  return fromGlAxes(p);
}

Vec3 glPointIn(JsonPlace& place, const std::string& key) {
  auto part = place.part(key);
  return part ? glPoint(*part) : Vec3(Vec3::Zero());
}

/// The turn of a view in R: yaw to the left, then pitch up, then roll anticlockwise, or a quaternion.
Quat turnIn(JsonPlace& place) {
  auto part = place.part("orientation");
  if (!part) return Quat::Identity();
  Quat q = Quat::Identity();
  if (part->has("w")) {
    const double w = part->number("w", 1), x = part->number("x", 0);
    q = Quat(w, x, part->number("y", 0), part->number("z", 0));
    if (!(q.norm() > 1e-6)) part->refuse("is no rotation");
    q = q.norm() > 1e-6 ? q.normalized() : Quat::Identity();
  } else {
    q = turnAbout(1, part->number("yaw", 0)) * turnAbout(0, part->number("pitch", 0)) *
        turnAbout(2, part->number("roll", 0));
  }
  part->done();
  return fromGlAxes(q);
}

struct SgctUser {
  Vec3 eye = Vec3::Zero();
};

/// A window while its viewports are read.
struct SgctWindow {
  std::string name;
  double x = 0, y = 0, width = 0, height = 0;  ///< [pixels]
  bool fullscreen = false;
  std::string monitor;
  OutputShape shape;
};

/// A viewport while its projection is read.
struct SgctViewport {
  JsonPlace& place;
  const SgctWindow& window;
  Vec2 pos{0, 0}, size{1, 1};  ///< shares of the window, from its lower left corner
  Vec3 eye;
  WallEntry entry;
  ProjectorBlend blend;
  std::optional<Eye> forEye;
  std::string mesh;

  bool needsProjector() const { return !blend.computed || forEye || !mesh.empty(); }
};

class SgctReader {
public:
  SgctReader(HallBuilder& builder, const NeighbourFiles& files) : builder_(builder), files_(files) {}

  void run(JsonPlace root) {
    if (root.number("version", 1) != 1) root.warn("only version 1 of the format is known");
    root.ignore({"masteraddress", "debuglog", "threadaffinity", "firmsync", "capture", "trackers", "settings",
                 "generator", "meta", "$schema"});
    users(root);
    if (auto scene = root.part("scene")) {
      scene->warn("moves the show, not the hall; it has no effect: place the show's rig instead");
    }
    auto nodes = root.part("nodes");
    if (!nodes) return root.refuse("the list of nodes is missing");
    const auto all = nodes->parts();
    for (auto node : all) readNode(node.second, all.size() > 1);
    root.done();
  }

private:
  void users(JsonPlace& root) {
    auto list = root.part("users");
    if (!list) return;
    bool first = true;
    for (auto& [number, user] : list->parts()) {
      SgctUser read;
      read.eye = glPointIn(user, "pos");
      const double separation = user.number("eyeseparation", 0.064);
      const std::string name = user.text("name");
      user.ignore({"tracking"});
      user.done();
      users_[name] = read;
      if (!first) continue;
      first = false;
      defaultUser_ = read;
      builder_.hall().visitor.eye = read.eye;
      builder_.hall().eyeSeparation = std::clamp(separation, 0.0, 0.5);
    }
  }

  void readNode(JsonPlace& node, bool several) {
    const std::string address = node.text("address");
    if (several)
      node.note(fmt::format("belongs to the host {}; a cluster file says so here", printable(address, 80)));
    node.ignore({"port", "datatransferport", "swaplock"});
    if (auto windows = node.part("windows"))
      for (auto& [number, window] : windows->parts()) readWindow(window);
    node.done();
  }

  void readWindow(JsonPlace& place) {
    SgctWindow window;
    window.name = place.text("name", fmt::format("window-{}", ++windows_));
    if (auto size = place.part("size")) {
      window.width = size->number("x", 0);
      window.height = size->number("y", 0);
      size->done();
    }
    const auto sound = [](double side) { return side >= 1 && side <= 16384 && side == std::floor(side); };
    if (!sound(window.width) || !sound(window.height))
      return place.refuse("size must be x and y, from 1 to 16384 pixels");
    if (auto pos = place.part("pos")) {
      window.x = pos->number("x", 0);
      window.y = pos->number("y", 0);
      pos->done();
    }
    window.fullscreen = place.flag("fullscreen", false);
    const double monitor = place.number("monitor", -1);
    if (monitor >= 0) window.monitor = fmt::format("{}", std::lround(monitor) + 1);
    window.shape.flipH = place.flag("mirrorx", false);
    window.shape.flipV = place.flag("mirrory", false);
    const std::string stereo = place.text("stereo", "none");
    if (stereo != "none" && stereo != "no_stereo")
      place.warn(fmt::format("stereo {} is an option of the run here, not of the hall: --stereo",
                             printable(stereo, 40)));
    if (place.has("blitwindowid")) {
      place.ignore({"blitwindowid"});
      return place.warn("copies the picture of another window and is left out");
    }
    for (const char* key : {"res", "spout", "ndi", "scalablemesh"})
      if (place.has(key)) place.warn(fmt::format("{} has no effect here", key));
    place.ignore({"res",
                  "spout",
                  "ndi",
                  "scalablemesh",
                  "id",
                  "tags",
                  "bufferbitdepth",
                  "autoiconify",
                  "hidemousecursor",
                  "floating",
                  "alwaysrender",
                  "hidden",
                  "takescreenshot",
                  "alpha",
                  "msaa",
                  "fxaa",
                  "border",
                  "resizable",
                  "draw2d",
                  "draw3d",
                  "noerror"});
    const auto viewports = place.part("viewports");
    if (viewports)
      for (auto& [number, viewport] : viewports->parts()) readViewport(viewport, window);
    place.done();
  }

  void readViewport(JsonPlace& place, const SgctWindow& window) {
    SgctViewport viewport{place, window, {0, 0}, {1, 1}, defaultUser_.eye, {}, {}, std::nullopt, {}};
    if (auto pos = place.part("pos")) {
      viewport.pos = {pos->number("x", 0), pos->number("y", 0)};
      pos->done();
    }
    if (auto size = place.part("size")) {
      viewport.size = {size->number("x", 1), size->number("y", 1)};
      size->done();
    }
    if (!output(viewport)) return place.refuse("pos and size must be a part of the window, from 0 to 1");
    if (const std::string user = place.text("user"); !user.empty()) {
      if (!users_.contains(user)) return place.refuse(fmt::format("there is no user {}", quotedWord(user)));
      viewport.eye = users_[user].eye;
    }
    masks(viewport);
    const std::string eye = place.text("eye", "center");
    if (eye == "left") viewport.forEye = Eye::Left;
    if (eye == "right") viewport.forEye = Eye::Right;
    if (place.has("overlay")) place.warn("overlay has no effect here");
    place.ignore({"overlay", "tracked", "type"});
    viewport.mesh = place.text("mesh");
    viewport.entry.wall.name = fmt::format("{}-{}", window.name, ++views_);
    auto projection = place.part("projection");
    if (projection)
      project(viewport, *projection);
    else
      place.warn("has no projection and is left out");
    place.done();
  }

  /// Gives the viewport its part of the window.
  static bool output(SgctViewport& v) {
    const SgctWindow& w = v.window;
    const double width = std::round(v.size.x() * w.width), height = std::round(v.size.y() * w.height);
    if (!(width >= 1 && height >= 1 && width <= 16384 && height <= 16384) || v.pos.cwiseAbs().maxCoeff() > 1)
      return false;
    v.entry.pixels = {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
    WallOutput out;
    out.shape = w.shape;
    const bool whole = v.pos == Vec2(0, 0) && v.size == Vec2(1, 1);
    out.place.monitor = w.monitor;
    out.place.fullscreen = w.fullscreen && whole;
    const double x = w.x + std::round(v.pos.x() * w.width);
    const double y = w.y + std::round((1 - v.pos.y() - v.size.y()) * w.height);
    if (std::fabs(x) > 1e6 || std::fabs(y) > 1e6) return false;
    if (!out.place.fullscreen)
      out.place.rectangle = {static_cast<std::int32_t>(x), static_cast<std::int32_t>(y), v.entry.pixels.width,
                             v.entry.pixels.height};
    v.entry.output = out;
    return true;
  }

  void masks(SgctViewport& viewport) {
    for (const auto& [key, map] : {std::pair{"blendmask", &ProjectorBlend::alpha},
                                   std::pair{"blacklevelmask", &ProjectorBlend::alpha}}) {
      const std::string name = viewport.place.text(key);
      if (name.empty()) continue;
      if (viewport.blend.*map) {
        viewport.place.warn(fmt::format("{} has no effect beside another mask", key));
        continue;
      }
      const auto bytes = files_(name, kMostLightMapBytes);
      const auto read = bytes ? readLightMap(bytes.value()) : Result<ReadLightMap>(bytes.error());
      if (!read) {
        viewport.place.refuse(fmt::format("{} {}: {}", key, quotedWord(name), read.error().message));
        continue;
      }
      viewport.blend.*map = read.value().map;
      (viewport.blend.*map)->gamma = kDisplayGamma;
      viewport.blend.computed = false;
      viewport.place.note(
          fmt::format("{} multiplies pixel values there; here it is read with gamma {}", key, kDisplayGamma));
    }
  }

  void project(SgctViewport& v, JsonPlace& p) {
    const std::string type = p.text("type");
    if (type == "ProjectionPlane")
      plane(v, p);
    else if (type == "PlanarProjection" || type == "TextureMappedProjection")
      planar(v, p);
    else if (type == "FisheyeProjection")
      fisheye(v, p);
    else if (type == "EquirectangularProjection")
      equirectangular(v, p);
    else if (type == "CylindricalProjection")
      cylindrical(v, p);
    else if (type == "SphericalMirrorProjection")
      mirror(v, p);
    else if (type == "CubemapProjection")
      cube(v, p);
    else {
      builder_.notUnderstood({builder_.file(), 0, 0}, fmt::format("{}/type {}", p.path(), quotedWord(type)),
                             "the viewport is left out");
      return;
    }
    p.done();
  }

  /// Six views around the user, each of a quarter turn.
  void cube(SgctViewport& v, JsonPlace& p) {
    const std::uint32_t side = cubePixels(p.text("quality", "512"));
    p.warn("its pictures go to other programs there; here they are six walls of a cube around the user");
    p.ignore({"spout", "ndi"});
    const Quat turn = turnIn(p);
    auto channels = p.part("channels");
    const std::tuple<const char*, const char*, Vec3> kFaces[] = {
        {"right", "right", {0, -90, 0}},   {"left", "left", {0, 90, 0}},   {"top", "top", {90, 0, 0}},
        {"bottom", "bottom", {-90, 0, 0}}, {"zright", "front", {0, 0, 0}}, {"zleft", "back", {0, 180, 0}}};
    for (const auto& [channel, name, degrees] : kFaces) {
      if (channels && !channels->flag(channel, true)) continue;
      WarpView view;
      view.q_RP = turn * fromGlAxes(turnAbout(1, degrees.y()) * turnAbout(0, degrees.x()));
      view.right = view.up = kPi / 4;
      view.left = view.down = -kPi / 4;
      WallEntry entry;
      entry.wall = wallOfView(view, v.eye, kSgctCubeSide / 2);
      entry.wall.name = fmt::format("{}-{}", v.entry.wall.name, name);
      entry.pixels = {side, side};
      builder_.add(std::move(entry));
    }
    if (channels) channels->done();
  }

  static std::uint32_t cubePixels(const std::string& quality) {
    static const std::map<std::string, std::uint32_t> kQualities{
        {"low", 256},   {"256", 256},   {"medium", 512}, {"512", 512},   {"high", 1024},  {"1k", 1024},
        {"1024", 1024}, {"1.5k", 1536}, {"1536", 1536},  {"2k", 2048},   {"2048", 2048},  {"4k", 4096},
        {"4096", 4096}, {"8k", 8192},   {"8192", 8192},  {"16k", 16384}, {"16384", 16384}};
    const auto known = kQualities.find(quality);
    return known == kQualities.end() ? 512 : known->second;
  }

  void plane(SgctViewport& v, JsonPlace& p) {
    const Vec3 lowerLeft = glPointIn(p, "lowerleft"), upperLeft = glPointIn(p, "upperleft");
    const Vec3 upperRight = glPointIn(p, "upperright");
    flat(v, wallOfEdges(lowerLeft, upperRight - upperLeft, upperLeft - lowerLeft));
  }

  void planar(SgctViewport& v, JsonPlace& p) {
    WarpView view;
    double distance = p.number("distance", 0);
    if (auto fov = p.part("fov")) {
      if (fov->has("hfov")) {
        view.right = fov->number("hfov", 0) * kDegree / 2;
        view.left = -view.right;
        view.up = fov->number("vfov", 0) * kDegree / 2;
        view.down = -view.up;
      } else {
        view.left = -fov->number("left", 0) * kDegree;
        view.right = fov->number("right", 0) * kDegree;
        view.up = fov->number("up", 0) * kDegree;
        view.down = -fov->number("down", 0) * kDegree;
      }
      distance = fov->number("distance", distance);
      fov->done();
    }
    view.q_RP = turnIn(p);
    const Vec3 offset = glPointIn(p, "offset");
    if (!isFlatView(view))
      return p.refuse("fov must be angles of a flat picture, each below 89.9 degrees from the middle");
    if (distance == 0) distance = usualDistance(view);
    if (!(distance > 0.01 && distance < 1e5)) return p.refuse("distance must be from 0.01 to 1e5");
    flat(v, wallOfView(view, v.eye + offset, distance));
  }

  /// How far a plane stands whose distance is not stated: it matters for two eyes only.
  static double usualDistance(const WarpView& view) {
    const Wall at1 = wallOfView(view, Vec3::Zero(), 1);
    const double side =
        std::max((at1.lowerRight - at1.lowerLeft).norm(), (at1.upperLeft - at1.lowerLeft).norm());
    return std::min(kSgctPlaneDistance, kSgctWidestPlane / side);
  }

  void flat(SgctViewport& v, Wall wall) {
    wall.name = v.entry.wall.name;
    if ((wall.lowerRight - wall.lowerLeft).cross(wall.upperLeft - wall.lowerLeft).norm() < 1e-9)
      return v.place.refuse("the projection's plane has no area");
    if (!v.needsProjector()) {
      v.entry.wall = wall;
      return builder_.add(std::move(v.entry));
    }
    std::optional<WarpFile> warp;
    if (!v.mesh.empty() && !(warp = readMesh(v, v.mesh))) return;
    if (warp && warp->view) {
      const Vec3 eye = warp->view->hasEye ? warp->view->eye : v.eye;
      if (!isFlatView(*warp->view)) return v.place.refuse("the mesh's view is no flat picture");
      wall = wallOfView(*warp->view, eye, usualDistance(*warp->view));
    }
    Screen screen;
    screen.name = v.entry.wall.name;
    screen.surface = wall;
    const std::size_t number = builder_.addScreen(screen);
    Projector projector = fillingProjector(number, v.entry.pixels);
    if (!warp) return addProjector(v, std::move(projector));
    warped(v, std::move(projector), *warp, planeView(wall));
  }

  std::optional<WarpFile> readMesh(SgctViewport& v, const std::string& name) {
    const auto bytes = files_(name, kMostWarpFileBytes);
    if (!bytes) {
      v.place.refuse(fmt::format("mesh {}: {}", quotedWord(name), bytes.error().message));
      return std::nullopt;
    }
    const double aspect = v.window.width * v.size.x() / (v.window.height * v.size.y());
    Diagnostics findings;
    auto warp = readWarpFile(bytes.value(), name, aspect, findings);
    builder_.out().append(findings);
    if (!warp) {
      v.place.refuse(fmt::format("mesh {} is not read", quotedWord(name)));
      return std::nullopt;
    }
    if (warp->ofWindow) ofViewport(v, warp->mesh);
    return warp;
  }

  /// Turns shares of the window into shares of the viewport.
  static void ofViewport(const SgctViewport& v, WarpMesh& mesh) {
    const Vec2 corner(v.pos.x(), 1 - v.pos.y() - v.size.y());
    for (WarpMesh::Vertex& vertex : mesh.vertices) {
      vertex.at = (vertex.at - corner).cwiseQuotient(v.size);
      vertex.source = (vertex.source - corner).cwiseQuotient(v.size);
    }
  }

  void warped(SgctViewport& v, Projector projector, const WarpFile& warp, const SourceView& view) {
    auto image = warpedImage(warp.mesh, view, v.mesh, v.entry.pixels.width, v.entry.pixels.height);
    if (!image)
      return v.place.refuse(fmt::format("the triangles of {} overlap too much", quotedWord(v.mesh)));
    projector.image = std::move(image->image);
    if (image->light && v.blend.alpha) v.place.warn("the light of the mesh has no effect beside a mask");
    if (image->light && !v.blend.alpha) {
      v.blend.alpha = image->light;
      v.blend.alpha->gamma = kDisplayGamma;
    }
    v.blend.computed = false;
    addProjector(v, std::move(projector));
  }

  void addProjector(SgctViewport& v, Projector projector) {
    projector.eye = v.forEye;
    projector.blend = v.blend;
    v.entry.projector = std::move(projector);
    builder_.add(std::move(v.entry));
  }

  /// Adds a dome around the viewport's user.
  std::size_t addDome(const SgctViewport& v, double radius, double lowest, double tilt) {
    SphereScreen dome;
    dome.centre = v.eye;
    dome.radius = radius;
    dome.left = -kPi;
    dome.right = kPi;
    dome.lowest = std::max(lowest, -kPi / 2);
    dome.highest = kPi / 2;
    dome.tilt = tilt;
    Screen screen;
    screen.name = v.entry.wall.name;
    screen.surface = dome;
    return builder_.addScreen(screen);
  }

  static void roundOnly(JsonPlace& p) {
    if (p.has("crop")) p.warn("crop has no effect here");
    p.ignore({"quality", "background", "crop", "interpolation", "keepaspectratio"});
  }

  void fisheye(SgctViewport& v, JsonPlace& p) {
    roundOnly(p);
    const double angle = p.number("fov", 180) * kDegree, tilt = p.number("tilt", 0) * kDegree;
    const double radius = p.number("diameter", kSgctDomeDiameter) / 2;
    if (!(angle > 0 && angle <= 2 * kPi)) return p.refuse("fov must be above 0 and at most 360 degrees");
    if (!(radius > 0.05 && radius < 1e5)) return p.refuse("diameter must be from 0.1 to 2e5");
    v.eye += glPointIn(p, "offset");
    const std::size_t screen = addDome(v, radius, kPi / 2 - angle / 2, tilt);
    // The middle of the picture is overhead, its lower edge is before the user; a tilt brings it forward.
    const Quat q_RP = det::expRotation(Vec3(kPi / 2 - tilt, 0, 0));
    Projector projector = fillingProjector(screen, v.entry.pixels);
    projector.image = FisheyeImage{{v.eye, q_RP}, angle};
    if (v.mesh.empty()) return addProjector(v, std::move(projector));
    const auto warp = readMesh(v, v.mesh);
    if (!warp) return;
    const Vec3 eye = v.eye;
    warped(v, std::move(projector), *warp, [q_RP, eye, angle, radius](const Vec2& share) -> Vec3 {
      const Vec2 out(2 * share.x() - 1, 1 - 2 * share.y());
      const double r = out.norm();
      if (r > 1) return Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
      const auto [sin, cos] = det::sincos(r * angle / 2);
      const Vec2 side = r > 0 ? Vec2(out / r) : Vec2(0, 0);
      return eye + radius * (q_RP * Vec3(sin * side.x(), cos, sin * side.y()));
    });
  }

  void equirectangular(SgctViewport& v, JsonPlace& p) {
    roundOnly(p);
    const std::size_t screen = addDome(v, kSgctDomeDiameter / 2, -kPi / 2, 0);
    const Vec3 eye = v.eye;
    roundView(v, screen, [eye](const Vec2& share) -> Vec3 {
      const auto azimuth = det::sincos(2 * kPi * (share.x() - 0.5));
      const auto elevation = det::sincos(kPi * (0.5 - share.y()));
      return eye + kSgctDomeDiameter / 2 *
                       Vec3(elevation.cos * azimuth.sin, elevation.cos * azimuth.cos, elevation.sin);
    });
  }

  void cylindrical(SgctViewport& v, JsonPlace& p) {
    roundOnly(p);
    const double turn = p.number("rotation", 0), rise = p.number("heightoffset", 0);
    const double radius = p.number("radius", kSgctCylinderRadius);
    if (!(radius > 0.05 && radius < 1e5)) return p.refuse("radius must be from 0.05 to 1e5");
    CylinderScreen cylinder;
    cylinder.centre = v.eye;
    cylinder.radius = radius;
    cylinder.left = -kPi;
    cylinder.right = kPi;
    cylinder.bottom = rise * radius;
    cylinder.top = (1 + rise) * radius;
    Screen screen;
    screen.name = v.entry.wall.name;
    screen.surface = cylinder;
    const std::size_t number = builder_.addScreen(screen);
    const Vec3 eye = v.eye;
    roundView(v, number, [eye, turn, rise, radius](const Vec2& share) -> Vec3 {
      // The left edge is at +X, and the view turns to the right.
      const auto [sin, cos] = det::sincos(turn - 2 * kPi * share.x());
      return eye + radius * Vec3(cos, sin, 1 - share.y() + rise);
    });
  }

  void roundView(SgctViewport& v, std::size_t screen, const SourceView& view) {
    Projector projector = fillingProjector(screen, v.entry.pixels);
    if (!v.mesh.empty()) {
      const auto warp = readMesh(v, v.mesh);
      if (warp) warped(v, std::move(projector), *warp, view);
      return;
    }
    projector.image = sampledImage(view, kRoundGridColumns, kRoundGridRows);
    addProjector(v, std::move(projector));
  }

  void mirror(SgctViewport& v, JsonPlace& p) {
    roundOnly(p);
    const double tilt = p.number("tilt", 0);
    auto geometry = p.part("geometry");
    if (!geometry) return p.refuse("geometry with bottom, left, right and top is missing");
    const Quat base = turnAbout(0, 45 - tilt);
    const std::pair<const char*, Quat> kFaces[] = {{"bottom", base},
                                                   {"left", base * turnAbout(1, 90)},
                                                   {"right", base * turnAbout(1, -90)},
                                                   {"top", base * turnAbout(0, 90)}};
    MeasuredImage whole;
    std::optional<LightMap> light;
    const Vec3 eye = v.eye;
    for (const auto& [key, q] : kFaces) {
      const std::string name = geometry->text(key);
      const auto warp = readMesh(v, name);
      if (!warp) return;
      const Quat q_RP = fromGlAxes(q);
      const SourceView view = [eye, q_RP](const Vec2& share) -> Vec3 {
        const Vec3 direction(2 * share.x() - 1, 1, 1 - 2 * share.y());
        return eye + kSgctDomeDiameter / 2 * (q_RP * direction).normalized();
      };
      auto part = warpedImage(warp->mesh, view, name, v.entry.pixels.width, v.entry.pixels.height);
      if (!part) return p.refuse(fmt::format("the triangles of {} overlap too much", quotedWord(name)));
      if (part->light) p.warn(fmt::format("the light of {} has no effect", quotedWord(name)));
      if (whole.points.empty())
        whole = std::move(part->image);
      else
        for (std::size_t i = 0; i < whole.points.size(); ++i)
          if (part->image.points[i].allFinite()) whole.points[i] = part->image.points[i];
    }
    geometry->done();
    whole.file.clear();
    Projector projector = fillingProjector(addDome(v, kSgctDomeDiameter / 2, -kPi / 2, 0), v.entry.pixels);
    projector.image = std::move(whole);
    v.blend.computed = false;
    addProjector(v, std::move(projector));
  }

  static constexpr double kDisplayGamma = 2.2;  ///< masks there multiply pixel values, not light

  HallBuilder& builder_;
  const NeighbourFiles& files_;
  std::map<std::string, SgctUser> users_;
  SgctUser defaultUser_;
  int windows_ = 0, views_ = 0;
};

}  // namespace

std::optional<WallFile> readSgct(const std::string& text, const std::string& file,
                                 const NeighbourFiles& files, Diagnostics& out) {
  HallBuilder builder(file, out);
  const auto json = parseJson(text, builder);
  if (!json) return std::nullopt;
  SgctReader(builder, files).run(JsonPlace(*json, "", builder));
  return builder.finish();
}

}  // namespace stadion
