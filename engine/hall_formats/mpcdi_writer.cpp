#include "engine/hall_formats/mpcdi_writer.h"

#include "engine/display/lens_turn.h"
#include "engine/display/screen_surface.h"
#include "engine/hall_formats/hall_text.h"
#include "engine/hall_formats/light_map_file.h"
#include "engine/hall_formats/mpcdi_axes.h"
#include "engine/hall_formats/source_view.h"
#include "engine/hall_formats/zip_archive.h"
#include "engine/maths/angles.h"
#include "engine/maths/functions.h"
#include "engine/plain_text/text_line.h"

#include <fmt/format.h>
#include <pugixml.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace stadion {
namespace {

constexpr std::uint32_t kPixelsAPoint = 10;  ///< of geometry level 1
constexpr const char* kHallFile = "stadion.walls";

/// Values of `map` for another gamma.
LightMap withGamma(LightMap map, double gamma) {
  if (map.gamma == gamma) return map;
  for (std::uint16_t& v : map.values)
    if (v > 0) v = static_cast<std::uint16_t>(std::lround(65535 * det::pow(v / 65535.0, map.gamma / gamma)));
  map.gamma = gamma;
  return map;
}

MpcdiFrustum frustumOf(const LensImage& lens, const MpcdiRegion& region) {
  const LensTurn turn = turnOf(lens.X_RP.q);
  const double width = 1 / lens.throwRatio;
  const double height = lens.pixelAspect * width * region.rows / region.columns;
  const auto degrees = [](double tangent) { return det::atan(tangent) / kDegree; };
  MpcdiFrustum f;
  f.yaw = turn.yaw / kDegree;
  f.pitch = turn.pitch / kDegree;
  f.roll = turn.roll / kDegree;
  f.rightAngle = degrees((lens.shift.x() + 0.5) * width);
  f.leftAngle = degrees((lens.shift.x() - 0.5) * width);
  f.upAngle = degrees((lens.shift.y() + 0.5) * height);
  f.downAngle = degrees((lens.shift.y() - 0.5) * height);
  return f;
}

/// The rig's axes, explained to others.
MpcdiFrame frameAt(const Vec3& position) {
  return {position, -Vec3::UnitZ(), Vec3::UnitX(), Vec3::UnitY()};
}

class MpcdiWriter {
public:
  MpcdiWriter(const WallFile& hall, const NeighbourFiles& files, const MpcdiSettings& settings)
      : hall_(hall), files_(files), two_(settings.version == MpcdiVersion::Two), date_(settings.date) {}

  Result<std::string> run() {
    for (const WallEntry& e : hall_.walls)
      if (e.panorama)
        return Result<std::string>::failure(
            fmt::format("MPCDI has no panoramas; take panorama {} out of the hall, or write a .walls file",
                        quotedWord(e.wall.name)));
    lenses_ = !hall_.walls.empty() && std::ranges::all_of(hall_.walls, [](const WallEntry& e) {
      return e.projector && std::holds_alternative<LensImage>(e.projector->image);
    });
    for (const Screen& screen : hall_.screens) surfaces_.emplace_back(screen);
    masked_ = hall_;
    for (WallEntry& entry : masked_.walls)
      if (!addRegion(entry)) return Result<std::string>::failure(fault_);
    if (!addExtensionFiles()) return Result<std::string>::failure(fault_);
    archive_["mpcdi.xml"] = xml();
    return packArchive(archive_);
  }

private:
  bool addRegion(WallEntry& entry) {
    MpcdiRegion region;
    region.id = entry.wall.name;
    region.buffer = lenses_           ? entry.wall.name
                    : entry.projector ? hall_.screens[entry.projector->screen].name
                                      : "walls";
    region.columns = std::max(entry.pixels.width, 1U);
    region.rows = std::max(entry.pixels.height, 1U);
    if (entry.projector && entry.projector->width > 0) {
      region.columns = entry.projector->width;
      region.rows = entry.projector->height;
    }
    region.files.unit = "m";
    region.files.origin = "floorCenter";
    MpcdiContent content;
    if (lenses_) {
      region.frustum = frustumOf(std::get<LensImage>(entry.projector->image), region);
      region.frame = frameAt(std::get<LensImage>(entry.projector->image).X_RP.p);
    }
    const auto* lens = entry.projector ? std::get_if<LensImage>(&entry.projector->image) : nullptr;
    if (lens) aspects_[region.id] = lens->pixelAspect;
    const MeasuredImage image = pointsOf(entry, region);
    std::vector<Vec3> points = image.points;
    if (!lenses_)
      for (Vec3& p : points) p = rigToMpcdi(p);
    region.files.warp = region.id + ".pfm";
    content.warp = pointsAsPfm(points, image.columns, image.rows);
    if (!addLight(entry, region, content)) return false;
    digests_[region.id] = digestOf(region, content);
    archive_[region.files.warp] = std::move(content.warp);
    regions_.push_back(std::move(region));
    return true;
  }

  MeasuredImage pointsOf(const WallEntry& entry, const MpcdiRegion& region) const {
    if (!entry.projector) return sampledImage(planeView(entry.wall), 2, 2);
    const Projector& projector = *entry.projector;
    if (const auto* measured = std::get_if<MeasuredImage>(&projector.image)) return *measured;
    const PixelRays rays(projector, surfaces_[projector.screen]);
    const auto count = [](std::uint32_t pixels) {
      return std::clamp<std::uint32_t>(pixels / kPixelsAPoint, 2, 1024);
    };
    return sampledImage(
        [&rays](const Vec2& share) -> Vec3 {
          return rays.pointLit(share).value_or(
              Vec3(Vec3::Constant(std::numeric_limits<double>::quiet_NaN())));
        },
        count(region.columns), count(region.rows));
  }

  bool addLight(WallEntry& entry, MpcdiRegion& region, MpcdiContent& content) {
    LightMap alpha{2, 2, 1, std::vector<std::uint16_t>(4, 65535), 1};
    std::optional<LightMap> beta;
    if (entry.projector) {
      ProjectorBlend& blend = entry.projector->blend;
      if (!blend.alpha && !blend.mask.empty()) {
        const auto bytes = files_(blend.mask, kMostLightMapBytes);
        const auto read = bytes ? readLightMap(bytes.value()) : Result<ReadLightMap>(bytes.error());
        if (!read)
          return refuse(fmt::format("the mask {}: {}", quotedWord(blend.mask), read.error().message));
        blend.alpha = read.value().map;
      }
      if (blend.alpha)
        alpha = *blend.alpha;
      else if (blend.beta)
        alpha.gamma = blend.beta->gamma;
      if (blend.beta) beta = withGamma(*blend.beta, alpha.gamma);
      const double gamma = entry.projector->light.gamma[0];
      if (two_ && gamma > 0) region.encodeGamma = gamma;
    }
    region.files.alphaGamma = alpha.gamma;
    region.files.alpha = region.id + "-alpha.png";
    if (!addMap(region.files.alpha, alpha, content.alpha)) return false;
    channels_[region.files.alpha] = alpha.channels;
    if (!beta) return true;
    region.files.beta = region.id + "-beta.png";
    channels_[region.files.beta] = beta->channels;
    return addMap(region.files.beta, *beta, content.beta);
  }

  bool addMap(const std::string& name, const LightMap& map, std::string& bytes) {
    const auto png = lightMapAsPng(map);
    if (!png) return refuse(png.error().message);
    bytes = png.value();
    archive_[name] = bytes;
    return true;
  }

  bool refuse(const std::string& why) {
    fault_ = why;
    return false;
  }

  bool addExtensionFiles() {
    auto made = hallText(masked_, "", true);
    if (!made) return refuse(made.error().message);
    archive_[kHallFile] = std::move(made.value().text);
    extensionFiles_.push_back(kHallFile);
    for (auto& [name, bytes] : made.value().files) {
      extensionFiles_.push_back(name);
      archive_[name] = std::move(bytes);
    }
    return true;
  }

  static void leaf(pugi::xml_node parent, const char* name, const std::string& text) {
    parent.append_child(name).text().set(text.c_str());
  }
  static void leaf(pugi::xml_node parent, const char* name, double value) {
    leaf(parent, name, fmt::format("{}", value));
  }
  static void set(pugi::xml_node node, const char* name, const std::string& value) {
    node.append_attribute(name).set_value(value.c_str());
  }

  std::string xml() const {
    pugi::xml_document tree;
    pugi::xml_node declaration = tree.append_child(pugi::node_declaration);
    set(declaration, "version", "1.0");
    set(declaration, "encoding", "utf-8");
    pugi::xml_node root = tree.append_child("MPCDI");
    set(root, "profile", lenses_ ? "sl" : "a3");
    if (two_) {
      set(root, "geometry", "2");
      set(root, "color", "2");
    } else {
      set(root, "level", "4");
    }
    set(root, "date", date_);
    set(root, "version", two_ ? "2.0" : "1.0");
    addDisplay(root.append_child("display"));
    pugi::xml_node files = root.append_child("files");
    for (const MpcdiRegion& region : regions_) addFileSet(files.append_child("fileset"), region);
    addExtension(root.append_child("extensionSet").append_child("extension"));
    std::ostringstream text;
    tree.save(text, "  ", pugi::format_indent, pugi::encoding_utf8);
    return text.str();
  }

  void addDisplay(pugi::xml_node display) const {
    std::vector<std::string> buffers;
    for (const MpcdiRegion& region : regions_)
      if (std::ranges::find(buffers, region.buffer) == buffers.end()) buffers.push_back(region.buffer);
    for (const std::string& id : buffers) {
      pugi::xml_node buffer = display.append_child("buffer");
      set(buffer, "id", id);
      for (const MpcdiRegion& region : regions_)
        if (region.buffer == id) addRegionElement(buffer.append_child("region"), region);
    }
  }

  void addRegionElement(pugi::xml_node node, const MpcdiRegion& region) const {
    set(node, "id", region.id);
    set(node, two_ ? "xResolution" : "Xresolution", std::to_string(region.columns));
    set(node, two_ ? "yResolution" : "Yresolution", std::to_string(region.rows));
    set(node, "x", "0");
    set(node, "y", "0");
    set(node, two_ ? "xSize" : "xsize", "1");
    set(node, two_ ? "ySize" : "ysize", "1");
    if (region.frustum) addFrustum(node.append_child("frustum"), *region.frustum);
    if (region.frame) addFrame(node.append_child("coordinateFrame"), *region.frame);
    if (!two_) return;
    pugi::xml_node color = node.append_child("color");
    const std::string gamma = fmt::format("{}", region.encodeGamma.value_or(2.2));
    for (const char* name : {"decode", "encode"}) {
      pugi::xml_node part = color.append_child(name);
      const bool stated = region.encodeGamma || std::string_view(name) == "decode";
      set(part, "type", stated ? "gamma" : "none");
      if (stated) set(part, "gamma", gamma);
    }
  }

  static void addFrustum(pugi::xml_node node, const MpcdiFrustum& f) {
    leaf(node, "yaw", f.yaw);
    leaf(node, "pitch", f.pitch);
    leaf(node, "roll", f.roll);
    leaf(node, "rightAngle", f.rightAngle);
    leaf(node, "leftAngle", f.leftAngle);
    leaf(node, "upAngle", f.upAngle);
    leaf(node, "downAngle", f.downAngle);
  }

  static void addFrame(pugi::xml_node node, const MpcdiFrame& f) {
    for (const auto& [name, v] : {std::pair{"pos", f.position}, std::pair{"yaw", f.yaw},
                                  std::pair{"pitch", f.pitch}, std::pair{"roll", f.roll}})
      for (int axis = 0; axis < 3; ++axis)
        leaf(node, fmt::format("{}{}", name, "xyz"[axis]).c_str(), v[axis]);
  }

  void addMapElement(pugi::xml_node node, const std::string& name, const std::string& gamma) const {
    leaf(node, "path", name);
    leaf(node, "componentDepth", std::to_string(channels_.at(name)));
    leaf(node, "bitDepth", archive_.at(name)[24] == 16 ? "16" : "8");  // the bit depth in a PNG's first chunk
    if (!gamma.empty()) leaf(node, "gammaEmbedded", gamma);
  }

  void addFileSet(pugi::xml_node node, const MpcdiRegion& region) const {
    set(node, "region", region.id);
    pugi::xml_node warp = node.append_child("geometryWarpFile");
    leaf(warp, "path", region.files.warp);
    leaf(warp, "geometricUnit", region.files.unit);
    leaf(warp, "interpolation", "linear");
    leaf(warp, two_ ? "originOf3DData" : "originof3DData", region.files.origin);
    addMapElement(node.append_child("alphaMap"), region.files.alpha,
                  fmt::format("{}", region.files.alphaGamma));
    if (!region.files.beta.empty()) addMapElement(node.append_child("betaMap"), region.files.beta, "");
  }

  void addExtension(pugi::xml_node node) const {
    set(node, "Name", "Stadion");
    set(node, "hasExternalFiles", "True");
    pugi::xml_node definitions = node.append_child("definitions");
    leaf(definitions, "hall", kHallFile);
    for (const MpcdiRegion& region : regions_) {
      pugi::xml_node part = definitions.append_child("standard");
      set(part, "region", region.id);
      set(part, "digest", digests_.at(region.id));
      if (aspects_.contains(region.id)) set(part, "pixelAspect", fmt::format("{}", aspects_.at(region.id)));
    }
    pugi::xml_node files = node.append_child("fileSet");
    for (const std::string& name : extensionFiles_) {
      pugi::xml_node file = files.append_child("file");
      set(file, "id", name);
      file.text().set(name.c_str());
    }
  }

  const WallFile& hall_;
  const NeighbourFiles& files_;
  bool two_;
  std::string date_;
  bool lenses_ = false;
  WallFile masked_;  ///< the hall, with the masks that it names
  std::vector<ScreenSurface> surfaces_;
  std::vector<MpcdiRegion> regions_;
  std::map<std::string, std::string> archive_, digests_;
  std::map<std::string, std::uint32_t> channels_;  ///< of light maps, by file
  std::map<std::string, double> aspects_;          ///< of pixels, by region
  std::vector<std::string> extensionFiles_;
  std::string fault_;
};

}  // namespace

Result<std::string> formatMpcdi(const WallFile& hall, const NeighbourFiles& files,
                                const MpcdiSettings& settings) {
  return MpcdiWriter(hall, files, settings).run();
}

}  // namespace stadion
