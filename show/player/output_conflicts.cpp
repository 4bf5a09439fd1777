#include "show/player/output_conflicts.h"

#include "show/player/player.h"
#include "show/player/script_assets.h"
#include "show/player/show_files.h"

#include <filesystem>

namespace stadion {
namespace {

bool isThere(const NamedFile& output) {
  std::error_code none;
  return output.written && !output.file.empty() && std::filesystem::is_regular_file(output.file, none);
}

}  // namespace

void refuseOverwriting(std::span<const ShowOptions> shows, std::span<const NamedFile> named,
                       Diagnostics& findings) {
  std::vector<NamedFile> files;
  std::vector<std::string> outputs;
  for (const NamedFile& file : named)
    if (isThere(file)) outputs.push_back(file.file);
  for (const ShowOptions& show : shows) {
    const std::vector<NamedFile> own = filesOf(show);
    files.insert(files.end(), own.begin(), own.end());
    if (!outputs.empty() && !show.script.empty())
      addAssetsOf(show.script, show.roots(), *show.types, outputs, files);
  }
  files.insert(files.end(), named.begin(), named.end());
  refuseSameFiles(files, findings);
}

}  // namespace stadion
