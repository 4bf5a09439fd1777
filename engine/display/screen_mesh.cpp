#include "engine/display/screen_mesh.h"

#include "engine/plain_text/text_line.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>

namespace stadion {
namespace {

constexpr double kMostCoordinate = 1e7;  ///< of a point [unit of the file]
constexpr std::string_view kSpaces = " \t\r\n\v\f";

/// Takes the first word off the text; empty at its end.
std::string_view takeWord(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(kSpaces), text.size()));
  const std::string_view word = text.substr(0, text.find_first_of(kSpaces));
  text.remove_prefix(word.size());
  return word;
}

template <class Number>
std::optional<Number> numberOf(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  Number value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

bool hasArea(const std::vector<Vec3>& points, const std::array<std::uint32_t, 3>& t) {
  const Vec3 one = points[t[1]] - points[t[0]], two = points[t[2]] - points[t[0]];
  return one.cross(two).norm() > 1e-12 * one.norm() * two.norm() && one.allFinite() && two.allFinite();
}

class PfmReader {
public:
  PfmReader(std::string_view bytes, const std::string& file, Diagnostics& out)
      : rest_(bytes), file_(file), out_(out) {}

  std::optional<PointGrid> run(double metresPerUnit) {
    PointGrid grid;
    if (!heading(grid)) return std::nullopt;
    grid.points.resize(std::size_t{grid.columns} * grid.rows);
    for (std::size_t row = grid.rows; row-- > 0;)
      for (std::size_t column = 0; column < grid.columns; ++column)
        grid.points[row * grid.columns + column] = metresPerUnit * point();
    return grid;
  }

private:
  bool refuse(std::string why) {
    out_.error({file_, 0, 0}, std::move(why));
    return false;
  }

  bool heading(PointGrid& grid) {
    const std::string_view magic = takeWord(rest_);
    if (magic == "Pf")
      return refuse("this PFM file has one channel; points need three, so its first line must be PF");
    if (magic != "PF") return refuse("this is not a PFM file; one begins with the line PF");
    const auto columns = numberOf<std::uint64_t>(takeWord(rest_));
    const auto rows = numberOf<std::uint64_t>(takeWord(rest_));
    if (!columns || !rows)
      return refuse("the second line of a PFM file must be its width and height, such as 64 48");
    if (*columns < 2 || *rows < 2 || *columns > kMaxGridSide || *rows > kMaxGridSide ||
        *columns * *rows > kMaxGridPoints)
      return refuse(
          fmt::format("a grid of {} x {} points is not read; it must have 2 to {} points a side and "
                      "at most {} in all",
                      *columns, *rows, kMaxGridSide, kMaxGridPoints));
    const auto scale = numberOf<double>(takeWord(rest_));
    if (!scale || !std::isfinite(*scale) || *scale == 0)
      return refuse("the third line of a PFM file must be its scale, such as -1.0 for little-endian numbers");
    bigEndian_ = *scale > 0;
    if (rest_.starts_with("\r\n")) rest_.remove_prefix(1);
    if (!rest_.empty()) rest_.remove_prefix(1);
    grid.columns = static_cast<std::uint32_t>(*columns);
    grid.rows = static_cast<std::uint32_t>(*rows);
    const std::uint64_t needed = *columns * *rows * 3 * sizeof(float);
    if (rest_.size() >= needed) return true;
    return refuse(fmt::format("the file ends too early: {} x {} points take {} bytes, and {} are there; copy "
                              "it again",
                              *columns, *rows, needed, rest_.size()));
  }

  Vec3 point() {
    Vec3 p;
    for (int axis = 0; axis < 3; ++axis) {
      std::array<char, 4> bytes;
      std::memcpy(bytes.data(), rest_.data(), bytes.size());
      rest_.remove_prefix(bytes.size());
      if (bigEndian_ != (std::endian::native == std::endian::big)) std::ranges::reverse(bytes);
      p[axis] = std::bit_cast<float>(bytes);
    }
    const bool on = p.allFinite() && p.cwiseAbs().maxCoeff() <= kMostCoordinate;
    return on ? p : Vec3(Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
  }

  std::string_view rest_;
  const std::string& file_;
  Diagnostics& out_;
  bool bigEndian_ = false;
};

class ObjReader {
public:
  ObjReader(const std::string& file, double metresPerUnit, Diagnostics& out)
      : file_(file), metresPerUnit_(metresPerUnit), out_(out) {
    mesh_.file = file;
  }

  std::optional<MeshScreen> run(std::string_view text) {
    while (!text.empty() && !failed_) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      ++line_;
      statement(text.substr(0, end));
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    if (failed_) return std::nullopt;
    if (!skipped_.empty())
      out_.warning({file_, 0, 0}, fmt::format("these statements are skipped: {}; a screen is made of v and f "
                                              "lines only",
                                              fmt::join(skipped_, ", ")));
    if (!mesh_.triangles.empty()) return std::move(mesh_);
    out_.error({file_, 0, 0}, "the mesh has no triangle with an area; a screen needs v lines for its points "
                              "and f lines for its faces");
    return std::nullopt;
  }

private:
  void refuse(std::string why) {
    out_.error({file_, line_, 0}, std::move(why));
    failed_ = true;
  }

  void statement(std::string_view line) {
    line = line.substr(0, line.find('#'));
    const std::string_view keyword = takeWord(line);
    if (keyword == "v") return point(line);
    if (keyword == "f") return face(line);
    static constexpr std::string_view kNoShape[] = {"", "vn", "vt", "vp", "o", "g", "s", "usemtl", "mtllib"};
    if (std::ranges::find(kNoShape, keyword) != std::end(kNoShape)) return;
    const std::string shown = printable(keyword, 24);
    if (skipped_.size() < 8 && std::ranges::find(skipped_, shown) == skipped_.end())
      skipped_.push_back(shown);
  }

  void point(std::string_view rest) {
    Vec3 p;
    for (int axis = 0; axis < 3; ++axis) {
      const auto value = numberOf<double>(takeWord(rest));
      if (!value || !(std::fabs(*value) <= kMostCoordinate))
        return refuse("a v line must have three numbers of at most 1e7, such as: v 1.5 2 0.3");
      p[axis] = *value;
    }
    if (mesh_.points.size() == kMaxMeshPoints)
      return refuse(fmt::format("a screen has at most {} points; make the mesh coarser", kMaxMeshPoints));
    mesh_.points.push_back(metresPerUnit_ * p);
  }

  /// Cuts the face into a fan of triangles.
  void face(std::string_view rest) {
    std::array<std::uint32_t, 3> t{};
    std::size_t corners = 0;
    for (std::string_view word = takeWord(rest); !word.empty(); word = takeWord(rest), ++corners) {
      const auto at = corner(word.substr(0, word.find('/')));
      if (!at)
        return refuse(fmt::format("{} is no corner of a face; the file has {} points up to this line",
                                  quotedWord(word), mesh_.points.size()));
      t[std::min<std::size_t>(corners, 2)] = *at;
      if (corners < 2) continue;
      if (mesh_.triangles.size() == kMaxMeshTriangles)
        return refuse(
            fmt::format("a screen has at most {} triangles; make the mesh coarser", kMaxMeshTriangles));
      if (hasArea(mesh_.points, t)) mesh_.triangles.push_back(t);
      t[1] = t[2];
    }
    if (corners < 3) refuse("a face needs at least three corners, such as: f 1 2 3");
  }

  std::optional<std::uint32_t> corner(std::string_view word) const {
    const auto number = numberOf<std::int64_t>(word);
    const auto count = static_cast<std::int64_t>(mesh_.points.size());
    if (!number || *number == 0 || *number > count || *number < -count) return std::nullopt;
    return static_cast<std::uint32_t>(*number > 0 ? *number - 1 : count + *number);
  }

  const std::string& file_;
  double metresPerUnit_;
  Diagnostics& out_;
  MeshScreen mesh_;
  std::vector<std::string> skipped_;
  std::uint32_t line_ = 0;
  bool failed_ = false;
};

}  // namespace

std::optional<PointGrid> readPointGrid(std::string_view bytes, const std::string& file, double metresPerUnit,
                                       Diagnostics& out) {
  return PfmReader(bytes, file, out).run(metresPerUnit);
}

std::optional<MeshScreen> readObjMesh(std::string_view text, const std::string& file, double metresPerUnit,
                                      Diagnostics& out) {
  return ObjReader(file, metresPerUnit, out).run(text);
}

std::optional<MeshScreen> meshOfGrid(const PointGrid& grid, const std::string& file, Diagnostics& out) {
  if (grid.points.size() > kMaxMeshPoints / 2) {
    out.error({file, 0, 0}, fmt::format("a grid of {} x {} points is too fine for a screen; make it coarser, "
                                        "with at most {} points",
                                        grid.columns, grid.rows, kMaxMeshPoints / 2));
    return std::nullopt;
  }
  MeshScreen mesh;
  mesh.file = file;
  std::vector<std::uint32_t> number(grid.points.size());
  for (std::size_t i = 0; i < grid.points.size(); ++i) {
    number[i] = static_cast<std::uint32_t>(mesh.points.size());
    if (grid.points[i].allFinite()) mesh.points.push_back(grid.points[i]);
  }
  const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
    for (const std::size_t i : {a, b, c})
      if (!grid.points[i].allFinite()) return;
    const std::array<std::uint32_t, 3> t{number[a], number[b], number[c]};
    if (hasArea(mesh.points, t)) mesh.triangles.push_back(t);
  };
  for (std::size_t row = 0; row + 1 < grid.rows; ++row)
    for (std::size_t column = 0; column + 1 < grid.columns; ++column) {
      const std::size_t at = row * grid.columns + column, below = at + grid.columns;
      add(at, below, at + 1);
      add(below, below + 1, at + 1);
    }
  if (!mesh.triangles.empty()) return mesh;
  out.error({file, 0, 0}, "the grid has no three neighbouring points on a screen; measure it again");
  return std::nullopt;
}

}  // namespace stadion
