#include "show/base/plugins.h"

#include "dynamics/nodes/dynamics_nodes.h"
#include "engine/base/plain_file.h"
#include "engine/build/plugin.h"
#include "engine/nodes/engine_nodes.h"

#include <algorithm>
#include <cstdlib>
#include <dlfcn.h>
#include <filesystem>
#include <fmt/format.h>
#include <memory>

namespace stadion {
namespace {

constexpr std::size_t kMostPluginBytes = std::size_t{1} << 30;  ///< of a plugin's file

/// The plugin, or why the library is none.
Result<const Plugin*> pluginIn(const std::string& path) {
  using Result = Result<const Plugin*>;
  void* library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    const char* reason = dlerror();
    return Result::failure(fmt::format("cannot be loaded: {}", reason ? reason : "unknown reason"));
  }
  const auto find = reinterpret_cast<const Plugin* (*)()>(dlsym(library, "stadion_plugin"));
  if (find == nullptr) return Result::failure("is no plugin of Stadion: it has no function stadion_plugin");
  const Plugin* plugin = find();
  if (plugin == nullptr) return Result::failure("is no plugin of Stadion: stadion_plugin() returns null");
  if (plugin->format != kPluginFormat || plugin->layout != pluginLayout())
    return Result::failure(fmt::format(
        "was built for another version of Stadion (interface {}.{:08x}; this program has {}.{:08x}); build "
        "it again with the headers of this program",
        plugin->format, plugin->layout, kPluginFormat, pluginLayout()));
  if (plugin->name == nullptr || *plugin->name == '\0' || plugin->version == nullptr ||
      plugin->addTo == nullptr)
    return Result::failure("has no name, no version or no node types");
  return plugin;
}

/// Why the plugin in this file cannot be used; empty if it was added.
std::string addPlugin(const std::string& file, NodeRegistry& types) {
  std::error_code error;
  const std::filesystem::path path = std::filesystem::absolute(file, error);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> opened(std::fopen(path.c_str(), "rb"), std::fclose);
  if (!opened) return "cannot be opened; is the path right?";
  const auto bytes = readPlainFile(fileno(opened.get()), file, kMostPluginBytes);
  if (!bytes) return bytes.error().message;
  const auto plugin = pluginIn(path.string());
  if (!plugin) return plugin.error().message;
  const Plugin& p = *plugin.value();
  if (std::ranges::find(types.plugins(), p.name, &PluginIdentity::name) != types.plugins().end())
    return fmt::format("is called \"{}\", as a plugin that is loaded already", p.name);
  StateHash hash;
  hash.add(std::string_view(bytes.value()));
  types.addPlugin({p.name, p.version, fmt::format("{:016x}", hash.value())});
  NodeRegistrar registrar(types, fmt::format("the plugin {} {}", p.name, p.version));
  p.addTo(registrar);
  return registrar.fault().value_or("");
}

}  // namespace

Result<SharedTypes> nodesWith(const std::vector<std::string>& files) {
  auto types = std::make_shared<NodeRegistry>();
  addEngineNodes(*types);
  addDynamicsNodes(*types);
  for (const std::string& file : files)
    if (const std::string why = addPlugin(file, *types); !why.empty())
      return Result<SharedTypes>::failure(fmt::format("{} {}", file, why));
  return SharedTypes(std::move(types));
}

}  // namespace stadion
