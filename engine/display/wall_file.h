#pragma once
/// Wall files: the projection surfaces of a place, as text.
///
///     # My CAVE, 3 m on a side, origin in the middle of the floor
///     unit m
///     eye-separation 0.064
///     wall front  lower-left -1.5 1.5 0   lower-right 1.5 1.5 0   upper-left -1.5 1.5 3
///     wall floor  lower-left -1.5 -1.5 0  lower-right 1.5 -1.5 0  upper-left -1.5 1.5 0
///
/// One statement a line; `#` begins a comment; numbers are separated by blanks or commas.
///     unit m|cm|mm|in|ft        of every length in the file (m); stands before the first length
///     eye-separation LENGTH     between the two eyes (0.064 m)
///     near LENGTH, far LENGTH   how near and far is drawn from the eye (0.1 m, 1000 m)
///     pixels WIDTH HEIGHT       of every wall that does not say otherwise (the run decides)
///     wall NAME lower-left X Y Z  lower-right X Y Z  upper-left X Y Z  [pixels WIDTH HEIGHT]  [card N]
/// Corners are in rig space (+X right, +Y forward, +Z up) as seen from inside the room. A file has 1 to
/// WallFile::kMaxWalls walls and projectors.
///
/// A hall has screens of any shape (screen.h) and projectors that light them (projector.h). Angles are
/// degrees. Screens may stand below their projectors.
///     screen NAME plane     lower-left X Y Z  lower-right X Y Z  upper-left X Y Z
///     screen NAME cylinder  centre X Y Z  radius R  azimuth LEFT RIGHT  height BOTTOM TOP
///     screen NAME sphere    centre X Y Z  radius R  azimuth LEFT RIGHT  elevation LOWEST HIGHEST  [tilt A]
///     screen NAME mesh      file FILE.obj|FILE.pfm
///     projector NAME  screen SCREEN  [pixels W H]  [eye left|right|both]  [card N]  IMAGE  [LIGHT]
///       IMAGE   at X Y Z  look-at X Y Z | turn YAW PITCH  [roll A]  throw RATIO  [shift RIGHT UP]
///               [pixel-aspect HEIGHT/WIDTH]   of an anamorphic lens (1)
///               at X Y Z  look-at X Y Z | turn YAW PITCH  [roll A]  fisheye A
///               pins X Y  X Y  X Y  X Y       upper left, upper right, lower right, lower left (planes only)
///               warp FILE.pfm                 points of the screen that a camera system measured
///       LIGHT   [display-gamma G | R G B | srgb]  [white R G B]  [black L]  [no-blend]  [mask FILE.png]
///               [edge-left A]  [edge-right A]  [edge-top A]  [edge-bottom A]   where ramps begin, as shares
///               [lut FILE.cube]   colour table for the values that the projector gets
///     panorama NAME dome-master      [field-of-view A]            [FIELDS]   directions around the head, as a circle
///     panorama NAME equirectangular  [field-of-view ACROSS UP]    [FIELDS]
///     panorama NAME cube                                          [FIELDS]
///       FIELDS  [pixels W H]  [at X Y Z]  [eye left|right|middle]  [turn YAW]  [tilt A]  [card N]
///     control NAME pjlink HOST  [port N]  [password FILE]   how the projector of a wall or projector is switched
///     loudspeaker NAME X Y Z  [channel N]  [delay MS]  [gain DB]  [subwoofer HZ]   (loudspeaker_text.h)
///     sound [card NAME]  [align on|off]   what the loudspeakers are connected to
///     visitor X Y Z [within R]  usual place of the eyes, and how far they go from there (0 0 1.7, 1 m)
/// YAW turns the lens to the right, PITCH up; `roll` turns it clockwise, seen along the lens. Names of files
/// are relative to the folder of the wall file. Points in them are in rig space, in the unit of the wall file.
/// screen_mesh.h says which files are read.
///
/// Units    metres in memory, whatever the file's unit.
/// Threads  plain values, any thread.
/// Errors   go to the Diagnostics with line, column and a fix where one is known; there may be several.

#include "engine/base/diagnostic.h"
#include "engine/display/frustum.h"
#include "engine/display/output.h"
#include "engine/display/projector.h"
#include "engine/display/screen.h"
#include "engine/display/wall.h"
#include "engine/loudspeakers/loudspeaker.h"
#include "engine/panorama/panorama.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stadion {

struct PixelSize {
  std::uint32_t width = 0, height = 0;  ///< 0 = not stated
};

/// A wall as a file describes it: what one output shows.
struct WallEntry {
  /// Of a projector: its name, and a rectangle about as large as the part of the screen that it covers. Of a
  /// panorama: its name, and a rectangle before the visitor.
  Wall wall;
  std::optional<Projector> projector;       ///< lights a screen
  std::optional<Panorama> panorama;         ///< shows directions; an entry has at most one of both
  PixelSize pixels;                         ///< size of one eye's picture, if the file states it
  std::optional<WallOutput> output;         ///< output of the wall, if the file states one
  std::optional<ProjectorControl> control;  ///< how its projector is switched, if the file states it
  std::optional<std::uint32_t> card;  ///< number of the graphics card that draws it, if the file states one
  std::uint32_t line = 0;             ///< in the file; 0 = made by a program
  std::uint32_t column = 0;           ///< column of the wall's name
  std::string excerpt;                ///< the line, for messages

  /// Returns true if the entry is a wall: its picture is one view and fills it.
  bool isFlat() const { return !projector && !panorama; }
  /// What messages call the entry.
  const char* noun() const { return projector ? "projector" : panorama ? "panorama" : "wall"; }
  /// Returns the size of the output's picture, if the entry fixes it.
  PixelSize outputSize() const {
    if (projector) return {projector->width, projector->height};
    return panorama ? PixelSize{panorama->width, panorama->height} : pixels;
  }
};

struct WallFile {
  /// Each wall takes two threads and an OpenGL context, or a process. A larger count is a mistake in the
  /// file.
  static constexpr std::size_t kMaxWalls = 256;
  static constexpr std::size_t kMaxScreens = 256;

  std::string file;              ///< as the user named it
  std::vector<WallEntry> walls;  ///< walls, projectors and panoramas in file order
  std::vector<Screen> screens;   ///< what the projectors light
  VisitorPlace visitor;          ///< for what depends on where eyes usually are
  LoudspeakerSet loudspeakers;   ///< empty: the hall's sound has no layout of its own
  double metresPerUnit = 1;      ///< factor by which lengths were multiplied
  double eyeSeparation = 0.064;  ///< [m]
  DepthRange depth;

  std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const WallEntry& w : walls) all.push_back(w.wall.name);
    return all;
  }
};

/// Reads the text; nothing if it has errors. Says nothing about geometry: lintWalls (wall_lint.h) does. Opens
/// no file: meshes, warps and colour tables have their names only, until loadHallFiles reads them.
std::optional<WallFile> parseWalls(std::string_view text, const std::string& file, Diagnostics& out);

/// Reads the meshes, warps and colour tables that the hall names, relative to the folder of WallFile::file, and places the
/// rectangles of projectors. False after an error; findings name the file, and the line of the wall file.
bool loadHallFiles(WallFile& hall, Diagnostics& out);

/// Finds the file, reads it and the files that it names, and lints it. `nameOrPath` is the path of a file, or the name of one that lies in
/// `folder` as NAME.walls (the walls that ship with Stadion). Warnings alone do not fail.
std::optional<WallFile> loadWalls(const std::string& nameOrPath, const std::string& folder, Diagnostics& out);

/// The file as text that parseWalls reads back to the same values, in metres; in the unit of the file if it
/// names meshes or warps. Angles and rotations may differ in their last digits.
std::string formatWalls(const WallFile& walls);

}  // namespace stadion
