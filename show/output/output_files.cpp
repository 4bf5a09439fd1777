#include "show/output/output_files.h"

#include <filesystem>
#include <utility>

namespace stadion {

OutputFiles::OutputFiles(std::string folder, std::vector<std::string> names)
    : folder_(std::move(folder)), names_(std::move(names)) {}

std::vector<NamedFile> OutputFiles::named() const {
  std::vector<NamedFile> all;
  if (areWanted())
    for (const std::string& name : names_) all.push_back({"--out's " + name, folder_ + "/" + name});
  return all;
}

bool OutputFiles::open(Diagnostics& findings) {
  if (!areWanted()) return true;
  std::error_code unmade;  // reported when a file is opened
  std::filesystem::create_directories(folder_, unmade);
  for (const std::string& name : names_) {
    const auto [at, isNew] = files_.try_emplace(name, folder_ + "/" + name);
    if (const auto& wrong = at->second.file.error()) {
      findings.add(*wrong);
      return false;
    }
  }
  return true;
}

void OutputFiles::write(const std::string& name, std::string_view content) {
  if (!areWanted()) return;
  File& one = files_.at(name);
  one.file.write(content);
  one.isWritten = true;
}

bool OutputFiles::commit(Diagnostics& findings) {
  bool well = true;
  for (auto& [name, one] : files_)
    if (const auto wrong = one.isWritten ? one.file.commit() : std::nullopt) {
      findings.add(*wrong);
      well = false;
    }
  return well;
}

}  // namespace stadion
