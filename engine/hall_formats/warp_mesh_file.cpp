#include "engine/hall_formats/warp_mesh_file.h"

#include "engine/hall_formats/warp_formats.h"
#include "engine/plain_text/text_line.h"

#include <fmt/format.h>

namespace stadion {
namespace {

struct WarpFormat {
  std::string_view ending;
  bool (*read)(WarpSource& source, WarpFile& file);
};

constexpr WarpFormat kWarpFormats[] = {
    {".data", readPaulBourkeWarp},    {".obj", readObjWarp},       {".pfm", readPfmWarp},
    {".csv", readDomeprojectionWarp}, {".simcad", readSimcadWarp}, {".skyskan", readSkyskanWarp},
    {".txt", readSkyskanWarp},        {".ol", readScalableWarp},   {".sgc", readScissWarp}};

/// Returns what is wrong with the numbers of a mesh, if anything is.
std::string faultOf(const WarpMesh& mesh) {
  if (mesh.vertices.empty() || mesh.triangles.empty()) return "the mesh has no triangle";
  for (const auto& t : mesh.triangles)
    for (const std::uint32_t corner : t)
      if (corner >= mesh.vertices.size())
        return fmt::format("a triangle has the corner {}, and the mesh has {} vertices", corner,
                           mesh.vertices.size());
  for (const WarpMesh::Vertex& v : mesh.vertices)
    if (v.at.allFinite() && !(v.at.cwiseAbs().maxCoeff() < 1e6 && v.source.cwiseAbs().maxCoeff() < 1e6))
      return "a vertex of the mesh is very far from the picture";
  return {};
}

}  // namespace

std::optional<WarpFile> readWarpFile(std::string_view bytes, const std::string& file, double aspect,
                                     Diagnostics& out) {
  const auto format = std::ranges::find_if(
      kWarpFormats, [&file](const WarpFormat& f) { return std::string_view(file).ends_with(f.ending); });
  WarpSource source(bytes, file, aspect, out);
  if (format == std::end(kWarpFormats)) {
    source.refuse(fmt::format("this kind of warp file is not read; known are {}", warpFileEndings()));
    return std::nullopt;
  }
  WarpFile read;
  if (!format->read(source, read)) return std::nullopt;
  const std::string fault = faultOf(read.mesh);
  if (fault.empty()) return read;
  source.refuseFile(fault);
  return std::nullopt;
}

std::string warpFileEndings() {
  std::string all;
  for (const WarpFormat& format : kWarpFormats) {
    if (!all.empty()) all += ", ";
    all += format.ending;
  }
  return all;
}

}  // namespace stadion
