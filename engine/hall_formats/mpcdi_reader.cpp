#include "engine/hall_formats/mpcdi_reader.h"

#include "engine/colour_table/cube_file.h"
#include "engine/display/lens_turn.h"
#include "engine/display/screen_mesh.h"
#include "engine/hall_formats/light_map_file.h"
#include "engine/hall_formats/mpcdi_axes.h"
#include "engine/hall_formats/share_grid.h"
#include "engine/hall_formats/source_view.h"
#include "engine/hall_formats/zip_archive.h"
#include "engine/maths/angles.h"
#include "engine/maths/functions.h"
#include "engine/plain_text/text_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace stadion {
namespace {

constexpr std::size_t kMostXmlBytes = 8U << 20;
constexpr std::size_t kMostWarpBytes = 256U << 20;
constexpr std::uint32_t kMeshPointsASide = 128;  ///< of a region, in the screen that it adds to
constexpr double kCanvasHeight = 2;              ///< [m]
constexpr double kCanvasDistance = 2.5;          ///< from the visitor's eye [m]

double metresOf(const std::string& unit) {
  static const std::map<std::string, double> kUnits{{"mm", 0.001},  {"cm", 0.01},   {"dm", 0.1},   {"m", 1},
                                                    {"in", 0.0254}, {"ft", 0.3048}, {"yd", 0.9144}};
  const auto known = kUnits.find(unit);
  return known == kUnits.end() ? 1 : known->second;
}

void turnRowsOver(PointGrid& grid) {
  for (std::uint32_t row = 0; row < grid.rows / 2; ++row) {
    const auto top = grid.points.begin() + std::ptrdiff_t{row} * grid.columns;
    const auto low = grid.points.begin() + std::ptrdiff_t{grid.rows - 1 - row} * grid.columns;
    std::swap_ranges(top, top + grid.columns, low);
  }
}

/// Sums `handedness` of the steps to the right and down over all cells of the grid.
template <class Handedness>
double sumOverCells(const PointGrid& grid, const Handedness& handedness) {
  double sum = 0;
  for (std::size_t row = 0; row + 1 < grid.rows; ++row)
    for (std::size_t column = 0; column + 1 < grid.columns; ++column) {
      const std::size_t at = row * grid.columns + column;
      const Vec3 &p = grid.points[at], &right = grid.points[at + 1], &below = grid.points[at + grid.columns];
      if (p.allFinite() && right.allFinite() && below.allFinite()) sum += handedness(p, right - p, below - p);
    }
  return sum;
}

/// Takes every n-th point, so that a screen of many regions stays small.
PointGrid thinned(const PointGrid& grid) {
  const auto pick = [](std::uint32_t i, std::uint32_t picked, std::uint32_t count) {
    return std::size_t{i} * (count - 1) / (picked - 1);
  };
  PointGrid result;
  result.columns = std::min(grid.columns, kMeshPointsASide);
  result.rows = std::min(grid.rows, kMeshPointsASide);
  for (std::uint32_t row = 0; row < result.rows; ++row)
    for (std::uint32_t column = 0; column < result.columns; ++column)
      result.points.push_back(grid.points[pick(row, result.rows, grid.rows) * grid.columns +
                                          pick(column, result.columns, grid.columns)]);
  return result;
}

class MpcdiReader {
public:
  MpcdiReader(HallBuilder& builder, const NeighbourFiles& files) : builder_(builder), files_(files) {}

  void run(const MpcdiDocument& document) {
    document_ = &document;
    for (const MpcdiRegion& region : document.regions) content(region);
    if (failed_) return;
    if (document.extension && readExtension(*document.extension)) return;
    for (const MpcdiRegion& region : document.regions) {
      if (document.profile == "2d")
        onCanvas(region);
      else if (document.profile == "3d" && !region.frame)
        inFixedView(region);
      else if (!region.files.warp.empty() && document.profile != "3d")
        measured(region);
      else
        throughLens(region);
      if (failed_) return;
    }
    for (auto& [buffer, number] : meshScreens_)
      builder_.hall().screens[number].surface = std::move(meshes_[buffer]);
  }

private:
  void refuse(const MpcdiRegion& region, const std::string& why) {
    if (!failed_) builder_.error(fmt::format("region {}: {}", quotedWord(region.id), why), region.line);
    failed_ = true;
  }
  void warn(const MpcdiRegion& region, const std::string& what) {
    builder_.warning(fmt::format("region {}: {}", quotedWord(region.id), what), region.line);
  }

  /// Reads the files of the region.
  void content(const MpcdiRegion& region) {
    MpcdiContent& c = contents_[region.id];
    for (const auto& [name, bytes, limit] : {std::tuple(&region.files.warp, &c.warp, kMostWarpBytes),
                                             std::tuple(&region.files.alpha, &c.alpha, kMostLightMapBytes),
                                             std::tuple(&region.files.beta, &c.beta, kMostLightMapBytes)}) {
      if (name->empty() || failed_) continue;
      auto read = files_(*name, limit);
      if (!read) return refuse(region, read.error().message);
      *bytes = std::move(read.value());
    }
    if (!region.files.distortion.empty())
      warn(region,
           fmt::format("the lens distortion map {} has no effect", quotedWord(region.files.distortion)));
    if (region.files.interpolation == "smooth" || region.files.interpolation == "keystone")
      warn(region, fmt::format("interpolation {} is not understood; points are interpolated linearly",
                               region.files.interpolation));
  }

  WallEntry entryOf(const MpcdiRegion& region) const {
    WallEntry entry;
    entry.wall.name = region.id;
    entry.pixels = {region.columns, region.rows};
    entry.line = region.line;
    return entry;
  }

  std::optional<LightMap> lightMap(const MpcdiRegion& region, const std::string& name,
                                   const std::string& png) {
    if (name.empty()) return std::nullopt;
    auto read = readLightMap(png);
    if (!read) {
      refuse(region, fmt::format("{}: {}", quotedWord(name), read.error().message));
      return std::nullopt;
    }
    if (read.value().hadOpacity)
      warn(region, fmt::format("the opacity in {} has no effect", quotedWord(name)));
    read.value().map.gamma = region.files.alphaGamma;
    return std::move(read.value().map);
  }

  void lights(const MpcdiRegion& region, Projector& projector) {
    const MpcdiContent& c = contents_[region.id];
    projector.blend.alpha = lightMap(region, region.files.alpha, c.alpha);
    projector.blend.beta = lightMap(region, region.files.beta, c.beta);
    if (region.encodeGamma) projector.light.gamma.fill(*region.encodeGamma);
  }

  void add(const MpcdiRegion& region, Projector projector) {
    lights(region, projector);
    projector.blend.computed = !projector.blend.alpha;
    if (failed_) return;
    WallEntry entry = entryOf(region);
    entry.projector = std::move(projector);
    builder_.add(std::move(entry));
  }

  /// Reads the points of the region; `metres` is 0 for shares.
  std::optional<PointGrid> points(const MpcdiRegion& region, double metres) {
    Diagnostics findings;
    const std::string &bytes = contents_[region.id].warp, &name = region.files.warp;
    auto grid =
        metres > 0 ? readPointGrid(bytes, name, metres, findings) : readShareGrid(bytes, name, findings);
    builder_.out().append(findings);
    if (!grid) refuse(region, fmt::format("the points of {} are not read", quotedWord(name)));
    return grid;
  }

  void turnOver(const MpcdiRegion& region, PointGrid& grid) {
    turnRowsOver(grid);
    builder_.note(
        fmt::format("region {}: the rows of {} are read from the top; from below, the picture would be "
                    "mirrored",
                    quotedWord(region.id), quotedWord(region.files.warp)),
        region.line);
  }

  /// Reads shares of a source picture, the upper row first, as places on the wall.
  std::optional<MeasuredImage> warpOn(const MpcdiRegion& region, const Wall& wall) {
    std::optional<PointGrid> grid = points(region, 0);
    if (!grid) return std::nullopt;
    const double sense = sumOverCells(*grid, [](const Vec3&, const Vec3& right, const Vec3& below) {
      return right.x() * below.y() - right.y() * below.x();
    });
    if (sense > 0) turnOver(region, *grid);
    const SourceView view = planeView(wall);
    for (Vec3& p : grid->points) p = view({p.x(), 1 - p.y()});
    return MeasuredImage{region.files.warp, grid->columns, grid->rows, std::move(grid->points)};
  }

  void onWall(const MpcdiRegion& region, std::size_t screen, const Wall& ofRegion) {
    Projector projector = fillingProjector(screen, {region.columns, region.rows});
    auto image = region.files.warp.empty() ? std::nullopt : warpOn(region, ofRegion);
    if (image)
      projector.image = std::move(*image);
    else if (!region.files.warp.empty())
      return;
    else if (document_->profile == "2d")
      projector.image = sampledImage(planeView(ofRegion), 2, 2);
    add(region, std::move(projector));
  }

  /// Profile 2d: the region's part of its buffer's canvas.
  void onCanvas(const MpcdiRegion& region) {
    if (!canvases_.contains(region.buffer)) {
      const MpcdiBuffer& buffer = document_->buffers.at(region.buffer);
      double aspect = region.columns / region.width * region.height / region.rows;
      if (buffer.columns > 0 && buffer.rows > 0) aspect = static_cast<double>(buffer.columns) / buffer.rows;
      const double width = std::clamp(aspect, 0.05, 20.0) * kCanvasHeight;
      const Vec3 eye = builder_.hall().visitor.eye;
      Screen screen;
      screen.name = region.buffer;
      const double left = canvases_.empty() ? -width / 2 : canvasEnd_;
      screen.surface = wallOfEdges(eye + Vec3(left, kCanvasDistance, -kCanvasHeight / 2), Vec3(width, 0, 0),
                                   Vec3(0, 0, kCanvasHeight));
      canvasEnd_ = left + width + 0.5;
      canvases_[region.buffer] = builder_.addScreen(screen);
      builder_.warning(fmt::format("the file does not say how large the canvas of {} is, nor where it is; it "
                                   "stands {:.2f} m wide and {} m high before the visitor",
                                   quotedWord(region.buffer), width, kCanvasHeight),
                       region.line);
    }
    const std::size_t number = canvases_[region.buffer];
    if (number >= builder_.hall().screens.size()) return;
    const Wall& canvas = std::get<Wall>(builder_.hall().screens[number].surface);
    const Vec3 right = canvas.lowerRight - canvas.lowerLeft, up = canvas.upperLeft - canvas.lowerLeft;
    onWall(region, number,
           wallOfEdges(canvas.lowerLeft + region.x * right + region.y * up, region.width * right,
                       region.height * up));
  }

  static WarpView viewOf(const MpcdiFrustum& f) {
    WarpView view;
    view.q_RP = rotationOf({f.yaw * kDegree, f.pitch * kDegree, f.roll * kDegree});
    view.left = f.leftAngle * kDegree;
    view.right = f.rightAngle * kDegree;
    view.up = f.upAngle * kDegree;
    view.down = f.downAngle * kDegree;
    return view;
  }

  /// Profile 3d: the picture of one fixed view, warped.
  void inFixedView(const MpcdiRegion& region) {
    if (!region.frustum) return refuse(region, "the profile 3d needs a frustum");
    const WarpView view = viewOf(*region.frustum);
    if (!isFlatView(view)) return warn(region, "the frustum is no flat picture; the region is left out");
    Screen screen;
    screen.name = region.id;
    const Wall wall = wallOfView(view, builder_.hall().visitor.eye, kCanvasDistance);
    screen.surface = wall;
    if (meshScreens_.empty() && builder_.hall().walls.empty())
      builder_.warning(fmt::format("the profile 3d says what one eye sees, not where the screen is; pictures "
                                   "stand {} m from the visitor's usual eye and are right only there",
                                   kCanvasDistance),
                       region.line);
    onWall(region, builder_.addScreen(screen), wall);
  }

  /// The origin of the file's points, in R.
  Vec3 originOf(const MpcdiRegion& region) {
    const std::string& origin = region.files.origin;
    if (origin == "idealEyePoint") return builder_.hall().visitor.eye;
    if (origin != "floorCenter" && !originNamed_) {
      originNamed_ = true;
      builder_.warning(fmt::format("the origin of the points is {}; it is taken for the middle of the floor",
                                   origin.empty() ? "not stated" : quotedWord(origin)),
                       region.line);
    }
    return Vec3::Zero();
  }

  void measured(const MpcdiRegion& region) {
    const std::string& unit = region.files.unit;
    if (unit.empty() || unit == "unknown")
      warn(region, "the unit of the points is unknown; they are taken for metres");
    auto grid = points(region, metresOf(unit));
    if (!grid) return;
    const Vec3 origin = originOf(region);
    for (Vec3& p : grid->points) p = origin + (region.frame ? frameToRig(*region.frame, p) : mpcdiToRig(p));
    std::optional<Vec3> seenFrom;
    if (region.frame)
      seenFrom = origin + metresOf(unit) * frameToRig(*region.frame, region.frame->position);
    else if (region.files.origin == "idealEyePoint" || region.files.origin == "floorCenter")
      seenFrom = builder_.hall().visitor.eye;
    if (seenFrom && sumOverCells(*grid, [&seenFrom](const Vec3& p, const Vec3& right, const Vec3& below) {
                      return right.cross(-below).dot(*seenFrom - p);
                    }) < 0)
      turnOver(region, *grid);
    if (region.frustum || region.frame)
      builder_.note(fmt::format("region {}: its points count, its lens does not", quotedWord(region.id)),
                    region.line);
    if (!addToMesh(region, *grid)) return;
    Projector projector = fillingProjector(meshScreens_[region.buffer], {region.columns, region.rows});
    projector.image = MeasuredImage{region.files.warp, grid->columns, grid->rows, std::move(grid->points)};
    add(region, std::move(projector));
  }

  /// Adds the surface that the region lights to the screen of its buffer.
  bool addToMesh(const MpcdiRegion& region, const PointGrid& grid) {
    Diagnostics findings;
    auto mesh = meshOfGrid(thinned(grid), region.files.warp, findings);
    if (!mesh) {
      warn(region, "it has no three neighbouring points and is left out");
      return false;
    }
    if (!meshScreens_.contains(region.buffer)) {
      Screen screen;
      screen.name = region.buffer;
      screen.surface = MeshScreen{};
      meshScreens_[region.buffer] = builder_.addScreen(screen);
    }
    MeshScreen& whole = meshes_[region.buffer];
    const auto first = static_cast<std::uint32_t>(whole.points.size());
    whole.points.insert(whole.points.end(), mesh->points.begin(), mesh->points.end());
    for (const auto& t : mesh->triangles)
      whole.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    return true;
  }

  /// A lens, without the surface that it lights: a plane through the origin stands in.
  void throughLens(const MpcdiRegion& region) {
    if (!region.frustum || !region.frame)
      return warn(region, "it has neither points nor a lens and is left out");
    const WarpView view = viewOf(*region.frustum);
    if (region.unknownLens || !isFlatView(view))
      return warn(region, "its lens is no flat picture and is not understood; it is left out");
    LensImage lens;
    lens.X_RP = {metresOf(region.files.unit) * frameToRig(*region.frame, region.frame->position), view.q_RP};
    const double left = det::tan(view.left), right = det::tan(view.right);
    const double up = det::tan(view.up), down = det::tan(view.down);
    lens.throwRatio = 1 / (right - left);
    lens.shift = {(right + left) / (2 * (right - left)), (up + down) / (2 * (up - down))};
    lens.pixelAspect = (up - down) / (right - left) * region.columns / region.rows;
    const Vec3 axis = lens.X_RP.q * Vec3::UnitY();
    double distance = -lens.X_RP.p.dot(axis);
    if (!(distance > 0.05)) distance = 1;
    Screen screen;
    screen.name = region.id;
    WarpView wide = view;
    screen.surface = wallOfView(wide, lens.X_RP.p, distance);
    if (builder_.hall().walls.empty())
      builder_.warning(
          "the file has projectors and no surface; for each, a plane square to its lens through the "
          "origin stands in: write a .walls file and name the mesh of the surface there",
          region.line);
    Projector projector = fillingProjector(builder_.addScreen(screen), {region.columns, region.rows});
    projector.image = lens;
    add(region, std::move(projector));
  }

  /// Gives back the hall from which this program wrote the file. False if the standard's part has changed.
  bool readExtension(const MpcdiHallExtension& extension) {
    for (const MpcdiRegion& region : document_->regions) {
      const auto known = extension.digests.find(region.id);
      if (known == extension.digests.end() || known->second != digestOf(region, contents_[region.id])) {
        builder_.note(
            fmt::format("region {} was changed after this program wrote the file; its own description "
                        "of the hall is not used",
                        quotedWord(region.id)),
            region.line);
        return false;
      }
    }
    const auto text = files_(extension.hall, kMostXmlBytes);
    Diagnostics findings;
    auto hall = text ? parseWalls(text.value(), extension.hall, findings) : std::nullopt;
    if (!hall || !loadParts(*hall, findings)) {
      builder_.warning("this program's own description of the hall is damaged and not used");
      return false;
    }
    for (const MpcdiRegion& region : document_->regions)
      for (WallEntry& entry : hall->walls)
        if (entry.wall.name == region.id && entry.projector) {
          Projector& projector = *entry.projector;
          const ProjectorBlend blend = projector.blend;
          const auto gamma = projector.light.gamma;
          lights(region, projector);
          projector.light.gamma = gamma;
          if (blend.mask.empty()) projector.blend.alpha.reset();
          projector.blend.mask.clear();
          const auto aspect = extension.pixelAspects.find(region.id);
          auto* lens = std::get_if<LensImage>(&projector.image);
          if (lens && aspect != extension.pixelAspects.end()) lens->pixelAspect = aspect->second;
        }
    hall->file = builder_.file();
    builder_.hall() = std::move(*hall);
    return true;
  }

  /// Reads the meshes and warps of the hall from the archive.
  bool loadParts(WallFile& hall, Diagnostics& findings) {
    for (Screen& screen : hall.screens)
      if (auto* mesh = std::get_if<MeshScreen>(&screen.surface)) {
        const std::string name = mesh->file;
        const auto bytes = files_(name, kMostWarpBytes);
        auto read = bytes ? readObjMesh(bytes.value(), name, 1, findings) : std::nullopt;
        if (!read) return false;
        *mesh = std::move(*read);
      }
    for (WallEntry& entry : hall.walls) {
      if (!entry.projector) continue;
      if (auto& lut = entry.projector->lut) {
        const auto bytes = files_(lut->file, kMostCubeBytes);
        auto table = bytes ? readCube(bytes.value(), lut->file, findings) : std::nullopt;
        if (!table) return false;
        lut->table = std::move(*table);
      }
      if (auto* image = std::get_if<MeasuredImage>(&entry.projector->image)) {
        const auto bytes = files_(image->file, kMostWarpBytes);
        auto grid = bytes ? readPointGrid(bytes.value(), image->file, 1, findings) : std::nullopt;
        if (!grid) return false;
        image->columns = grid->columns;
        image->rows = grid->rows;
        image->points = std::move(grid->points);
      }
    }
    return true;
  }

  HallBuilder& builder_;
  const NeighbourFiles& files_;
  const MpcdiDocument* document_ = nullptr;
  std::map<std::string, MpcdiContent> contents_;    ///< by region
  std::map<std::string, std::size_t> canvases_;     ///< screens, by buffer
  std::map<std::string, std::size_t> meshScreens_;  ///< screens, by buffer
  std::map<std::string, MeshScreen> meshes_;        ///< by buffer
  double canvasEnd_ = 0;
  bool originNamed_ = false;
  bool failed_ = false;
};

}  // namespace

std::optional<WallFile> readMpcdiXml(const std::string& xml, const std::string& file,
                                     const NeighbourFiles& files, Diagnostics& out) {
  HallBuilder builder(file, out);
  const auto document = readMpcdiDocument(xml, builder);
  if (!document) return std::nullopt;
  MpcdiReader(builder, files).run(*document);
  return builder.finish();
}

std::optional<WallFile> readMpcdi(const std::string& bytes, const std::string& file, Diagnostics& out) {
  auto archive = ZipArchive::open(bytes);
  if (!archive) {
    out.error({file, 0, 0}, archive.error().message);
    return std::nullopt;
  }
  // Some programs have written mpacs.xml.
  const std::string name = archive.value().has("mpcdi.xml") ? "mpcdi.xml" : "mpacs.xml";
  const auto xml = archive.value().file(name, kMostXmlBytes);
  if (!xml) {
    out.error({file, 0, 0},
              archive.value().has(name) ? xml.error().message : "there is no mpcdi.xml in the archive");
    return std::nullopt;
  }
  const NeighbourFiles files = [&archive](const std::string& part, std::size_t limit) {
    return archive.value().file(part, limit);
  };
  return readMpcdiXml(xml.value(), file, files, out);
}

}  // namespace stadion
