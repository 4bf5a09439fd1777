#pragma once
/// A show of one model, for `stadion view MODEL`.
///
/// The model stands in the world as its file places it, in its true size. The visitor stands south of it and
/// looks north (+Y) at its middle, so far away that the front wall shows all of it.
///
/// Threads  one.
/// Errors   go to the findings.

#include "engine/base/diagnostic.h"
#include "show/base/temporary_folder.h"

#include <filesystem>
#include <memory>
#include <string>

namespace stadion {

class ModelShow {
public:
  /// Returns true if the file's name is that of a model.
  static bool isModel(const std::string& file);

  /// Imports the model, because the visitor's place depends on its size, and writes the script. Null if the
  /// model cannot be read. What the show is without (lights, clips, ...) is told when the script is loaded.
  static std::unique_ptr<ModelShow> make(const std::string& model,
                                         const std::filesystem::path& importerProgram, Diagnostics& findings);

  /// The script; it is removed with this object.
  std::string script() const { return folder_.path("model.evs"); }
  /// The model's folder. The script finds the model only if this is one of the show's asset roots.
  const std::string& assetRoot() const { return assetRoot_; }

private:
  explicit ModelShow(std::string assetRoot) : assetRoot_(std::move(assetRoot)) {}

  TemporaryFolder folder_;
  std::string assetRoot_;
};

}  // namespace stadion
