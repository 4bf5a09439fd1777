#include "show/measure/fit_object.h"

#include "dynamics/nodes/body_maker.h"
#include "show/base/standard_nodes.h"
#include "show/player/show_of_part.h"

#include "dynamics/nodes/dyn_object_node.h"
#include "engine/asset/import.h"
#include "engine/build/builder.h"
#include "engine/plain_text/suggestion.h"
#include "engine/script/script.h"
#include "engine/script/script_texts.h"

#include <filesystem>
#include <fmt/format.h>

namespace stadion {
namespace {

using Read = Result<FlownObject>;

/// What is asked of the importer, and what the script says of the body.
struct FitRequest {
  std::string file;
  ImportOptions options;
  Appearance appearance;
  Vec3 scale = Vec3::Ones();
  BodyAttributes body;
  SourcePosition where;
};

/// What the script's own rules say of matter that the command line states: what they refuse, no show can
/// have.
std::optional<Diagnostic> refusedByScripts(const FitRequest& w, const Mesh& mesh, const StatedMatter& stated,
                                           const BodyAttributes& body, double mass) {
  const auto three = [](const char* name, const std::optional<Vec3>& v) {
    return v ? fmt::format(", {}=\"{:.17g}, {:.17g}, {:.17g}\"", name, v->x(), v->y(), v->z()) : "";
  };
  const char* const options[] = {"", "--mass", "--centre", "--inertia"};  // by line
  const auto source =
      SourceText::make("", "dynobject( name=body, file=body.obj\n" + fmt::format(", mass={:.17g}\n", mass) +
                               three("centre", body.centre) + "\n" + three("inertia", body.inertia) + " )\n");
  Diagnostics findings;
  const SharedTypes types = standardNodes();
  const Document document = parseScript(SourceText(source.value()), *types, findings);
  if (!findings.hasErrors()) {
    NodeServices services;
    const std::function<NodeRef(const NodeReference&)> resolve;
    const std::function<std::optional<PlacedModel>(const NodeReference&)> model;
    PlaceAttributes place;
    place.X_PN = Affine(Eigen::Scaling(w.scale));
    makeDynObject({document[0], {}, "body", place, w.appearance, &mesh, resolve, model, findings, services});
  }
  for (const Diagnostic& d : findings.all()) {
    if (d.severity != Severity::Error) continue;
    const std::size_t line = std::min<std::size_t>(std::max(d.where.line, 1U), std::size(options)) - 1;
    const bool ours = line == 1   ? stated.mass.has_value()
                      : line == 2 ? stated.centre.has_value()
                                  : line == 3 && stated.moments.has_value();
    Diagnostic wrong;
    wrong.message = (ours ? std::string(options[line]) : w.file) + ": " + d.message;
    return wrong;
  }
  return std::nullopt;
}

Read imported(const FitRequest& w, const StatedMatter& stated, AssetRoots roots) {
  Importer importer(Importer::installedProgram(), std::move(roots));
  const auto model = importer.load(w.file, w.options, w.where);
  if (!model) return model.error();
  const auto fail = [&](const std::string& why) {
    Diagnostic wrong;
    wrong.where = w.where;
    wrong.message = w.file + " " + why;
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
  if (stated.moments) {
    body.inertia = momentsOf(*stated.moments, measureShape(object.mesh, object.mass.centre, object.nose));
    object.mass = body.massOf(*fit.value());
  }
  if (auto wrong = refusedByScripts(w, *model.value(), stated, body, object.mass.mass)) return *wrong;
  return object;
}

Read fromModel(const std::string& file, const std::vector<std::string>& further, const StatedMatter& stated) {
  const std::filesystem::path path(file);
  AssetRoots roots;
  if (!roots.add(path.has_parent_path() ? path.parent_path() : "."))
    return Read::failure("there is no folder " + path.parent_path().string());
  for (const std::string& r : further)
    if (!roots.add(r)) return Read::failure("--asset-root: cannot open the folder " + r);
  FitRequest w;
  w.file = path.filename().string();
  return imported(w, stated, std::move(roots));
}

/// The sub-scene of a show that has this dynobject, as the user would name it.
std::optional<std::string> partWith(const std::string& name, const std::string& show, const AssetRoots& roots,
                                    const NodeRegistry& types) {
  const auto texts = ScriptTexts::read(show, roots, types);
  for (const std::string& part : texts->parts()) {
    auto source = texts->part(part);
    if (!source) continue;
    Diagnostics ignored;
    const std::string file = source.value().file();
    const Document document = parseScript(std::move(source.value()), types, ignored);
    if (const auto found = document.find(name); found && found->kind() == "dynobject") return file;
  }
  return std::nullopt;
}

Read fromScript(const std::string& file, const std::string& name, const std::vector<std::string>& further,
                const NodeRegistry& types, const StatedMatter& stated) {
  auto source = SourceText::read(file);
  if (!source) return source.error();
  Diagnostics findings;
  const Document document = parseScript(std::move(source.value()), types, findings);
  for (const Diagnostic& d : findings.all())
    if (d.severity == Severity::Error) return d;
  std::vector<std::string> names;
  for (const Declaration d : document)
    if (d.kind() == "dynobject") names.emplace_back(d.name());
  AssetRoots roots = AssetRoots::ofScript(showAround(file, further, types).value_or(file));
  for (const std::string& r : further)
    if (!roots.add(r)) return Read::failure("--asset-root: cannot open the folder " + r);
  const auto found = document.find(name);
  if (!found || found->kind() != "dynobject") {
    const auto part = partWith(name, file, roots, types);
    Diagnostic wrong;
    wrong.where.file = file;
    wrong.message = "has no dynobject \"" + name + "\"" +
                    (part ? fmt::format("; {0} has: write {0}:{1}", *part, name) : didYouMean(name, names));
    return wrong;
  }
  const Declaration& d = *found;
  FitRequest w;
  w.file = std::string(d.text("file"));
  w.where = d.where("file");
  w.options.unit = d.optionalNumber("unit");
  w.options.up = d.optionalChoice<UpAxis>("up");
  w.appearance.shape = std::string(d.text("shape"));
  w.appearance.tolerance = d.number("tolerance");
  w.scale = d.vec3("scale");
  w.body = bodyAttributesOf(d);
  return imported(w, stated, std::move(roots));
}

}  // namespace

Vec3 momentsOf(const Vec2& alongAndAcross, const FlightShape& shape) {
  const auto [along, across] = std::pair(alongAndAcross.x(), alongAndAcross.y());
  return shape.elongated() ? Vec3(along, across, across) : Vec3(across, across, along);
}

Read readFlownObject(const std::string& object, const std::vector<std::string>& roots,
                     const NodeRegistry& types, const StatedMatter& stated) {
  const std::size_t colon = object.rfind(':');
  if (colon != std::string::npos && colon > 4 && object.compare(colon - 4, 4, ".evs") == 0)
    return fromScript(object.substr(0, colon), object.substr(colon + 1), roots, types, stated);
  if (object.ends_with(".evs"))
    return Read::failure(object + " is a whole script: write " + object + ":NAME for one of its dynobjects");
  return fromModel(object, roots, stated);
}

}  // namespace stadion
