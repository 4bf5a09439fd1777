#pragma once
/// The folder of `run --out DIR`. A run removes what an earlier run wrote there, and nothing else. A hidden
/// list, `.stadion-files`, holds the names of all files written. A name is added before its file is written,
/// so the files of a killed run are removed as well.
///
/// Ownership  one run at a time: the list is locked while the run lasts.
/// Threads    one at a time.

#include "engine/base/diagnostic.h"
#include "engine/base/file_descriptor.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace stadion {

class OutputFolder {
public:
  /// Makes the folder if need be. The error says why a run cannot write there (or that another one does).
  static Result<std::unique_ptr<OutputFolder>> open(const std::string& path);

  /// Returns the names of all files that a run may write into the folder, which need not exist. Adds existing
  /// files there that a run would remove or overwrite.
  static std::vector<std::string> namesOfRuns(const std::string& path);

  /// Removes the files of the run before. Returns how many there were.
  std::size_t clear();

  /// Notes that the file `name` will be written; to be called before it is. Nothing if all went well.
  std::optional<Diagnostic> note(const std::string& name);
  std::string pathOf(const std::string& name) const { return path_ + "/" + name; }

private:
  OutputFolder(std::string path, FileDescriptor folder, FileDescriptor list)
      : path_(std::move(path)), folder_(std::move(folder)), list_(std::move(list)) {}

  std::string path_;
  FileDescriptor folder_, list_;
  std::vector<std::string> earlier_;
};

}  // namespace stadion
