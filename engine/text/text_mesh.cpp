#include "engine/text/text_mesh.h"

#include "engine/asset/mesh_checks.h"
#include "engine/text/glyph_outline.h"
#include "engine/text/glyphs.h"

#include <algorithm>

namespace stadion {
namespace {

constexpr double kMargin = 50;     // of the board around the letters [hundredths of a capital]
constexpr double kGap = 5;         // between flat letters and the board, so that depths differ far away
constexpr double kThickness = 15;  // of the board
constexpr float kShade = 0.45f;    // of the letters' sides, beside their front

/// A corner of the mesh: x and z in the text's plane, y into its depth.
struct Corner {
  double x, y, z;
};

class MeshWriter {
public:
  explicit MeshWriter(double unit) : unit_(unit) {}

  /// Two triangles, counter-clockwise as seen from where `normal` points.
  void quad(const Corner& a, const Corner& b, const Corner& c, const Corner& d, const Vec3& normal) {
    const auto first = static_cast<std::uint32_t>(mesh_->positions.size());
    for (const Corner& p : {a, b, c, d}) {
      mesh_->positions.push_back({static_cast<float>(p.x * unit_), static_cast<float>(p.y * unit_),
                                  static_cast<float>(p.z * unit_)});
      mesh_->normals.push_back(
          {static_cast<float>(normal.x()), static_cast<float>(normal.y()), static_cast<float>(normal.z())});
    }
    for (const std::uint32_t i : {0U, 1U, 2U, 0U, 2U, 3U}) mesh_->indices.push_back(first + i);
  }
  /// What has been written since the last time is of this material.
  void endPart(Material material) {
    const auto end = static_cast<std::uint32_t>(mesh_->indices.size());
    if (end == begun_) return;
    mesh_->submeshes.push_back({begun_, end - begun_, static_cast<std::uint32_t>(mesh_->materials.size())});
    mesh_->materials.push_back(std::move(material));
    begun_ = end;
  }
  std::unique_ptr<Mesh> finish() {
    if (mesh_->indices.empty()) return nullptr;
    mesh_->name = "text";
    stadion::finish(*mesh_);
    return std::move(mesh_);
  }

private:
  double unit_;  ///< [m]
  std::unique_ptr<Mesh> mesh_ = std::make_unique<Mesh>();
  std::uint32_t begun_ = 0;
};

Material painted(const std::array<float, 3>& colour, bool lit, float shade = 1) {
  const std::array<float, 3> c{colour[0] * shade, colour[1] * shade, colour[2] * shade};
  Material m;
  m.roughness = 1;
  if (lit) {
    m.baseColour = {c[0], c[1], c[2], 1};
  } else {
    m.baseColour = {0, 0, 0, 1};
    m.emissive = c;
    m.metallic = 1;  // black metal: no light adds to its own
  }
  return m;
}

/// Somewhere on the text: a stroke, moved there.
struct PlacedBand {
  Band band;
  double x = 0, y = 0;
};

/// One line's strokes, and how wide it is.
double layLine(const std::vector<char32_t>& line, double y, std::vector<PlacedBand>& out) {
  double x = 0;
  const Glyph* before = nullptr;
  for (const char32_t c : line) {
    const DrawnCharacter d = drawn(c);
    if (before) x += kerning(*before, *d.glyph);
    for (Band& b : bandsOf(d.glyph->path)) out.push_back({std::move(b), x, y});
    for (Band& b : bandsOf(pathOfMark(d.mark)))
      out.push_back({std::move(b), x + d.glyph->advance / 2, y + (d.raised ? kMarkRise : 0)});
    x += d.glyph->advance;
    before = d.glyph;
  }
  return x;
}

struct Laid {
  std::vector<PlacedBand> bands;
  double left = 0, right = 0, bottom = 0;
};

Laid layText(std::string_view utf8, TextAlign align) {
  Laid laid;
  std::vector<char32_t> line;
  double y = 0;
  const auto endLine = [&] {
    const std::size_t first = laid.bands.size();
    const double width = layLine(line, y, laid.bands);
    const double shift = align == TextAlign::Left ? 0 : align == TextAlign::Centre ? -width / 2 : -width;
    for (std::size_t i = first; i < laid.bands.size(); ++i) laid.bands[i].x += shift;
    laid.left = std::min(laid.left, shift);
    laid.right = std::max(laid.right, shift + width);
    laid.bottom = y;
    y -= kLineHeight;
    line.clear();
  };
  for (const char32_t c : charactersOf(utf8.substr(0, kLongestWords)))
    c == U'\n' ? endLine() : line.push_back(c);
  endLine();
  return laid;
}

/// The face that is read, in the plane y = `depth`.
void writeFront(const PlacedBand& placed, double depth, bool towardsReader, MeshWriter& out) {
  const auto& [left, right, closed] = placed.band;
  const auto at = [&](const GlyphPoint& p) { return Corner{placed.x + p.x, depth, placed.y + p.y}; };
  for (std::size_t i = 0; i + (closed ? 0 : 1) < left.size(); ++i) {
    const std::size_t next = (i + 1) % left.size();
    if (towardsReader)
      out.quad(at(left[i]), at(right[i]), at(right[next]), at(left[next]), -Vec3::UnitY());
    else
      out.quad(at(left[next]), at(right[next]), at(right[i]), at(left[i]), Vec3::UnitY());
  }
}

/// The sides of a stroke, from the front back to `depth`.
void writeSides(const PlacedBand& placed, double depth, MeshWriter& out) {
  const auto& [left, right, closed] = placed.band;
  const auto wall = [&](const GlyphPoint& a, const GlyphPoint& b) {  // the outside is right of a to b
    const Vec3 normal = Vec3(b.y - a.y, 0, a.x - b.x).stableNormalized();
    out.quad({placed.x + a.x, 0, placed.y + a.y}, {placed.x + a.x, depth, placed.y + a.y},
             {placed.x + b.x, depth, placed.y + b.y}, {placed.x + b.x, 0, placed.y + b.y}, normal);
  };
  for (std::size_t i = 0; i + (closed ? 0 : 1) < left.size(); ++i) {
    const std::size_t next = (i + 1) % left.size();
    wall(right[i], right[next]);
    wall(left[next], left[i]);
  }
  if (closed) return;
  wall(left.front(), right.front());
  wall(right.back(), left.back());
}

void writeBoard(const Laid& laid, double front, MeshWriter& out) {
  const double x0 = laid.left - kMargin, x1 = laid.right + kMargin;
  const double z0 = laid.bottom - kDescent / 2 - kMargin, z1 = 100 + kMargin;
  const double y0 = front, y1 = front + kThickness;
  out.quad({x0, y0, z0}, {x1, y0, z0}, {x1, y0, z1}, {x0, y0, z1}, -Vec3::UnitY());
  out.quad({x1, y1, z0}, {x0, y1, z0}, {x0, y1, z1}, {x1, y1, z1}, Vec3::UnitY());
  out.quad({x0, y1, z0}, {x0, y0, z0}, {x0, y0, z1}, {x0, y1, z1}, -Vec3::UnitX());
  out.quad({x1, y0, z0}, {x1, y1, z0}, {x1, y1, z1}, {x1, y0, z1}, Vec3::UnitX());
  out.quad({x0, y0, z1}, {x1, y0, z1}, {x1, y1, z1}, {x0, y1, z1}, Vec3::UnitZ());
  out.quad({x0, y1, z0}, {x1, y1, z0}, {x1, y0, z0}, {x0, y0, z0}, -Vec3::UnitZ());
}

}  // namespace

std::unique_ptr<Mesh> textMesh(std::string_view utf8, const TextStyle& style) {
  const Laid laid = layText(utf8, style.align);
  const double unit = style.size / 100, depth = style.depth / unit;
  MeshWriter out(unit);
  if (laid.bands.empty()) return nullptr;
  for (const PlacedBand& b : laid.bands) writeFront(b, 0, true, out);
  out.endPart(painted(style.colour, style.lit));
  if (style.depth > 0) {
    for (const PlacedBand& b : laid.bands) {
      writeSides(b, depth, out);
      writeFront(b, depth, false, out);
    }
    out.endPart(painted(style.colour, style.lit, kShade));
  }
  if (style.background) {
    writeBoard(laid, std::max(depth, kGap), out);
    out.endPart(painted(*style.background, true));
  }
  return out.finish();
}

std::string unescaped(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char next = text[i] == '\\' && i + 1 < text.size() ? text[i + 1] : '\0';
    const bool escape = next == 'n' || next == ',';
    out += next == 'n' ? '\n' : escape ? next : text[i];
    i += escape;
  }
  return out;
}

}  // namespace stadion
