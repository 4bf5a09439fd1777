#include "show/view/model_show.h"

#include "engine/asset/import.h"
#include "engine/base/atomic_file.h"
#include "engine/figure/skinning.h"

#include <fmt/format.h>

#include <algorithm>

namespace stadion {
namespace {

constexpr double kEyeHeight = 1.7;      ///< of the head above the rig [m]
constexpr double kRadiiAway = 2.2;      ///< distance from the model's middle, in radii of its bounding sphere
constexpr double kLeastDistance = 0.5;  ///< [m] nearer than this, eyes cannot look at a thing

/// Where a figure is while it plays its first clip: its bounding sphere is for all clips and blends.
Sphere playedSphere(const Mesh& mesh) {
  constexpr int kPoses = 8;
  const Skeleton& skeleton = *mesh.skeleton;
  FigureRecord playing;
  playing.layerCount = skeleton.clips.empty() ? 0 : 1;
  FigurePose pose;
  std::vector<SkinnedVertex> vertices(mesh.positions.size());
  Aabb box;
  for (int i = 0; i < kPoses; ++i) {
    if (playing.layerCount > 0) playing.layers[0].time = skeleton.clips[0].length * i / kPoses;
    pose.set(skeleton, playing);
    skin({mesh.positions, mesh.normals, mesh.joints}, pose.palette(), 0, vertices);
    for (const SkinnedVertex& v : vertices)
      box.include(Vec3(double{v.position[0]}, double{v.position[1]}, double{v.position[2]}));
  }
  return box.empty() ? mesh.sphere : Sphere{box.centre(), 0.5 * (box.hi - box.lo).norm()};
}

/// The line of the script that shows the model.
std::string nodeOf(const std::string& name, const Mesh& mesh) {
  if (!mesh.skeleton) return fmt::format("object( name=model, file=\"{}\" )", name);
  const auto& clips = mesh.skeleton->clips;
  const bool plays = !clips.empty() && clips[0].name.find_first_of("\"\n\\") == std::string::npos;
  return fmt::format("figure( name=model, file=\"{}\"{} )", name,
                     plays ? fmt::format(", clip=\"{}\"", clips[0].name) : "");
}

std::string clipsOf(const Skeleton& skeleton) {
  std::string all;
  for (const Clip& clip : skeleton.clips)
    all += fmt::format("{}\"{}\" ({:.3g} s)", all.empty() ? "" : ", ", clip.name, clip.length);
  return all;
}

template <class Things>
std::string namesOf(const Things& things) {
  std::string all;
  for (const auto& thing : things) all += fmt::format("{}\"{}\"", all.empty() ? "" : ", ", thing.name);
  return all;
}

/// Tells what of the file a show can name.
void noteContent(const Mesh& mesh, const SourcePosition& where, Diagnostics& findings) {
  if (mesh.skeleton && !mesh.skeleton->clips.empty())
    findings.note(where, "its clips, of which the first plays: " + clipsOf(*mesh.skeleton));
  if (!mesh.lights.empty())
    findings.note(where, "its lights, for light( parent=, source=NAME ): " + namesOf(mesh.lights));
  if (!mesh.cameras.empty())
    findings.note(where, "its cameras, for rig( model=, camera=NAME ): " + namesOf(mesh.cameras));
}

std::string scriptOf(const std::string& name, const Mesh& mesh) {
  const Sphere sphere = mesh.skeleton ? playedSphere(mesh) : mesh.sphere;
  const Vec3 eye = sphere.centre - std::max(kRadiiAway * sphere.radius, kLeastDistance) * Vec3::UnitY();
  return fmt::format(R"(# The model {0}, alone.
rig( name=rig, position="{1:.6g}, {2:.6g}, {3:.6g}", eyeheight={4} )
sky( )
light( direction="-1, 2, -3", intensity=0.8 )
{5}
)",
                     name, eye.x(), eye.y(), eye.z() - kEyeHeight, kEyeHeight, nodeOf(name, mesh));
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
  ImportOptions options;
  options.form = ModelForm::Either;
  const auto mesh = importer.load(name, options, where);
  if (!mesh) {
    findings.add(mesh.error());
    return nullptr;
  }
  std::unique_ptr<ModelShow> show(new ModelShow(folder));
  if (auto failure = writeFile(show->script(), scriptOf(name, *mesh.value()))) {
    findings.add(*failure);
    return nullptr;
  }
  noteContent(*mesh.value(), where, findings);
  return show;
}

}  // namespace stadion
