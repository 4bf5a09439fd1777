#include "cli/fit_object.h"

#include "cli/enclosing_show.h"
#include "dynamics/nodes/dynamics_factories.h"

#include "dynamics/nodes/dyn_object_node.h"
#include "engine/asset/import.h"
#include "engine/script/choice.h"
#include "engine/script/script.h"
#include "engine/script/suggestion.h"

#include <filesystem>

namespace stadion {
namespace {

using Read = Result<FlownObject>;

/// What is asked of the importer, and what the script says of the body.
struct Wanted {
  std::string file;
  ImportOptions options;
  Appearance appearance;
  Vec3 scale = Vec3::Ones();
  BodyAttributes body;
  SourcePosition where;
};

Read imported(const Wanted& w, const StatedMatter& stated, AssetRoots roots) {
  Importer importer(Importer::programBesideThis(), std::move(roots));
  const auto model = importer.load(w.file, w.options, w.where);
  if (!model) return model.error();
  const auto fail = [&](const std::string& why) {
    Diagnostic wrong;
    wrong.where = w.where, wrong.message = w.file + " " + why;
    return wrong;
  };
  ShapeStore shapes;
  const auto fit = shapes.fit(*model.value(), w.appearance, w.scale);
  if (!fit) return fail(fit.error().message);
  const Result<MassProperties>& filled = fit.value()->filled;
  if (!filled) return fail(filled.error().message + "; only a closed model has a mass");
  FlownObject object{scaled(*model.value(), w.scale.cast<float>()), {}, w.body.nose};
  BodyAttributes body = w.body;
  if (stated.mass) body.mass = stated.mass;
  if (stated.centre) body.centre = stated.centre;
  object.mass = body.massOf(*fit.value());
  if (!stated.moments) return object;
  body.inertia = momentsOf(*stated.moments, measureShape(object.mesh, object.mass.centre, object.nose));
  object.mass = body.massOf(*fit.value());
  return object;
}

Read fromModel(const std::string& file, const std::vector<std::string>& further, const StatedMatter& stated) {
  const std::filesystem::path path(file);
  AssetRoots roots;
  if (!roots.add(path.has_parent_path() ? path.parent_path() : "."))
    return Read::failure("there is no folder " + path.parent_path().string());
  for (const std::string& r : further)
    if (!roots.add(r)) return Read::failure("--asset-root: cannot open the folder " + r);
  Wanted w;
  w.file = path.filename().string();
  return imported(w, stated, std::move(roots));
}

Read fromScript(const std::string& file, const std::string& name, const std::vector<std::string>& further,
                const StatedMatter& stated) {
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
  AssetRoots roots = AssetRoots::ofScript(showAround(file, further).value_or(file));
  for (const std::string& r : further)
    if (!roots.add(r)) return Read::failure("--asset-root: cannot open the folder " + r);
  Wanted w;
  w.file = std::string(d.text(Attr::File)), w.where = d.where(Attr::File);
  w.options.unit = d.optionalNumber(Attr::Unit);
  w.options.up = d.optionalChoice<UpAxis>(Attr::Up);
  w.appearance.shape = std::string(d.text(Attr::Shape)), w.appearance.tolerance = d.number(Attr::Tolerance);
  w.scale = d.vec3(Attr::Scale);
  w.body = bodyAttributesOf(d);
  return imported(w, stated, std::move(roots));
}

}  // namespace

Vec3 momentsOf(const Vec2& alongAndAcross, const FlightShape& shape) {
  const auto [along, across] = std::pair(alongAndAcross.x(), alongAndAcross.y());
  return shape.elongated() ? Vec3(along, across, across) : Vec3(across, across, along);
}

Read readFlownObject(const std::string& object, const std::vector<std::string>& roots,
                     const StatedMatter& stated) {
  const std::size_t colon = object.rfind(':');
  if (colon != std::string::npos && colon > 4 && object.compare(colon - 4, 4, ".evs") == 0)
    return fromScript(object.substr(0, colon), object.substr(colon + 1), roots, stated);
  if (object.ends_with(".evs"))
    return Read::failure(object + " is a whole script: write " + object + ":NAME for one of its dynobjects");
  return fromModel(object, roots, stated);
}

}  // namespace stadion
