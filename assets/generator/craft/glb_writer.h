#pragma once
/// Binary glTF 2.0 piece by piece: a header, a chunk of JSON and a chunk of numbers. In the file +Y is up and
/// -Z forward.

#include "assets/generator/craft/figure_model.h"

#include <cstdio>
#include <string>
#include <vector>

namespace stadion::assets {

class GlbWriter {
public:
  /// Adds a primitive of the only mesh.
  void add(const Part& part) { primitive(part, "", false); }
  /// Its normals are bytes (KHR_mesh_quantization), and so are the bones' numbers if they are `narrow`.
  void add(const SkinnedPart& skinned, bool narrow);

  /// Adds numbers and returns the index of their accessor. `target`: 34962 corners' values, 34963 corners, 0
  /// others.
  int accessor(const std::string& bytes, int target, std::size_t count, int component, const char* type,
               const std::string& more, int stride = 0);
  /// Likewise, all in one view. To be called before the first accessor().
  void keepClipsTogether() { views_.push_back(""); }
  int clipAccessor(const std::string& bytes, std::size_t count, const char* type, const std::string& more);

  /// The file. `nodes` and `more` are the JSON of scenes and nodes, and of whatever else follows the meshes.
  std::string take(const std::string& nodes, const std::string& more = "");

private:
  void primitive(const Part& part, const std::string& more, bool quantized);
  int material(const Finish& finish);

  std::vector<std::string> primitives_, materials_, pictures_, accessors_, views_;
  std::string numbers_, clips_;
};

namespace glb {

void putWord(std::string& out, std::uint32_t v);
void put16(std::string& out, std::uint32_t v);
void putFloat(std::string& out, double v);
/// Turned into the file's axes.
void putPoint(std::string& out, Point p);
template <class... Values>
std::string text(const char* format, Values... values) {
  char line[400];
  std::snprintf(line, sizeof line, format, values...);
  return line;
}
/// As "[1,\n2]".
std::string joined(const std::vector<std::string>& items);

}  // namespace glb

}  // namespace stadion::assets
