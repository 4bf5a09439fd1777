#include "engine/hall_formats/mpcdi_document.h"

#include "engine/hall_formats/number_line.h"
#include "engine/plain_text/text_line.h"

#include <fmt/format.h>
#include <pugixml.hpp>
#include <xxhash.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace stadion {
namespace {

constexpr std::size_t kMostRegions = 1000;
constexpr std::size_t kMostXmlDepth = 24;

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

std::string_view withoutBlanks(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

/// Elements and attributes of the standard that have an effect or need none, in lower case.
const std::set<std::string>& knownPaths() {
  static const std::set<std::string> kKnown{"mpcdi",
                                            "mpcdi@profile",
                                            "mpcdi@level",
                                            "mpcdi@geometry",
                                            "mpcdi@color",
                                            "mpcdi@date",
                                            "mpcdi@version",
                                            "mpcdi/display",
                                            "mpcdi/display/buffer",
                                            "mpcdi/display/buffer@id",
                                            "mpcdi/display/buffer@xresolution",
                                            "mpcdi/display/buffer@yresolution",
                                            "region",
                                            "region@id",
                                            "region@xresolution",
                                            "region@yresolution",
                                            "region@x",
                                            "region@y",
                                            "region@xsize",
                                            "region@ysize",
                                            "region/frustum",
                                            "region/frustum/yaw",
                                            "region/frustum/pitch",
                                            "region/frustum/roll",
                                            "region/frustum/rightangle",
                                            "region/frustum/leftangle",
                                            "region/frustum/upangle",
                                            "region/frustum/downangle",
                                            "region/coordinateframe",
                                            "region/coordinateframe/posx",
                                            "region/coordinateframe/posy",
                                            "region/coordinateframe/posz",
                                            "region/coordinateframe/yawx",
                                            "region/coordinateframe/yawy",
                                            "region/coordinateframe/yawz",
                                            "region/coordinateframe/pitchx",
                                            "region/coordinateframe/pitchy",
                                            "region/coordinateframe/pitchz",
                                            "region/coordinateframe/rollx",
                                            "region/coordinateframe/rolly",
                                            "region/coordinateframe/rollz",
                                            "region/color",
                                            "region/color/decode",
                                            "region/color/decode@type",
                                            "region/color/decode@gamma",
                                            "region/color/encode",
                                            "region/color/encode@type",
                                            "region/color/encode@gamma",
                                            "region/color/correct",
                                            "region/color/correct@type",
                                            "mpcdi/files",
                                            "fileset",
                                            "fileset@region",
                                            "fileset/geometrywarpfile",
                                            "fileset/geometrywarpfile/path",
                                            "fileset/geometrywarpfile/geometricunit",
                                            "fileset/geometrywarpfile/originof3ddata",
                                            "fileset/geometrywarpfile/interpolation",
                                            "fileset/alphamap",
                                            "fileset/alphamap/path",
                                            "fileset/alphamap/bitdepth",
                                            "fileset/alphamap/componentdepth",
                                            "fileset/alphamap/gammaembedded",
                                            "fileset/betamap",
                                            "fileset/betamap/path",
                                            "fileset/betamap/bitdepth",
                                            "fileset/betamap/componentdepth",
                                            "fileset/distortionmap",
                                            "fileset/distortionmap/path",
                                            "mpcdi/extensionset"};
  return kKnown;
}

class MpcdiParser {
public:
  MpcdiParser(const std::string& xml, HallBuilder& builder) : xml_(xml), builder_(builder) {}

  std::optional<MpcdiDocument> run() {
    pugi::xml_document tree;
    const auto parsed = tree.load_buffer(xml_.data(), xml_.size());
    if (!parsed) {
      builder_.error(fmt::format("this is not sound XML: {}", parsed.description()), lineAt(parsed.offset));
      return std::nullopt;
    }
    const pugi::xml_node root = child(tree, "mpcdi");
    if (!root) {
      builder_.error("the element MPCDI is missing");
      return std::nullopt;
    }
    head(root);
    display(child(root, "display"));
    if (const auto files = child(root, "files")) fileSets(files);
    fileSets(root);  // one program writes them beside `files`
    if (const auto extensions = child(root, "extensionset")) readExtensions(extensions);
    nameUnknown(root, "", "mpcdi", 0);
    if (failed_) return std::nullopt;
    return std::move(read_);
  }

private:
  std::uint32_t lineAt(std::ptrdiff_t offset) const {
    if (offset < 0) return 0;
    const auto end =
        xml_.begin() + std::min<std::ptrdiff_t>(offset, static_cast<std::ptrdiff_t>(xml_.size()));
    return static_cast<std::uint32_t>(std::count(xml_.begin(), end, '\n') + 1);
  }
  std::uint32_t lineOf(const pugi::xml_node& node) const { return lineAt(node.offset_debug()); }

  void refuse(const pugi::xml_node& node, const std::string& why) {
    if (!failed_) builder_.error(fmt::format("<{}>: {}", printable(node.name(), 40), why), lineOf(node));
    failed_ = true;
  }

  static pugi::xml_node child(const pugi::xml_node& node, std::string_view name) {
    for (const pugi::xml_node& c : node.children())
      if (lower(c.name()) == name) return c;
    return {};
  }
  static std::string attribute(const pugi::xml_node& node, std::string_view name) {
    for (const pugi::xml_attribute& a : node.attributes())
      if (lower(a.name()) == name) return a.value();
    return {};
  }

  double number(const pugi::xml_node& node, std::string_view text, const std::string& what) {
    const auto value = NumberLine::numberIn(withoutBlanks(text));
    if (value && std::fabs(*value) < 1e7) return *value;
    refuse(node, fmt::format("{} must be a number below 1e7, not {}", what, quotedWord(text)));
    return 0;
  }
  double attributeNumber(const pugi::xml_node& node, std::string_view name) {
    return number(node, attribute(node, name), std::string(name));
  }
  double childNumber(const pugi::xml_node& node, std::string_view name) {
    const auto found = child(node, name);
    if (found) return number(found, found.text().get(), std::string(name));
    refuse(node, fmt::format("the element {} is missing", name));
    return 0;
  }
  static std::string childText(const pugi::xml_node& node, std::string_view name) {
    return std::string(withoutBlanks(child(node, name).text().get()));
  }

  void head(const pugi::xml_node& root) {
    read_.profile = attribute(root, "profile");
    static const std::set<std::string> kProfiles{"2d", "3d", "a3", "sl"};
    if (!kProfiles.contains(read_.profile))
      refuse(root,
             fmt::format("the profile {} is not known; known are 2d, 3d, a3, sl", quotedWord(read_.profile)));
    const std::string version = attribute(root, "version");
    if (version != "1.0" && version != "1.0a" && version != "2.0")
      builder_.warning(fmt::format("version {} is not known; it is read as 2.0", quotedWord(version)),
                       lineOf(root));
  }

  std::uint32_t pixels(const pugi::xml_node& node, std::string_view name) {
    const double value = attributeNumber(node, name);
    if (value >= 1 && value <= 16384 && value == std::floor(value)) return static_cast<std::uint32_t>(value);
    refuse(node, fmt::format("{} must be a whole number from 1 to 16384", name));
    return 0;
  }

  void display(const pugi::xml_node& display) {
    if (!display) return refuse(display, "the element display is missing");
    for (const pugi::xml_node& buffer : display.children()) {
      if (lower(buffer.name()) != "buffer") continue;
      const std::string id = attribute(buffer, "id");
      MpcdiBuffer& known = read_.buffers[id];
      if (!attribute(buffer, "xresolution").empty()) known.columns = pixels(buffer, "xresolution");
      if (!attribute(buffer, "yresolution").empty()) known.rows = pixels(buffer, "yresolution");
      for (const pugi::xml_node& region : buffer.children())
        if (lower(region.name()) == "region") readRegion(region, id);
    }
    if (read_.regions.empty()) refuse(display, "there is no region");
  }

  void readRegion(const pugi::xml_node& node, const std::string& buffer) {
    if (read_.regions.size() == kMostRegions) return refuse(node, "there are too many regions");
    MpcdiRegion region;
    region.id = attribute(node, "id");
    region.buffer = buffer;
    region.line = lineOf(node);
    region.columns = pixels(node, "xresolution");
    region.rows = pixels(node, "yresolution");
    region.x = attributeNumber(node, "x");
    region.y = attributeNumber(node, "y");
    region.width = attributeNumber(node, "xsize");
    region.height = attributeNumber(node, "ysize");
    if (!(region.width > 1e-6 && region.height > 1e-6) || region.width > 100 || region.height > 100 ||
        std::fabs(region.x) > 100 || std::fabs(region.y) > 100)
      refuse(node, "xsize and ysize must be above 0, and all of them at most 100");
    for (const MpcdiRegion& other : read_.regions)
      if (other.id == region.id) refuse(node, fmt::format("the id {} is given twice", quotedWord(region.id)));
    if (const auto frustum = child(node, "frustum")) region.frustum = readFrustum(frustum);
    if (const auto frame = child(node, "coordinateframe")) region.frame = readFrame(frame);
    if (const auto color = child(node, "color")) readColor(color, region);
    read_.regions.push_back(std::move(region));
  }

  MpcdiFrustum readFrustum(const pugi::xml_node& node) {
    MpcdiFrustum f;
    f.yaw = childNumber(node, "yaw");
    f.pitch = childNumber(node, "pitch");
    f.roll = childNumber(node, "roll");
    f.rightAngle = childNumber(node, "rightangle");
    f.leftAngle = childNumber(node, "leftangle");
    f.upAngle = childNumber(node, "upangle");
    f.downAngle = childNumber(node, "downangle");
    return f;
  }

  Vec3 vector(const pugi::xml_node& node, const std::string& name) {
    return {childNumber(node, name + "x"), childNumber(node, name + "y"), childNumber(node, name + "z")};
  }

  MpcdiFrame readFrame(const pugi::xml_node& node) {
    MpcdiFrame f{vector(node, "pos"), vector(node, "yaw"), vector(node, "pitch"), vector(node, "roll")};
    Mat3 axes;
    axes << f.pitch, f.roll, -f.yaw;
    const bool square = (axes.transpose() * axes - Mat3::Identity()).cwiseAbs().maxCoeff() < 1e-3;
    if (!failed_ && !square) refuse(node, "yaw, pitch and roll must be unit vectors at right angles");
    return f;
  }

  void readColor(const pugi::xml_node& node, MpcdiRegion& region) {
    const auto encode = child(node, "encode"), correct = child(node, "correct"),
               decode = child(node, "decode");
    const std::string type = lower(attribute(encode, "type")), of = lower(attribute(correct, "type"));
    if (type == "gamma") {
      region.encodeGamma = attributeNumber(encode, "gamma");
      if (!(*region.encodeGamma >= 0.1 && *region.encodeGamma <= 10))
        refuse(encode, "gamma must be from 0.1 to 10");
    } else if (!type.empty() && type != "none") {
      notUnderstood(encode, "region/color/encode type " + type);
    }
    if (!of.empty() && of != "none") notUnderstood(correct, "region/color/correct type " + of);
    // Pictures are drawn in linear light: a gamma to decode them has no use.
    const std::string by = lower(attribute(decode, "type"));
    if (!by.empty() && by != "none" && by != "gamma") notUnderstood(decode, "region/color/decode type " + by);
  }

  void fileSets(const pugi::xml_node& parent) {
    for (const pugi::xml_node& node : parent.children()) {
      if (lower(node.name()) != "fileset") continue;
      const std::string id = attribute(node, "region");
      const auto region =
          std::ranges::find_if(read_.regions, [&id](const MpcdiRegion& r) { return r.id == id; });
      if (region == read_.regions.end()) {
        refuse(node, fmt::format("there is no region {}", quotedWord(id)));
        continue;
      }
      readFiles(node, *region);
    }
  }

  void readFiles(const pugi::xml_node& node, MpcdiRegion& region) {
    region.hasFiles = true;
    MpcdiFiles& files = region.files;
    const auto warp = child(node, "geometrywarpfile"), alpha = child(node, "alphamap");
    files.warp = childText(warp, "path");
    files.unit = childText(warp, "geometricunit");
    files.origin = childText(warp, "originof3ddata");
    files.interpolation = childText(warp, "interpolation");
    files.alpha = childText(alpha, "path");
    files.beta = childText(child(node, "betamap"), "path");
    files.distortion = childText(child(node, "distortionmap"), "path");
    if (const auto gamma = child(alpha, "gammaembedded")) {
      files.alphaGamma = number(gamma, gamma.text().get(), "gammaEmbedded");
      if (!(files.alphaGamma >= 0.1 && files.alphaGamma <= 10))
        refuse(gamma, "gammaEmbedded must be from 0.1 to 10");
    }
  }

  void readExtensions(const pugi::xml_node& set) {
    for (const pugi::xml_node& node : set.children()) {
      const std::string name = attribute(node, "name");
      if (name == "Stadion")
        readOurs(node);
      else if (name == "BufferExtension")
        readLenses(node);
      else if (name == "MystiqueExtension")
        builder_.notOfHall("extension MystiqueExtension");
      else
        notUnderstood(node, fmt::format("the extension {}", quotedWord(name)));
    }
  }

  void readOurs(const pugi::xml_node& node) {
    MpcdiHallExtension extension;
    const auto definitions = child(node, "definitions");
    extension.hall = childText(definitions, "hall");
    for (const pugi::xml_node& part : definitions.children("standard")) {
      const std::string region = attribute(part, "region");
      extension.digests[region] = attribute(part, "digest");
      if (!attribute(part, "pixelaspect").empty()) {
        const double aspect = attributeNumber(part, "pixelaspect");
        if (!(aspect > 0.01 && aspect < 100)) refuse(part, "pixelAspect must be from 0.01 to 100");
        extension.pixelAspects[region] = aspect;
      }
    }
    if (!extension.hall.empty()) read_.extension = extension;
  }

  /// Lenses of Christie's programs, in an element for each region.
  void readLenses(const pugi::xml_node& node) {
    for (const pugi::xml_node& buffer : node.children())
      for (const pugi::xml_node& lens : buffer.children()) {
        const std::string id = attribute(lens, "id");
        const auto region =
            std::ranges::find_if(read_.regions, [&id](const MpcdiRegion& r) { return r.id == id; });
        if (region == read_.regions.end()) continue;
        for (const pugi::xml_node& part : lens.children()) {
          notUnderstood(part, fmt::format("the lens of {} in BufferExtension: {}", quotedWord(id),
                                          printable(part.name(), 40)));
          region->unknownLens = region->unknownLens || lower(part.name()) == "fisheye";
        }
      }
  }

  void notUnderstood(const pugi::xml_node& node, const std::string& what) {
    builder_.notUnderstood({builder_.file(), lineOf(node), 0}, what, "it has no effect");
  }

  void nameUnknown(const pugi::xml_node& node, const std::string& shown, const std::string& path,
                   std::size_t depth) {
    const std::string here = shown + "/" + printable(node.name(), 60);
    for (const pugi::xml_attribute& a : node.attributes())
      if (!knownPaths().contains(path + "@" + lower(a.name())))
        notUnderstood(node, here + " " + printable(a.name(), 60));
    for (const pugi::xml_node& c : node.children()) {
      if (c.type() != pugi::node_element) continue;
      const std::string name = lower(c.name());
      const std::string next = name == "region" && path == "mpcdi/display/buffer" ? "region"
                               : name == "fileset" && (path == "mpcdi/files" || path == "mpcdi")
                                   ? "fileset"
                                   : path + "/" + name;
      if (next == "mpcdi/extensionset") continue;
      if (!knownPaths().contains(next) || depth > kMostXmlDepth)
        notUnderstood(c, here + "/" + printable(c.name(), 60));
      else
        nameUnknown(c, here, next, depth + 1);
    }
  }

  const std::string& xml_;
  HallBuilder& builder_;
  MpcdiDocument read_;
  bool failed_ = false;
};

std::string textOf(const Vec3& v) {
  return fmt::format("{} {} {} ", v.x(), v.y(), v.z());
}

}  // namespace

std::string digestOf(const MpcdiRegion& region, const MpcdiContent& content) {
  std::string text =
      fmt::format("{} {} {} {} {} {} {} {} ", region.columns, region.rows, region.x, region.y, region.width,
                  region.height, region.encodeGamma.value_or(0), region.files.unit);
  if (const auto& f = region.frustum)
    text += fmt::format("{} {} {} {} {} {} {} ", f->yaw, f->pitch, f->roll, f->rightAngle, f->leftAngle,
                        f->upAngle, f->downAngle);
  if (const auto& f = region.frame)
    text += textOf(f->position) + textOf(f->yaw) + textOf(f->pitch) + textOf(f->roll);
  text += fmt::format("{} {} ", region.files.origin, region.files.alphaGamma);
  std::uint64_t digest = XXH3_64bits(text.data(), text.size());
  for (const std::string* bytes : {&content.warp, &content.alpha, &content.beta})
    digest = XXH3_64bits_withSeed(bytes->data(), bytes->size(), digest);
  return fmt::format("{:016x}", digest);
}

std::optional<MpcdiDocument> readMpcdiDocument(const std::string& xml, HallBuilder& builder) {
  return MpcdiParser(xml, builder).run();
}

}  // namespace stadion
