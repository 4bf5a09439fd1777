#include "engine/asset/import.h"

#include "engine/asset/mesh_checks.h"
#include "engine/base/installed_files.h"

#include <cmath>
#include <sstream>

namespace stadion {
namespace {

using Outcome = Result<std::unique_ptr<Mesh>>;
using End = ImporterProcess::End;

std::string faultOf(const std::string& name, const ImportOptions& options) {
  if (options.form == ModelForm::Environment) {
    if (radianceFormatOf(name)) return {};
    return "\"" + name + "\" is no picture of surroundings; use " + radianceFormats();
  }
  if (radianceFormatOf(name))
    return "\"" + name + "\" is a picture of surroundings, not a model; an environment takes it";
  if (!formatOf(name)) {
    const auto known = refusedFormat(name);
    return "\"" + name + "\" is " +
           (known ? "in the format " + *known + ", which shows do not read" : "not a model file") + "; use " +
           allowedFormats();
  }
  if (options.unit && !(*options.unit >= 1e-6 && *options.unit <= 1e6))
    return "the unit of \"" + name + "\" must lie between 1e-6 and 1e6 metres";
  if (textOf(options.nodes).size() > kLongestSelection)
    return "the script names too many parts of \"" + name + "\"";
  return {};
}

RequestHead requestFor(const ImportOptions& options, const ImportLimits& limits) {
  RequestHead head;
  head.addressSpace = limits.addressSpace;
  head.fileBytes = limits.fileBytes;
  head.cpuSeconds = static_cast<std::uint32_t>(limits.timeout.count() / 1000 + 1);
  head.nodeDepth = limits.nodeDepth;
  head.mesh = limits.mesh;
  head.unit = options.unit.value_or(0);
  head.up = options.up ? static_cast<std::uint32_t>(*options.up) + 1 : 0;
  head.form = options.form;
  return head;
}

std::string sentence(const ImporterProcess::Answer& answer, const std::string& path,
                     const std::filesystem::path& program, const ImportLimits& limits) {
  std::ostringstream text;
  switch (answer.end) {
  case End::OutOfMemory: text << "the importer ran out of memory on \"" << path << "\""; break;
  case End::OutOfTime:
    text << "the importer ran out of time on \"" << path << "\" (" << limits.timeout.count() / 1000.0
         << " s)";
    break;
  case End::Crashed:
    text << "the importer crashed on \"" << path << "\"";
    if (!answer.text.empty()) text << " (" << answer.text << ")";
    break;
  case End::Nonsense: text << "the importer answered nonsense on \"" << path << "\""; break;
  case End::NotStarted:
    text << "the importer program " << program.string() << " cannot be started: " << answer.text;
    break;
  case End::Loaded:
  case End::Failed: text << "\"" << path << "\" " << answer.text; break;
  }
  std::string line = text.str();
  for (char& c : line)
    if (c == '\n') c = ' ';
  while (!line.empty() && (line.back() == '.' || line.back() == ' ')) line.pop_back();
  return line;
}

void addLosses(const ModelInventory& inventory, const std::string& path, const SourcePosition& where,
               Diagnostics& losses) {
  for (const ContentItem& item : inventory.items())
    if (item.use != ContentUse::Used)
      losses.warning(where, "\"" + path + "\": " + std::string(nameOf(item.use)) + ": " + item.text);
}

}  // namespace

Importer::Importer(std::filesystem::path program, AssetRoots roots, ImportLimits limits)
    : roots_(std::move(roots)), limits_(limits), process_(std::move(program)) {}

Outcome Importer::load(const std::string& name, const ImportOptions& options, const SourcePosition& where,
                       Diagnostics* losses, ModelInventory* inventory) {
  const auto fail = [&](std::string message) {
    return Outcome(Diagnostic{Severity::Error, where, std::move(message), {}});
  };
  const auto found = roots_.open(name);
  if (!found) return fail(found.error().message);
  if (const std::string fault = faultOf(name, options); !fault.empty()) return fail(fault);
  const std::lock_guard lock(mutex_);
  const auto& path = found.value().path;
  const auto answer = process_.ask(requestFor(options, limits_), found.value().root, name, options.nodes,
                                   limits_.timeout, limits_.giveUp);
  if (answer.end != End::Loaded) return fail(sentence(answer, path, process_.program(), limits_));
  auto mesh = decode(answer.mesh, limits_.mesh);
  if (!mesh) return fail("the importer made of \"" + path + "\" " + mesh.error().message);
  mesh.value()->name = name;
  finish(*mesh.value());
  ModelInventory content = ModelInventory::fromText(answer.text);
  if (losses) addLosses(content, path, where, *losses);
  if (inventory) *inventory = std::move(content);
  return mesh;
}

std::filesystem::path Importer::installedProgram() {
  return helperProgram("stadion-import");
}

int Importer::started() const {
  const std::lock_guard lock(mutex_);
  return process_.started();
}

int Importer::pid() const {
  const std::lock_guard lock(mutex_);
  return process_.pid();
}

}  // namespace stadion
