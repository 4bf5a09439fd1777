#pragma once
/// The readers behind readWarpFile (warp_mesh_file.h), one a format.
///
/// Each fills the mesh, in shares from the upper left corner, and returns false after an error. Corners of
/// triangles and sizes of numbers are checked by the caller.

#include "engine/hall_formats/warp_mesh_file.h"

namespace stadion {

/// A file that is read: its lines, and a place for what is wrong.
class WarpSource {
public:
  WarpSource(std::string_view bytes, const std::string& file, double aspect, Diagnostics& out)
      : rest_(bytes), file_(file), aspect_(aspect), out_(out) {}

  /// Takes the next line that is not blank; false at the end.
  bool line(std::string_view& taken);
  std::string_view rest() const { return rest_; }
  const std::string& file() const { return file_; }
  double aspect() const { return aspect_; }
  Diagnostics& out() { return out_; }

  /// Reports an error at the current line; returns false.
  bool refuse(std::string why);
  /// Reports an error of the whole file; returns false.
  bool refuseFile(std::string why);
  void warn(std::string what);

  /// True if the file can have so many lines or records of at least `bytesEach` bytes yet.
  bool canHave(std::size_t count, std::size_t bytesEach) const {
    return count <= rest_.size() / bytesEach + 1;
  }

private:
  std::string_view rest_;
  const std::string& file_;
  double aspect_;
  Diagnostics& out_;
  static constexpr std::size_t kMostWarnings = 20;
  std::uint32_t line_ = 0;
  std::size_t warnings_ = 0;
};

bool readPaulBourkeWarp(WarpSource& source, WarpFile& file);
bool readObjWarp(WarpSource& source, WarpFile& file);
bool readPfmWarp(WarpSource& source, WarpFile& file);
bool readDomeprojectionWarp(WarpSource& source, WarpFile& file);
bool readSimcadWarp(WarpSource& source, WarpFile& file);
bool readSkyskanWarp(WarpSource& source, WarpFile& file);
bool readScalableWarp(WarpSource& source, WarpFile& file);
bool readScissWarp(WarpSource& source, WarpFile& file);

}  // namespace stadion
