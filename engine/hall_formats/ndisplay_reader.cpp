#include "engine/hall_formats/ndisplay_reader.h"

#include "engine/hall_formats/json_place.h"
#include "engine/hall_formats/ndisplay_scene.h"
#include "engine/hall_formats/number_line.h"
#include "engine/plain_text/text_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace stadion {
namespace {

constexpr double kCentimetre = 0.01;  ///< [m]

bool isPixelCount(double v) {
  return v >= 1 && v <= 16384 && v == std::floor(v);
}

/// Gives a viewport its part of a window. False if the numbers make no rectangle.
bool placeViewport(WallEntry& entry, double x, double y, double width, double height) {
  if (!isPixelCount(width) || !isPixelCount(height) || std::fabs(x) > 1e6 || std::fabs(y) > 1e6) return false;
  entry.pixels = {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
  WallOutput output;
  output.place.rectangle = {static_cast<std::int32_t>(x), static_cast<std::int32_t>(y), entry.pixels.width,
                            entry.pixels.height};
  entry.output = output;
  return true;
}

class NdisplayJson {
public:
  NdisplayJson(HallBuilder& builder, const NeighbourFiles& files)
      : builder_(builder), scene_(builder, files) {}

  void run(JsonPlace root) {
    auto top = root.part("nDisplay");
    if (!top) return root.refuse("the object nDisplay is missing");
    root.done();
    const std::string version = top->text("version");
    if (!version.starts_with("4.") && !version.starts_with("5."))
      top->warn(fmt::format("version {} is not known; it is read as 5.00", quotedWord(version)));
    top->ignore({"description", "assetPath", "misc", "customParameters", "diagnostics"});
    if (auto scene = top->part("scene")) readScene(*scene);
    if (auto cluster = top->part("cluster")) readCluster(*cluster);
    top->done();
    scene_.build();
  }

private:
  struct Corner {
    double x = 0, y = 0;
  };

  void readScene(JsonPlace& scene) {
    for (const char* list : {"xforms", "screens", "cameras"})
      if (auto part = scene.part(list))
        for (auto& [name, place] : part->parts()) readTransform(name, place, list);
    scene.done();
  }

  void readTransform(const std::string& name, JsonPlace& place, const std::string& list) {
    NdisplayTransform t;
    t.parent = place.text("parentId", place.text("parent"));
    if (auto location = place.part("location")) {
      t.location =
          kCentimetre * Vec3(location->number("x", 0), location->number("y", 0), location->number("z", 0));
      location->done();
    }
    if (auto rotation = place.part("rotation")) {
      t.pitch = rotation->number("pitch", 0);
      t.yaw = rotation->number("yaw", 0);
      t.roll = rotation->number("roll", 0);
      rotation->done();
    }
    if (auto size = place.part("size")) {
      t.width = kCentimetre * size->number("width", 0);
      t.height = kCentimetre * size->number("height", 0);
      size->done();
    }
    if (list == "cameras") {
      t.eyeSeparation = kCentimetre * place.number("interpupillaryDistance", 6.4);
      place.ignore({"swapEyes", "stereoOffset"});
      viewPoints_.push_back(name);
    }
    place.done();
    scene_.transforms.emplace(name, t);
  }

  void readCluster(JsonPlace& cluster) {
    cluster.ignore({"primaryNode", "masterNode", "sync", "network", "failover"});
    if (auto nodes = cluster.part("nodes")) {
      const auto all = nodes->parts();
      for (auto node : all) readNode(node.second, all.size() > 1);
    }
    cluster.done();
    if (viewPoints_.empty()) return;
    const NdisplayTransform& eye = scene_.transforms[viewPoints_[0]];
    if (eye.parent.empty())
      builder_.hall().visitor.eye = Vec3(eye.location.y(), eye.location.x(), eye.location.z());
    builder_.hall().eyeSeparation = std::clamp(eye.eyeSeparation, 0.0, 0.5);
  }

  void readNode(JsonPlace& node, bool several) {
    if (several)
      node.note(fmt::format("belongs to the host {}; a cluster file says so here",
                            printable(node.text("host"), 80)));
    node.ignore(
        {"host", "sound", "fullScreen", "graphicsAdapter", "textureShare", "postprocess", "renderHeadless"});
    Corner corner;
    if (auto window = node.part("window")) {
      corner = {window->number("x", 0), window->number("y", 0)};
      window->number("w", 0);
      window->number("h", 0);
      window->done();
    }
    if (auto remap = node.part("outputRemap")) {
      if (remap->flag("bEnable", false)) remap->warn("output remapping is not understood and has no effect");
    }
    if (auto viewports = node.part("viewports"))
      for (auto& [viewportName, viewport] : viewports->parts()) readViewport(viewportName, viewport, corner);
    node.done();
  }

  void readViewport(const std::string& name, JsonPlace& place, const Corner& corner) {
    NdisplayViewport viewport;
    viewport.name = name;
    viewport.place = place.path();
    viewport.viewPoint = place.text("camera");
    if (auto region = place.part("region")) {
      const double x = region->number("x", 0), y = region->number("y", 0);
      const double w = region->number("w", 0), h = region->number("h", 0);
      region->done();
      if (!placeViewport(viewport.entry, corner.x + x, corner.y + y, w, h))
        return region->refuse("must be a rectangle with sides from 1 to 16384 pixels");
    } else {
      return place.refuse("region is missing");
    }
    if (auto overscan = place.part("overscan"))
      if (overscan->flag("bEnabled", false)) overscan->warn("overscan is not understood and has no effect");
    const double card = place.number("gPUIndex", -1);
    if (card >= 0 && card <= 63) viewport.entry.card = static_cast<std::uint32_t>(card);
    place.ignore({"bufferRatio", "allowCrossGPUTransfer", "isShared"});
    if (auto policy = place.part("projectionPolicy")) {
      viewport.policy = policy->text("type");
      if (auto parameters = policy->part("parameters"))
        for (auto& [key, value] : parameters->parts()) viewport.parameters[key] = parameters->text(key);
      policy->done();
    }
    place.done();
    if (viewport.policy.empty()) return place.refuse("projectionPolicy/type is missing");
    scene_.viewports.push_back(std::move(viewport));
  }

  HallBuilder& builder_;
  NdisplayScene scene_;
  std::vector<std::string> viewPoints_;
};

/// A line of a .cfg file: [section] key="value" key=value
struct CfgLine {
  std::string section;
  std::map<std::string, std::string> values;
  std::uint32_t line = 0;

  std::string get(const std::string& key) {
    used.insert(key);
    const auto at = values.find(key);
    return at == values.end() ? "" : at->second;
  }
  std::set<std::string> used{"id"};
};

/// Reads X=1,Y=2,Z=3; letters that are missing stay 0. False if it is not that.
bool readLetters(const std::string& text, std::map<char, double>& values) {
  std::string_view rest = text;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(','), rest.size());
    std::string_view part = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    while (part.starts_with(' ')) part.remove_prefix(1);
    const auto value =
        part.size() > 2 && part[1] == '=' ? NumberLine::numberIn(part.substr(2)) : std::nullopt;
    if (!value || std::fabs(*value) > 1e6) return false;
    values[part[0]] = *value;
  }
  return true;
}

class NdisplayCfg {
public:
  NdisplayCfg(HallBuilder& builder, const NeighbourFiles& files)
      : builder_(builder), scene_(builder, files) {}

  void run(std::string_view text) {
    for (std::uint32_t number = 1; !text.empty(); ++number) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      CfgLine line;
      line.line = number;
      if (split(text.substr(0, end), line)) lines_.push_back(std::move(line));
      text.remove_prefix(std::min(end + 1, text.size()));
      if (lines_.size() > 10000) return builder_.error("the file has too many lines");
    }
    for (CfgLine& line : lines_) readTransform(line);
    for (CfgLine& line : lines_)
      if (line.section == "viewport") readViewport(line);
    for (CfgLine& line : lines_) nameRest(line);
    scene_.build();
  }

private:
  /// False if the line is blank or a comment.
  bool split(std::string_view text, CfgLine& line) {
    NumberLine words(text);
    const std::string_view head = words.word();
    if (head.empty() || head.starts_with('#')) return false;
    const std::size_t open = text.find('['), close = text.find(']');
    if (head[0] != '[' || close == std::string_view::npos) {
      builder_.error("a line must begin with [section]", line.line);
      return false;
    }
    line.section = std::string(text.substr(open + 1, close - open - 1));
    text.remove_prefix(close + 1);
    for (std::size_t equals; (equals = text.find('=')) != std::string_view::npos;) {
      std::string_view key = text.substr(0, equals);
      key.remove_prefix(std::min(key.find_first_not_of(" \t"), key.size()));
      key = key.substr(0, key.find_first_of(" \t"));
      text.remove_prefix(equals + 1);
      text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
      const bool quoted = text.starts_with('"');
      if (quoted) text.remove_prefix(1);
      const std::size_t end = std::min(text.find_first_of(quoted ? "\"" : " \t\r"), text.size());
      line.values[std::string(key)] = std::string(text.substr(0, end));
      text.remove_prefix(std::min(end + (quoted ? 1 : 0), text.size()));
    }
    return true;
  }

  void readTransform(CfgLine& line) {
    const bool screen = line.section == "screen";
    if (!screen && line.section != "scene_node" && line.section != "camera") return;
    NdisplayTransform t;
    t.parent = line.get("parent");
    std::map<char, double> location, rotation, size;
    if (!readLetters(line.get("loc"), location) || !readLetters(line.get("rot"), rotation) ||
        !readLetters(line.get("size"), size))
      return builder_.error("loc, rot and size must be such as loc=\"X=1,Y=0,Z=2\"", line.line);
    t.location = {location['X'], location['Y'], location['Z']};
    t.pitch = rotation['P'];
    t.yaw = rotation['Y'];
    t.roll = rotation['R'];
    t.width = size['X'];
    t.height = size['Y'];
    if (!scene_.transforms.emplace(line.get("id"), t).second)
      return builder_.error(fmt::format("the id {} is given twice", quotedWord(line.get("id"))), line.line);
    if (line.section != "camera") return;
    if (const auto separation = NumberLine::numberIn(line.get("eye_dist")))
      builder_.hall().eyeSeparation = std::clamp(*separation, 0.0, 0.5);
    if (t.parent.empty()) builder_.hall().visitor.eye = {t.location.y(), t.location.x(), t.location.z()};
  }

  CfgLine* find(const std::string& section, const std::string& id) {
    for (CfgLine& line : lines_)
      if (line.section == section && line.get("id") == id) return &line;
    return nullptr;
  }

  /// The window that shows the viewport; nothing if none does.
  CfgLine* windowOf(const std::string& viewport) {
    for (CfgLine& line : lines_)
      if (line.section == "window") {
        std::string list = "," + line.get("viewports") + ",";
        std::erase(list, ' ');
        if (list.find("," + viewport + ",") != std::string::npos) return &line;
      }
    return nullptr;
  }

  double pixels(CfgLine& line, const char* key) { return NumberLine::numberIn(line.get(key)).value_or(0); }

  void readViewport(CfgLine& line) {
    NdisplayViewport viewport;
    viewport.name = line.get("id");
    viewport.place = fmt::format("[viewport] {}", quotedWord(viewport.name));
    viewport.line = line.line;
    viewport.viewPoint = line.get("camera");
    double x = pixels(line, "x"), y = pixels(line, "y");
    if (CfgLine* window = windowOf(viewport.name)) {
      x += pixels(*window, "WinX");
      y += pixels(*window, "WinY");
      for (const char* key : {"ResX", "ResY", "FullScreen", "fullscreen", "postprocess"}) window->get(key);
    }
    if (!placeViewport(viewport.entry, x, y, pixels(line, "width"), pixels(line, "height")))
      return builder_.error("width and height must be from 1 to 16384 pixels", line.line);
    CfgLine* projection = find("projection", line.get("projection"));
    if (!projection)
      return builder_.error(fmt::format("there is no [projection] {}", quotedWord(line.get("projection"))),
                            line.line);
    viewport.policy = projection->get("type");
    for (const auto& [key, value] : projection->values) {
      projection->get(key);
      if (key != "id" && key != "type") viewport.parameters[key] = value;
    }
    scene_.viewports.push_back(std::move(viewport));
  }

  void nameRest(CfgLine& line) {
    static const std::set<std::string> kOfRun{"info",   "cluster_node", "general",    "network",     "render",
                                              "nvidia", "custom",       "input",      "input_setup", "stereo",
                                              "debug",  "projection",   "postprocess"};
    if (kOfRun.contains(line.section)) return builder_.notOfHall("[" + line.section + "]");
    static const std::set<std::string> kRead{"screen", "scene_node", "camera", "viewport", "window"};
    if (!kRead.contains(line.section))
      return builder_.notUnderstood({builder_.file(), line.line, 0}, "[" + line.section + "]",
                                    "it has no effect");
    for (const auto& [key, value] : line.values)
      if (!line.used.contains(key))
        builder_.notUnderstood({builder_.file(), line.line, 0}, fmt::format("[{}] {}", line.section, key),
                               "it has no effect");
  }

  HallBuilder& builder_;
  NdisplayScene scene_;
  std::vector<CfgLine> lines_;
};

}  // namespace

std::optional<WallFile> readNdisplayJson(const std::string& text, const std::string& file,
                                         const NeighbourFiles& files, Diagnostics& out) {
  HallBuilder builder(file, out);
  const auto json = parseJson(text, builder);
  if (!json) return std::nullopt;
  NdisplayJson(builder, files).run(JsonPlace(*json, "", builder));
  return builder.finish();
}

std::optional<WallFile> readNdisplayCfg(const std::string& text, const std::string& file,
                                        const NeighbourFiles& files, Diagnostics& out) {
  HallBuilder builder(file, out);
  NdisplayCfg(builder, files).run(text);
  return builder.finish();
}

}  // namespace stadion
