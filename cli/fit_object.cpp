#include "cli/fit_object.h"

#include "engine/asset/import.h"
#include "engine/script/choice.h"
#include "engine/script/script.h"
#include "engine/script/suggestion.h"

#include <filesystem>

namespace stadion {
namespace {

using Read = Result<FlownObject>;

/// What is asked of the importer, and of the mass.
struct Wanted {
  std::string file;
  ImportOptions options;
  Vec3 scale = Vec3::Ones();
  double density = 1000;  ///< [kg/m3]
  std::optional<double> mass;
  std::optional<Vec3> nose;
  SourcePosition where;
};

Read imported(const Wanted& w, AssetRoots roots) {
  Importer importer(Importer::programBesideThis(), std::move(roots));
  auto mesh = importer.load(w.file, w.options, w.where);
  if (!mesh) return mesh.error();
  FlownObject object{std::move(*mesh.value()), {}, w.nose};
  for (auto& p : object.mesh.positions)
    for (std::size_t i = 0; i < 3; ++i) p[i] *= static_cast<float>(w.scale[static_cast<Eigen::Index>(i)]);
  const auto mass = massOfMesh(object.mesh, w.density);
  if (!mass) {
    Diagnostic wrong = mass.error();
    wrong.where = w.where, wrong.message = w.file + " " + wrong.message + "; only a closed model has a mass";
    return wrong;
  }
  object.mass = w.mass ? mass.value().withMass(*w.mass) : mass.value();
  return object;
}

Read fromModel(const std::string& file, const std::vector<std::string>& further, std::optional<double> mass) {
  const std::filesystem::path path(file);
  AssetRoots roots;
  if (!roots.add(path.has_parent_path() ? path.parent_path() : "."))
    return Read::failure("there is no folder " + path.parent_path().string());
  for (const std::string& r : further)
    if (!roots.add(r)) return Read::failure("--asset-root: cannot open the folder " + r);
  Wanted w;
  w.file = path.filename().string(), w.mass = mass;
  return imported(w, std::move(roots));
}

Read fromScript(const std::string& file, const std::string& name, const std::vector<std::string>& further,
                std::optional<double> mass) {
  auto source = SourceText::read(file);
  if (!source) return source.error();
  Diagnostics findings;
  const Document document = parseScript(std::move(source.value()), findings);
  for (const Diagnostic& d : findings.all())
    if (d.severity == Severity::Error) return d;
  std::vector<std::string> names;
  for (const Declaration d : document)
    if (d.kind() == NodeKind::DynObject) names.emplace_back(d.name());
  const auto found = document.find(name);
  if (!found || found->kind() != NodeKind::DynObject) {
    Diagnostic wrong;
    wrong.where.file = file;
    wrong.message = "has no dynobject \"" + name + "\"" + didYouMean(name, names);
    return wrong;
  }
  const Declaration& d = *found;
  AssetRoots roots = AssetRoots::ofScript(file);
  for (const std::string& r : further)
    if (!roots.add(r)) return Read::failure("--asset-root: cannot open the folder " + r);
  Wanted w;
  w.file = std::string(d.text(Attr::File)), w.where = d.where(Attr::File);
  w.options.unit = d.optionalNumber(Attr::Unit);
  w.options.up = d.optionalChoice<UpAxis>(Attr::Up);
  w.scale = d.vec3(Attr::Scale), w.density = 1000 * d.number(Attr::Density);
  w.mass = mass ? mass : d.optionalNumber(Attr::Mass);
  if (d.has(Attr::Nose)) w.nose = d.vec3(Attr::Nose).normalized();
  return imported(w, std::move(roots));
}

}  // namespace

Read readFlownObject(const std::string& object, const std::vector<std::string>& roots,
                     std::optional<double> massStated) {
  const std::size_t colon = object.rfind(':');
  if (colon != std::string::npos && colon > 4 && object.compare(colon - 4, 4, ".evs") == 0)
    return fromScript(object.substr(0, colon), object.substr(colon + 1), roots, massStated);
  if (object.ends_with(".evs"))
    return Read::failure(object + " is a whole script: write " + object + ":NAME for one of its dynobjects");
  return fromModel(object, roots, massStated);
}

}  // namespace stadion
