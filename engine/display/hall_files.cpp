#include "engine/display/wall_file.h"

#include "engine/base/plain_file.h"
#include "engine/colour_table/cube_file.h"
#include "engine/display/covered_rectangle.h"
#include "engine/display/screen_mesh.h"

#include <fmt/format.h>

#include <filesystem>

namespace stadion {
namespace {

constexpr std::size_t kMostObjBytes = 256U << 20;
constexpr std::size_t kMostPfmBytes = kMaxGridPoints * 12 + 4096;

class HallFiles {
public:
  HallFiles(WallFile& hall, Diagnostics& out)
      : hall_(hall), folder_(std::filesystem::path(hall.file).parent_path()), out_(out) {}

  void load() {
    for (Screen& screen : hall_.screens)
      if (auto* mesh = std::get_if<MeshScreen>(&screen.surface))
        loadMesh(*mesh, {{hall_.file, screen.line, screen.column}, screen.excerpt});
    for (WallEntry& entry : hall_.walls) {
      if (!entry.projector) continue;
      const Namer namer{{hall_.file, entry.line, entry.column}, entry.excerpt};
      if (auto* image = std::get_if<MeasuredImage>(&entry.projector->image)) loadWarp(*image, namer);
      if (entry.projector->lut) loadTable(*entry.projector->lut, namer);
    }
  }

private:
  struct Namer {
    SourcePosition where;
    std::string excerpt;
  };

  std::string pathOf(const std::string& file) const { return (folder_ / file).string(); }

  std::optional<std::string> bytesOf(const std::string& file, std::size_t limit, const Namer& namer) {
    Result<std::string> bytes = readPlainFile(pathOf(file), limit);
    if (bytes) return std::move(bytes.value());
    out_.error(namer.where, fmt::format("{}: {}", pathOf(file), bytes.error().message), namer.excerpt);
    return std::nullopt;
  }

  void loadMesh(MeshScreen& mesh, const Namer& namer) {
    const std::string file = mesh.file;
    const bool grid = file.ends_with(".pfm");
    const auto bytes = bytesOf(file, grid ? kMostPfmBytes : kMostObjBytes, namer);
    if (!bytes) return;
    std::optional<MeshScreen> read;
    if (!grid)
      read = readObjMesh(*bytes, pathOf(file), hall_.metresPerUnit, out_);
    else if (const auto points = readPointGrid(*bytes, pathOf(file), hall_.metresPerUnit, out_))
      read = meshOfGrid(*points, pathOf(file), out_);
    if (!read) return;
    mesh = std::move(*read);
    mesh.file = file;
  }

  void loadWarp(MeasuredImage& image, const Namer& namer) {
    const auto bytes = bytesOf(image.file, kMostPfmBytes, namer);
    if (!bytes) return;
    auto grid = readPointGrid(*bytes, pathOf(image.file), hall_.metresPerUnit, out_);
    if (!grid) return;
    image.columns = grid->columns;
    image.rows = grid->rows;
    image.points = std::move(grid->points);
  }

  void loadTable(ProjectorLut& lut, const Namer& namer) {
    const auto bytes = bytesOf(lut.file, kMostCubeBytes, namer);
    if (!bytes) return;
    if (auto table = readCube(*bytes, pathOf(lut.file), out_)) lut.table = std::move(*table);
  }

  WallFile& hall_;
  std::filesystem::path folder_;
  Diagnostics& out_;
};

}  // namespace

bool loadHallFiles(WallFile& hall, Diagnostics& out) {
  Diagnostics found;
  HallFiles(hall, found).load();
  out.append(found);
  if (found.hasErrors()) return false;
  placeRectangles(hall);
  return true;
}

}  // namespace stadion
