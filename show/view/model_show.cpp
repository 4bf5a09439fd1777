#include "show/view/model_show.h"

#include "engine/asset/import.h"
#include "engine/base/atomic_file.h"

#include <fmt/format.h>

#include <algorithm>

namespace stadion {
namespace {

constexpr double kEyeHeight = 1.7;      ///< of the head above the rig [m]
constexpr double kRadiiAway = 2.2;      ///< distance from the model's middle, in radii of its bounding sphere
constexpr double kLeastDistance = 0.5;  ///< [m] nearer than this, eyes cannot look at a thing

std::string scriptOf(const std::string& name, const Sphere& sphere) {
  const Vec3 eye = sphere.centre - std::max(kRadiiAway * sphere.radius, kLeastDistance) * Vec3::UnitY();
  return fmt::format(R"(# The model {0}, alone.
rig( name=rig, position="{1:.6g}, {2:.6g}, {3:.6g}", eyeheight={4} )
sky( )
light( direction="-1, 2, -3", intensity=0.8 )
object( name=model, file="{0}" )
)",
                     name, eye.x(), eye.y(), eye.z() - kEyeHeight, kEyeHeight);
}

}  // namespace

bool ModelShow::isModel(const std::string& file) {
  return formatOf(file) || refusedFormat(file);
}

std::unique_ptr<ModelShow> ModelShow::make(const std::string& model,
                                           const std::filesystem::path& importerProgram,
                                           Diagnostics& findings) {
  const std::filesystem::path path(model);
  const std::string folder = path.has_parent_path() ? path.parent_path().string() : ".",
                    name = path.filename().string();
  const SourcePosition where{model, 0, 0};
  AssetRoots roots;
  if (!roots.add(folder)) {
    findings.error(where, "the folder \"" + folder + "\" cannot be opened");
    return nullptr;
  }
  if (name.find_first_of("\"\n") != std::string::npos) {
    findings.error(where, "a script cannot name a file with a quotation mark or a line break: rename it");
    return nullptr;
  }
  Importer importer(importerProgram, std::move(roots));
  const auto mesh = importer.load(name, {}, where);
  if (!mesh) {
    findings.add(mesh.error());
    return nullptr;
  }
  std::unique_ptr<ModelShow> show(new ModelShow(folder));
  if (auto failure = writeFile(show->script(), scriptOf(name, mesh.value()->sphere))) {
    findings.add(*failure);
    return nullptr;
  }
  return show;
}

}  // namespace stadion
