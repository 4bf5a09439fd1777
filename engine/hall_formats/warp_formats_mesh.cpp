/// Warp formats with triangles or with a view of their own: OBJ, SkySkan, Scalable, SCISS.

#include "engine/base/value_reader.h"
#include "engine/hall_formats/gl_axes.h"
#include "engine/hall_formats/number_line.h"
#include "engine/hall_formats/warp_formats.h"
#include "engine/plain_text/text_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace stadion {
namespace {

constexpr std::size_t kMostSkyskanSide = 8192;

/// Reads the places, source shares and faces of an OBJ file.
class ObjWarpReader {
public:
  ObjWarpReader(WarpSource& source, WarpFile& file) : source_(source), file_(file) {}

  bool run() {
    for (std::string_view line; source_.line(line);)
      if (!statement(line.substr(0, line.find('#')))) return false;
    for (const std::string& word : skipped_)
      source_.warn(fmt::format("{} lines are not understood and have no effect", quotedWord(word)));
    WarpMesh& mesh = file_.mesh;
    if (sources_.size() != mesh.vertices.size())
      return source_.refuseFile(
          fmt::format("the file has {} v lines and {} vt lines; a warp needs one vt line "
                      "for each v line",
                      mesh.vertices.size(), sources_.size()));
    for (std::size_t i = 0; i < sources_.size(); ++i) mesh.vertices[i].source = sources_[i];
    file_.ofWindow = true;
    return true;
  }

private:
  bool statement(std::string_view line) {
    NumberLine words(line);
    const std::string_view keyword = words.word();
    if (keyword == "v") return place(words);
    if (keyword == "vt") return texture(words);
    if (keyword == "f") return face(words);
    static constexpr std::string_view kNoShape[] = {"", "vn", "o", "g", "s", "usemtl", "mtllib"};
    if (std::ranges::find(kNoShape, keyword) == std::end(kNoShape) && skipped_.size() < 8)
      skipped_.insert(printable(keyword, 24));
    return true;
  }

  bool place(NumberLine& words) {
    double n[2];
    if (!words.numbers(n)) return source_.refuse("a v line must have numbers, such as: v -0.5 0.25 0");
    if (file_.mesh.vertices.size() == WarpMesh::kMostVertices)
      return source_.refuse("the mesh has too many vertices");
    WarpMesh::Vertex v;
    v.at = {0.5 + 0.5 * n[0], 0.5 - 0.5 * n[1]};
    file_.mesh.vertices.push_back(v);
    return true;
  }

  bool texture(NumberLine& words) {
    double n[2];
    if (!words.numbers(n)) return source_.refuse("a vt line must have two numbers, such as: vt 0.5 0.25");
    if (sources_.size() == WarpMesh::kMostVertices) return source_.refuse("the mesh has too many vt lines");
    sources_.emplace_back(n[0], 1 - n[1]);
    return true;
  }

  bool face(NumberLine& words) {
    std::array<std::uint32_t, 3> t{};
    std::size_t corners = 0;
    for (std::string_view word = words.word(); !word.empty(); word = words.word(), ++corners) {
      const auto number = NumberLine::numberIn(word.substr(0, word.find('/')));
      if (!number || *number < 1 || *number > static_cast<double>(file_.mesh.vertices.size()) ||
          *number != std::floor(*number))
        return source_.refuse(
            fmt::format("{} is no corner of a face; the file has {} v lines up to this line",
                        quotedWord(word), file_.mesh.vertices.size()));
      t[std::min<std::size_t>(corners, 2)] = static_cast<std::uint32_t>(*number) - 1;
      if (corners < 2) continue;
      if (file_.mesh.triangles.size() == WarpMesh::kMostTriangles)
        return source_.refuse("the mesh has too many triangles");
      file_.mesh.triangles.push_back(t);
      t[1] = t[2];
    }
    return corners >= 3 || source_.refuse("a face needs at least three corners, such as: f 1 2 3");
  }

  WarpSource& source_;
  WarpFile& file_;
  std::vector<Vec2> sources_;
  std::set<std::string> skipped_;
};

/// Reads the settings of a SkySkan file into `values`, then its vertices.
class SkyskanReader {
public:
  SkyskanReader(WarpSource& source, WarpFile& file) : source_(source), file_(file) {}

  bool run() {
    for (std::string_view line; source_.line(line);)
      if (line.find('=') != std::string_view::npos ? !setting(line) : !numbers(line)) return false;
    if (columns_ == 0) return source_.refuseFile("the line with columns and rows is missing");
    if (file_.mesh.vertices.size() != columns_ * rows_)
      return source_.refuseFile(fmt::format("the file has {} vertices instead of {} x {}",
                                            file_.mesh.vertices.size(), columns_, rows_));
    addGridTriangles(file_.mesh, columns_, rows_);
    return view();
  }

private:
  bool setting(std::string_view line) {
    const std::size_t equals = line.find('=');
    const std::string name(line.substr(0, equals));
    const auto value = NumberLine(line.substr(equals + 1)).number();
    if (!values_.contains(name))
      source_.warn(fmt::format("{} is not understood and has no effect", quotedWord(name)));
    else if (!value)
      return source_.refuse(fmt::format("{} must be a number", name));
    else
      values_[name] = *value;
    return true;
  }

  bool numbers(std::string_view line) {
    NumberLine words(line);
    if (columns_ == 0) {
      const auto columns = words.count(kMostSkyskanSide), rows = words.count(kMostSkyskanSide);
      if (!columns || !rows) return true;  // a heading
      if (*columns < 2 || *rows < 2 || *columns * *rows > WarpMesh::kMostVertices)
        return source_.refuse("columns and rows must be from 2 to 8192");
      columns_ = *columns;
      rows_ = *rows;
      return true;
    }
    double n[4];
    if (!words.numbers(n)) return source_.refuse("four numbers must stand here: x y u v");
    if (file_.mesh.vertices.size() == columns_ * rows_)
      return source_.refuse("there are more vertices than columns x rows");
    WarpMesh::Vertex v;
    v.at = {n[0], n[1]};
    v.source = {n[2] * tweak("U Tweak"), n[3] * tweak("V Tweak")};
    if (n[0] == -1 || n[1] == -1) v.at = Vec2::Constant(std::numeric_limits<double>::quiet_NaN());
    file_.mesh.vertices.push_back(v);
    return true;
  }

  double tweak(const char* name) const { return values_.at(name) > -1 ? values_.at(name) : 1; }

  bool view() {
    double across = values_.at("Horizontal FOV") * kDegree, up = values_.at("Vertical FOV") * kDegree;
    if (!(across > 0 && across < kPi))
      return source_.refuseFile("Horizontal FOV is missing or no angle of a flat picture");
    if (up <= 0) up = 2 * det::atan(1200.0 / 2048 * det::tan(across / 2));
    if (values_.at("Horizontal Tweak") > 0) across *= values_.at("Horizontal Tweak");
    if (values_.at("Vertical Tweak") > 0) up *= values_.at("Vertical Tweak");
    if (!(across < kPi && up < kPi))
      return source_.refuseFile("the view is wider than a flat picture can be");
    WarpView v;
    v.q_RP = turnAbout(2, -values_.at("Dome Azimuth")) * turnAbout(0, values_.at("Dome Elevation"));
    v.right = across / 2;
    v.left = -v.right;
    v.up = up / 2;
    v.down = -v.up;
    v.hasEye = true;
    file_.view = v;
    return true;
  }

  WarpSource& source_;
  WarpFile& file_;
  std::map<std::string, double> values_{{"Dome Azimuth", 0}, {"Dome Elevation", 0},   {"Horizontal FOV", 0},
                                        {"Vertical FOV", 0}, {"Horizontal Tweak", 1}, {"Vertical Tweak", 1},
                                        {"U Tweak", 1},      {"V Tweak", 1}};
  std::size_t columns_ = 0, rows_ = 0;
};

/// Reads an OpenMesh file of Scalable.
class ScalableReader {
public:
  ScalableReader(WarpSource& source, WarpFile& file) : source_(source), file_(file) {}

  bool run() {
    for (std::string_view line; source_.line(line);) {
      NumberLine words(line);
      const std::string keyword(words.word());
      if (keyword == "["                  ? !face(words)
          : NumberLine::numberIn(keyword) ? !vertex(line)
                                          : !setting(keyword, words))
        return false;
    }
    if (values_["VERTICES"] != static_cast<double>(file_.mesh.vertices.size()) ||
        values_["FACES"] != static_cast<double>(file_.mesh.triangles.size()))
      return source_.refuseFile(fmt::format("the file promises {} vertices and {} faces, and has {} and {}",
                                            values_["VERTICES"], values_["FACES"], file_.mesh.vertices.size(),
                                            file_.mesh.triangles.size()));
    return place() && view();
  }

private:
  bool setting(const std::string& keyword, NumberLine& words) {
    static const std::map<std::string, std::string_view> kWords{{"OPENMESH", "Version 1.1"},
                                                                {"MAPPING", "NORMALIZED"},
                                                                {"SAMPLING", "LINEAR"},
                                                                {"PROJECTION", "PERSPECTIVE"}};
    std::string_view text = words.rest();
    text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
    if (const auto known = kWords.find(keyword); known != kWords.end()) {
      if (text != known->second)
        source_.warn(fmt::format("{} {} is not understood; it is read as {}", keyword, quotedWord(text),
                                 known->second));
      return true;
    }
    if (keyword == "LABEL" || keyword == "SUBVERSION") return true;
    const auto known = values_.find(keyword);
    if (known == values_.end()) {
      source_.warn(fmt::format("{} is not understood and has no effect", quotedWord(keyword)));
      return true;
    }
    const auto value = words.number();
    if (!value) return source_.refuse(fmt::format("{} must be a number", keyword));
    known->second = *value;
    if (*value != 0 && (keyword.starts_with("APPLY_") || keyword.starts_with("FRUSTUM_EULER") ||
                        keyword == "DO_NO_WARP" || keyword == "USE_SPHERE_SAMPLE_COORDINATE_SYSTEM"))
      source_.warn(fmt::format("{} is not understood and has no effect", keyword));
    if (keyword == "GAMMA" && *value != 2.2)
      source_.warn("GAMMA has no effect; state the gamma of the projector in a .walls file");
    hasView_ = hasView_ || keyword == "PERSPECTIVE_LEFT" || keyword == "PERSPECTIVE_RIGHT" ||
               keyword == "PERSPECTIVE_TOP" || keyword == "PERSPECTIVE_BOTTOM";
    return true;
  }

  bool vertex(std::string_view line) {
    double n[5];
    if (!NumberLine(line).numbers(n)) return source_.refuse("a vertex must be five numbers: x y light s t");
    if (file_.mesh.vertices.size() == WarpMesh::kMostVertices)
      return source_.refuse("the mesh has too many vertices");
    WarpMesh::Vertex v;
    v.at = {n[0], n[1]};
    v.light = std::clamp(n[2] / 255, 0.0, 1.0);
    v.source = {1 - n[4], n[3]};
    file_.mesh.vertices.push_back(v);
    return true;
  }

  bool face(NumberLine& words) {
    std::array<std::uint32_t, 3> t{};
    for (std::uint32_t& corner : t) {
      const auto number = words.count(WarpMesh::kMostVertices);
      if (!number) return source_.refuse("a face must be three numbers of vertices: [ 0 1 2 ]");
      corner = static_cast<std::uint32_t>(*number);
    }
    if (file_.mesh.triangles.size() == WarpMesh::kMostTriangles)
      return source_.refuse("the mesh has too many triangles");
    file_.mesh.triangles.push_back(t);
    return true;
  }

  /// Turns pixels into shares of the output.
  bool place() {
    const double width = values_["NATIVEXRES"], height = values_["NATIVEYRES"];
    const double left = values_["ORTHO_LEFT"], bottom = values_["ORTHO_BOTTOM"];
    const double across = values_["ORTHO_RIGHT"] - left, up = values_["ORTHO_TOP"] - bottom;
    if (!(width > 0 && height > 0) || across == 0 || up == 0)
      return source_.refuseFile(
          "NATIVEXRES and NATIVEYRES must be above 0, and the ORTHO_ rectangle have an area");
    for (WarpMesh::Vertex& v : file_.mesh.vertices)
      v.at = {(v.at.x() / width - left) / across, 1 - (v.at.y() / height - bottom) / up};
    return true;
  }

  bool view() {
    if (!hasView_) return true;
    WarpView v;
    v.left = values_["PERSPECTIVE_LEFT"] * kDegree;
    v.right = values_["PERSPECTIVE_RIGHT"] * kDegree;
    v.up = values_["PERSPECTIVE_TOP"] * kDegree;
    v.down = values_["PERSPECTIVE_BOTTOM"] * kDegree;
    v.q_RP = fromGlAxes(turnAbout(2, values_["PERSPECTIVE_ROLL"]) * turnAbout(1, values_["PERSPECTIVE_YAW"]) *
                        turnAbout(0, values_["PERSPECTIVE_PITCH"]));
    file_.view = v;
    const bool moved = values_["PERSPECTIVE_XOFFSET"] != 0 || values_["PERSPECTIVE_YOFFSET"] != 0 ||
                       values_["PERSPECTIVE_ZOFFSET"] != 0;
    if (moved)
      source_.warn("PERSPECTIVE_XOFFSET, _YOFFSET and _ZOFFSET are not understood and have no effect");
    return true;
  }

  WarpSource& source_;
  WarpFile& file_;
  bool hasView_ = false;
  std::map<std::string, double> values_{{"VERTICES", 0},
                                        {"FACES", 0},
                                        {"ORTHO_LEFT", 0},
                                        {"ORTHO_RIGHT", 1},
                                        {"ORTHO_TOP", 1},
                                        {"ORTHO_BOTTOM", 0},
                                        {"PERSPECTIVE_XOFFSET", 0},
                                        {"PERSPECTIVE_YOFFSET", 0},
                                        {"PERSPECTIVE_ZOFFSET", 0},
                                        {"PERSPECTIVE_ROLL", 0},
                                        {"PERSPECTIVE_PITCH", 0},
                                        {"PERSPECTIVE_YAW", 0},
                                        {"PERSPECTIVE_LEFT", 0},
                                        {"PERSPECTIVE_RIGHT", 0},
                                        {"PERSPECTIVE_TOP", 0},
                                        {"PERSPECTIVE_BOTTOM", 0},
                                        {"NATIVEXRES", 0},
                                        {"NATIVEYRES", 0},
                                        {"GAMMA", 2.2},
                                        {"DO_NO_WARP", 0},
                                        {"USE_SPHERE_SAMPLE_COORDINATE_SYSTEM", 0},
                                        {"FRUSTUM_EULER_ANGLES", 0},
                                        {"FRUSTUM_EULER_YAW", 0},
                                        {"FRUSTUM_EULER_PITCH", 0},
                                        {"FRUSTUM_EULER_ROLL", 0},
                                        {"APPLY_MASK", 0},
                                        {"APPLY_BLACK_LEVEL", 0},
                                        {"APPLY_COLOR", 0}};
};

struct ScissHead {
  char name[3];
  std::uint8_t version;
  std::uint32_t mapping;  ///< 0 = planar
  float rotation[4];      ///< x y z w, in axes of OpenGL
  float eye[3];
  float up, down, left, right;  ///< [degrees]
  std::uint32_t size[2];        ///< version 1: columns, rows; 2: kind of triangles as in OpenGL, vertices
};
static_assert(sizeof(ScissHead) == 60);

struct ScissVertex {
  float at[3], source[3];
};

WarpView scissView(const ScissHead& head) {
  WarpView view;
  const Quat q(head.rotation[3], head.rotation[0], head.rotation[1], head.rotation[2]);
  view.q_RP = q.norm() > 1e-6 ? fromGlAxes(q.normalized()) : Quat::Identity();
  view.up = std::fabs(static_cast<double>(head.up)) * kDegree;
  view.down = -std::fabs(static_cast<double>(head.down)) * kDegree;
  view.left = -std::fabs(static_cast<double>(head.left)) * kDegree;
  view.right = std::fabs(static_cast<double>(head.right)) * kDegree;
  view.eye = fromGlAxes(Vec3(head.eye[0], head.eye[1], head.eye[2]));
  view.hasEye = true;
  return view;
}

bool finiteFloats(const float* values, std::size_t count) {
  return std::all_of(values, values + count, [](float v) { return std::isfinite(v) && std::fabs(v) < 1e6F; });
}

void addScissTriangles(WarpMesh& mesh, const std::vector<std::uint32_t>& corners, bool strip) {
  if (!strip) {
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
      mesh.triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
    return;
  }
  for (std::size_t i = 0; i + 2 < corners.size(); ++i)
    mesh.triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
}

}  // namespace

bool WarpSource::line(std::string_view& taken) {
  while (!rest_.empty()) {
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    ++line_;
    taken = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    if (taken.ends_with('\r')) taken.remove_suffix(1);
    if (taken.find_first_not_of(" \t\r") != std::string_view::npos) return true;
  }
  return false;
}

bool WarpSource::refuse(std::string why) {
  out_.error({file_, line_, 0}, std::move(why));
  return false;
}

bool WarpSource::refuseFile(std::string why) {
  out_.error({file_, 0, 0}, std::move(why));
  return false;
}

void WarpSource::warn(std::string what) {
  if (++warnings_ <= kMostWarnings) out_.warning({file_, line_, 0}, std::move(what));
}

bool readObjWarp(WarpSource& source, WarpFile& file) {
  return ObjWarpReader(source, file).run();
}

bool readSkyskanWarp(WarpSource& source, WarpFile& file) {
  return SkyskanReader(source, file).run();
}

bool readScalableWarp(WarpSource& source, WarpFile& file) {
  return ScalableReader(source, file).run();
}

bool readScissWarp(WarpSource& source, WarpFile& file) {
  ValueReader bytes(std::as_bytes(std::span(source.rest())));
  ScissHead head{};
  if (!bytes.get(head) || std::string_view(head.name, 3) != "SGC")
    return source.refuseFile("this is not an SGC file; one begins with the letters SGC");
  if (head.version != 1 && head.version != 2)
    return source.refuseFile(
        fmt::format("version {} of the format is not read; known are 1 and 2", head.version));
  if (head.mapping != 0)
    return source.refuseFile("the file warps a cube map; only flat sources (mapping 0) are read");
  if (!finiteFloats(head.rotation, 11))
    return source.refuseFile("the view of the file is not made of numbers");
  const std::uint64_t count = head.version == 2 ? head.size[1] : std::uint64_t{head.size[0]} * head.size[1];
  std::vector<ScissVertex> vertices;
  std::uint32_t cornerCount = 0;
  std::vector<std::uint32_t> corners;
  if (count > WarpMesh::kMostVertices || !bytes.get(vertices, count) || !bytes.get(cornerCount) ||
      cornerCount > WarpMesh::kMostTriangles || !bytes.get(corners, cornerCount))
    return source.refuseFile("the file ends too early; copy it again");
  for (const ScissVertex& v : vertices) {
    if (!finiteFloats(v.at, 6)) return source.refuseFile("a vertex is not made of numbers");
    WarpMesh::Vertex vertex;
    vertex.at = Vec2(v.at[0], v.at[1]).cwiseMax(0).cwiseMin(1);
    vertex.source = Vec2(v.source[0], 1 - v.source[1]).cwiseMax(0).cwiseMin(1);
    file.mesh.vertices.push_back(vertex);
  }
  addScissTriangles(file.mesh, corners, head.version != 2 || head.size[0] != 4);
  file.view = scissView(head);
  return true;
}

}  // namespace stadion
