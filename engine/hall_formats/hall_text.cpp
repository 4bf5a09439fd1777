#include "engine/hall_formats/hall_text.h"

#include "engine/base/atomic_file.h"
#include "engine/colour_table/cube_file.h"
#include "engine/hall_formats/light_map_file.h"
#include "engine/maths/functions.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <filesystem>

namespace stadion {
namespace {

std::string meshAsObj(const MeshScreen& mesh) {
  std::string text;
  for (const Vec3& p : mesh.points) text += fmt::format("v {} {} {}\n", p.x(), p.y(), p.z());
  for (const auto& t : mesh.triangles) text += fmt::format("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
  return text;
}

LightMap linear(LightMap map) {
  if (map.gamma == 1) return map;
  for (std::uint16_t& v : map.values)
    if (v > 0) v = static_cast<std::uint16_t>(std::lround(65535 * det::pow(v / 65535.0, map.gamma)));
  map.gamma = 1;
  return map;
}

/// Gives the files of one projector names, and remembers their contents.
std::optional<Diagnostic> nameFilesOf(WallEntry& entry, const std::string& prefix, bool masksElsewhere,
                                      HallText& made) {
  Projector& p = *entry.projector;
  const std::string stem = prefix + entry.wall.name;
  if (auto* image = std::get_if<MeasuredImage>(&p.image)) {
    image->file = stem + "-warp.pfm";
    made.files[image->file] = pointsAsPfm(image->points, image->columns, image->rows);
  }
  if (p.blend.alpha) {
    p.blend.mask = stem + "-mask.png";
    if (!masksElsewhere) {
      const auto png = lightMapAsPng(linear(*p.blend.alpha));
      if (!png) return png.error();
      made.files[p.blend.mask] = png.value();
    }
  }
  if (p.lut && !p.lut->table.empty()) {
    p.lut->file = stem + "-lut.cube";
    made.files[p.lut->file] = formatCube(p.lut->table);
  }
  if (p.blend.beta)
    made.lost.push_back(fmt::format("projector \"{}\": its black level map", entry.wall.name));
  return std::nullopt;
}

}  // namespace

std::string pointsAsPfm(const std::vector<Vec3>& points, std::uint32_t columns, std::uint32_t rows) {
  std::string bytes = fmt::format("PF\n{} {}\n-1.0\n", columns, rows);
  bytes.reserve(bytes.size() + points.size() * 12);
  for (std::size_t row = rows; row-- > 0;)
    for (std::size_t column = 0; column < columns; ++column)
      for (int axis = 0; axis < 3; ++axis) {
        const auto bits =
            std::bit_cast<std::uint32_t>(static_cast<float>(points[row * columns + column][axis]));
        for (int byte = 0; byte < 4; ++byte) bytes += static_cast<char>(bits >> (8 * byte) & 255);
      }
  return bytes;
}

Result<HallText> hallText(const WallFile& hall, const std::string& prefix, bool masksElsewhere) {
  WallFile named = hall;
  named.metresPerUnit = 1;
  HallText made;
  for (Screen& screen : named.screens)
    if (auto* mesh = std::get_if<MeshScreen>(&screen.surface)) {
      mesh->file = prefix + screen.name + "-screen.obj";
      made.files[mesh->file] = meshAsObj(*mesh);
    }
  for (WallEntry& entry : named.walls)
    if (entry.projector)
      if (auto fault = nameFilesOf(entry, prefix, masksElsewhere, made)) return *fault;
  made.text = formatWalls(named);
  return made;
}

std::optional<Diagnostic> writeHallText(const WallFile& hall, const std::string& path, Diagnostics& out) {
  const std::filesystem::path target(path);
  const auto made = hallText(hall, target.stem().string() + "-");
  if (!made) return made.error();
  for (const std::string& lost : made.value().lost)
    out.warning({path, 0, 0},
                lost + " cannot be said in a wall file and is lost; write an .mpcdi file to keep it");
  for (const auto& [name, bytes] : made.value().files)
    if (auto fault = writeFile((target.parent_path() / name).string(), bytes)) return fault;
  return writeFile(path, made.value().text);
}

}  // namespace stadion
