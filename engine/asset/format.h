#pragma once
/// The model formats a show may use, and how each one's coordinates become ours (+X right, +Y forward, +Z up,
/// m).
///
/// A format that states its axes or its unit is believed. One that does not is read by the convention below,
/// which a script overrides per object with `up` and `unit`:
///
///   format    up          one unit         why
///   glTF/GLB  +Y          1 m              the standard says so; the model's -Z becomes our +Y
///   COLLADA   from file   from file        <up_axis> and <unit>; without them +Y and 1 m
///   OBJ       +Y          1 m              states neither; most programs write +Y up
///   3DS       +Z          1 m              +Z is 3D Studio's up; the file's master scale is applied
///   STL       +Z          1 m              states neither; drawn on the bed of a machine, +Z up
///   FBX       from file   from file        its settings; without them +Y and 1 cm
///   PLY       +Z          1 m              states neither; scanners write +Z up
///
/// Turning +Y up into +Z up: (x, y, z) -> (x, -z, y). Turning +X up into +Z up: (x, y, z) -> (-y, -z, x).
/// Normals in OBJ, glTF, COLLADA, FBX and PLY files are kept; missing ones, and those of 3DS and STL, are made smooth
/// except across edges sharper than 40 degrees. Colours of formats without a colour space (all
/// but glTF) are taken as sRGB; those of glTF are linear.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stadion {

enum class UpAxis : std::uint8_t { X, Y, Z };

enum class ModelFormat : std::uint8_t { Obj, ThreeDs, Gltf, Collada, Stl, Fbx, Ply };

struct FormatInfo {
  ModelFormat format;
  const char* extension;  ///< lower case, without the dot
  const char* name;       ///< for messages
  const char* loader;  ///< assimp's name of the loader, the only one that reads such a file; empty for glTF
  UpAxis up;           ///< when neither file nor script says
  double unit;         ///< [m] likewise
  bool statesAxes;     ///< the file states up axis and unit itself
  bool linearColours;
};

/// What is made of a model.
enum class ModelForm : std::uint8_t {
  Object,       ///< a mesh of fixed form
  Figure,       ///< a mesh with skeleton and clips
  Either,       ///< a figure if the file has skins or clips
  Environment,  ///< light from all around, from a picture
};

/// What is made of the nodes of an object's file. A node is named by its path, "roof" or "roof/lamp": each name is that
/// of a node somewhere below the one before. Characters that scripts allow in no name count as "_".
struct NodeSelection {
  std::string part;                  ///< only this node and what is below it; empty: all nodes
  std::vector<std::string> without;  ///< not these nodes, nor what is below them
};

/// As one text: the part, and in each further line a node that is left out. Names hold no line breaks.
std::string textOf(const NodeSelection& nodes);
NodeSelection nodeSelectionOf(std::string_view text);

/// The script's settings for a model; unset means: as the format defines.
struct ImportOptions {
  std::optional<double> unit;  ///< [m] length of one unit of the file, 1e-6 .. 1e6
  std::optional<UpAxis> up;
  ModelForm form = ModelForm::Object;
  NodeSelection nodes{};
};

/// By the extension of the file's name, in either case; nullptr if it is not a format for shows.
const FormatInfo* formatOf(std::string_view fileName);

/// The formats of pictures of surroundings, which nodes of the type `environment` read.
enum class RadianceFormat : std::uint8_t { Hdr, Exr };

/// By the extension of the file's name, in either case; nothing if it is no such format.
std::optional<RadianceFormat> radianceFormatOf(std::string_view fileName);

/// "Radiance HDR (.hdr) and OpenEXR (.exr)", for messages.
std::string radianceFormats();

/// The name of a 3D format that is recognised in order to be refused ("Blender"), or nothing.
std::optional<std::string> refusedFormat(std::string_view fileName);

/// "OBJ, 3DS, glTF 2.0 (.gltf, .glb), COLLADA (.dae), FBX, PLY and STL", for messages.
std::string allowedFormats();

}  // namespace stadion
