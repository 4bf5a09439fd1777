#include "engine/asset/check.h"

#include <algorithm>

namespace stadion {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> modelsBelow(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::recursive_directory_iterator at(folder, fs::directory_options::skip_permission_denied, error), end;
       !error && at != end; at.increment(error)) {
    std::error_code ignored;
    if (at->is_symlink(ignored) || !at->is_regular_file(ignored)) continue;
    const std::string name = at->path().lexically_relative(folder).string();
    if (formatOf(name) || radianceFormatOf(name) || refusedFormat(name)) names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

Result<AssetCounts> checkAssets(const fs::path& importerProgram, const fs::path& place,
                                const std::function<void(const AssetFinding&)>& tell,
                                const ImportLimits& limits) {
  std::error_code ignored;
  const bool single = fs::is_regular_file(place, ignored);
  const fs::path folder = !single ? place : place.has_parent_path() ? place.parent_path() : fs::path(".");
  AssetRoots roots;
  if (!roots.add(folder))
    return Result<AssetCounts>::failure("\"" + place.string() +
                                        "\" is not a model or folder that can be opened");
  Importer importer(importerProgram, std::move(roots), limits);
  AssetCounts counts;
  for (const std::string& name : single ? std::vector{place.filename().string()} : modelsBelow(folder)) {
    AssetFinding finding;
    finding.file = name;
    const bool isEnvironment = radianceFormatOf(name).has_value(), readable = isEnvironment || formatOf(name);
    ImportOptions options;
    options.form = isEnvironment ? ModelForm::Environment : ModelForm::Either;
    auto mesh = importer.load(name, options, {name, 0, 0}, &finding.losses, &finding.inventory);
    finding.verdict = mesh ? AssetVerdict::Loaded : readable ? AssetVerdict::Failed : AssetVerdict::Refused;
    if (mesh)
      finding.mesh = mesh.value().get();
    else
      finding.message = mesh.error().message;
    ++(mesh ? counts.loaded : readable ? counts.failed : counts.refused);
    // A program that crashed has ended; after an ordinary failure it waits for the next file.
    if (!mesh && readable && importer.pid() == 0) ++counts.faults;
    tell(finding);
  }
  return counts;
}

}  // namespace stadion
