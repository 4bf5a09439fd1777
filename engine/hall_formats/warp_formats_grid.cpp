/// Warp formats that are grids of vertices: Paul Bourke, PFM, domeprojection, SimCAD.

#include "engine/hall_formats/number_line.h"
#include "engine/hall_formats/share_grid.h"
#include "engine/hall_formats/warp_formats.h"

#include <fmt/format.h>
#include <pugixml.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace stadion {
namespace {

constexpr std::size_t kMostGridSide = 8192;

bool tooMany(std::size_t columns, std::size_t rows) {
  return columns * rows > WarpMesh::kMostVertices;
}

/// A vertex of the domeprojection format, with its place in the grid.
struct NumberedVertex {
  WarpMesh::Vertex vertex;
  std::size_t column, row;
};

/// Reads the offsets of one axis of a SimCAD file.
bool readOffsets(WarpSource& source, const pugi::xml_node& node, std::vector<double>& offsets) {
  const auto range = NumberLine::numberIn(node.attribute("range").as_string("1"));
  if (!range || *range == 0) return source.refuseFile(fmt::format("{} has no sound range", node.name()));
  NumberLine numbers(node.text().get());
  while (!numbers.atEnd()) {
    const auto offset = numbers.number();
    if (!offset || offsets.size() == WarpMesh::kMostVertices)
      return source.refuseFile(fmt::format("{} must be a list of numbers", node.name()));
    offsets.push_back(*offset / *range);
  }
  return true;
}

}  // namespace

bool readPaulBourkeWarp(WarpSource& source, WarpFile& file) {
  std::string_view line;
  const auto kind = source.line(line) ? NumberLine(line).count(10) : std::nullopt;
  if (!kind) return source.refuse("the first line must be the kind of the source, such as 2");
  if (!source.line(line)) return source.refuse("the second line must be columns and rows, such as 100 60");
  NumberLine sizes(line);
  const auto columns = sizes.count(kMostGridSide), rows = sizes.count(kMostGridSide);
  if (!columns || !rows || *columns < 2 || *rows < 2 || tooMany(*columns, *rows))
    return source.refuse("the second line must be columns and rows, from 2 to 8192, such as 100 60");
  if (!source.canHave(*columns * *rows, 10))
    return source.refuseFile("the file ends too early; copy it again");
  for (std::size_t i = 0; i < *columns * *rows; ++i) {
    double n[5];
    if (!source.line(line) || !NumberLine(line).numbers(n))
      return source.refuse(fmt::format("five numbers must stand here, x y s t light, for vertex {} of {}",
                                       i + 1, *columns * *rows));
    WarpMesh::Vertex v;
    v.at = {0.5 + 0.5 * n[0] / source.aspect(), 0.5 - 0.5 * n[1]};
    v.source = {n[2], 1 - n[3]};
    v.light = std::clamp(n[4], 0.0, 1.0);
    if (n[4] < 0) v.at = Vec2::Constant(std::numeric_limits<double>::quiet_NaN());
    file.mesh.vertices.push_back(v);
  }
  if (source.line(line)) source.warn("lines after the last vertex are skipped");
  addGridTriangles(file.mesh, *columns, *rows);
  return true;
}

bool readPfmWarp(WarpSource& source, WarpFile& file) {
  const auto grid = readShareGrid(source.rest(), source.file(), source.out());
  if (!grid) return false;
  if (grid->points.size() > WarpMesh::kMostVertices)
    return source.refuseFile("the grid is too fine for a warp");
  for (std::size_t row = 0; row < grid->rows; ++row)
    for (std::size_t column = 0; column < grid->columns; ++column) {
      WarpMesh::Vertex v;
      // The first row of the file is at the top; readPointGrid takes it for the lowest one.
      const Vec3& p = grid->points[(grid->rows - 1 - row) * grid->columns + column];
      v.at = {static_cast<double>(column) / (grid->columns - 1), static_cast<double>(row) / (grid->rows - 1)};
      v.source = {p.x(), 1 - p.y()};
      if (!v.source.allFinite()) v.at = v.source;
      file.mesh.vertices.push_back(v);
    }
  addGridTriangles(file.mesh, grid->columns, grid->rows);
  return true;
}

bool readDomeprojectionWarp(WarpSource& source, WarpFile& file) {
  std::vector<NumberedVertex> read;
  std::size_t columns = 0, rows = 0;
  for (std::string_view line; source.line(line);) {
    NumberLine words(line);
    double n[4];
    const bool numbers = words.numbers(n);
    const auto column = words.count(kMostGridSide - 1), row = words.count(kMostGridSide - 1);
    if (!numbers || !column || !row) {
      if (!read.empty()) return source.refuse("a line must be x;y;u;v;column;row");
      continue;  // headings
    }
    WarpMesh::Vertex v;
    v.at = {std::clamp(n[0], 0.0, 1.0), std::clamp(n[1], 0.0, 1.0)};
    v.source = {n[2], n[3]};
    read.push_back({v, *column, *row});
    columns = std::max(columns, *column + 1);
    rows = std::max(rows, *row + 1);
    if (read.size() > WarpMesh::kMostVertices) return source.refuseFile("the mesh has too many vertices");
  }
  if (read.empty() || columns < 2 || rows < 2 || tooMany(columns, rows))
    return source.refuseFile("the file must have a line x;y;u;v;column;row for each point of a grid");
  if (columns * rows != read.size())
    return source.refuseFile(fmt::format("the grid has {} x {} points, and the file has {} lines for them",
                                         columns, rows, read.size()));
  WarpMesh::Vertex missing;
  missing.at = Vec2::Constant(std::numeric_limits<double>::quiet_NaN());
  file.mesh.vertices.assign(columns * rows, missing);
  for (const NumberedVertex& v : read) file.mesh.vertices[v.row * columns + v.column] = v.vertex;
  addGridTriangles(file.mesh, columns, rows);
  return true;
}

bool readSimcadWarp(WarpSource& source, WarpFile& file) {
  pugi::xml_document document;
  const auto parsed = document.load_buffer(source.rest().data(), source.rest().size());
  if (!parsed) return source.refuseFile(fmt::format("this is not sound XML: {}", parsed.description()));
  const pugi::xml_node definition = document.child("GeometryFile").child("GeometryDefinition");
  if (!definition) return source.refuseFile("GeometryFile/GeometryDefinition is missing");
  std::vector<double> across, up;
  for (const pugi::xml_node& node : definition.children()) {
    const std::string_view name = node.name();
    if (name == "X-FlatParameters" && !readOffsets(source, node, across)) return false;
    if (name == "Y-FlatParameters" && !readOffsets(source, node, up)) return false;
  }
  const auto side = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(across.size()))));
  if (across.size() != up.size() || side * side != across.size() || side < 2)
    return source.refuseFile(fmt::format("X-FlatParameters has {} numbers and Y-FlatParameters {}; both must "
                                         "be the same square, such as 33 x 33",
                                         across.size(), up.size()));
  for (std::size_t i = 0; i < across.size(); ++i) {
    WarpMesh::Vertex v;
    const double step = static_cast<double>(side - 1);
    v.source = {static_cast<double>(i % side) / step, static_cast<double>(i / side) / step};
    v.at = v.source + Vec2(across[i], up[i]);
    file.mesh.vertices.push_back(v);
  }
  addGridTriangles(file.mesh, side, side);
  return true;
}

}  // namespace stadion
