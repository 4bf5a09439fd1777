#pragma once
/// Collects screens and projectors of a foreign file as a WallFile: good names, limits, and one place for what
/// the file has and this program does not understand.
///
/// Units      metres, radians. Frames: rig space.
/// Ownership  borrows the Diagnostics.
/// Threads    one builder, one thread.
/// Errors     too many walls or screens is an error, once.

#include "engine/display/wall_file.h"

#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace stadion {

class HallBuilder {
public:
  HallBuilder(std::string file, Diagnostics& out);

  /// Adds a screen; its name is made good and unique. Returns its number.
  std::size_t addScreen(Screen screen);
  /// Adds a wall or a projector; its name is made good and unique.
  void add(WallEntry entry);

  /// Warns that the part of the file at `place` is not understood. Of many warnings only the first are given,
  /// and their number by finish().
  void notUnderstood(const SourcePosition& where, const std::string& place, const std::string& effect);
  /// Remembers a setting that says nothing about the hall; finish() lists them in one note.
  void notOfHall(const std::string& name);

  WallFile& hall() { return hall_; }
  Diagnostics& out() { return out_; }
  const std::string& file() const { return hall_.file; }
  void error(std::string message, std::uint32_t line = 0);
  void warning(std::string message, std::uint32_t line = 0);
  void note(std::string message, std::uint32_t line = 0);

  /// Returns the hall; nothing after an error. A file without a wall is an error.
  std::optional<WallFile> finish();

private:
  std::string goodName(const std::string& name, const std::string& otherwise, std::set<std::string>& taken);

  WallFile hall_;
  Diagnostics& out_;
  std::set<std::string> wallNames_, screenNames_, notOfHall_;
  std::set<std::pair<std::string, std::string>> renamed_;
  std::size_t unknown_ = 0;
  bool failed_ = false;
};

/// Returns a projector whose picture fills a plane screen.
Projector fillingProjector(std::size_t screen, PixelSize pixels);

/// Returns a rectangle by its lower left corner and its two edges.
Wall wallOfEdges(const Vec3& lowerLeft, const Vec3& right, const Vec3& up);

}  // namespace stadion
