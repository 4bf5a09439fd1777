/// `stadion nodes [TYPE]`: the language reference, and what editors need to know of it.

#include "cli/commands.h"
#include "cli/exit_code.h"
#include "cli/options/command_options.h"
#include "cli/options/plugin_option.h"
#include "engine/base/atomic_file.h"
#include "engine/base/diagnostic.h"
#include "engine/plain_text/suggestion.h"
#include "engine/script/reference.h"
#include "show/base/standard_nodes.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>

namespace stadion {
namespace {

int printReference(const NodeRegistry& types, const std::string& type) {
  if (type.empty()) {
    std::printf("%s", languageReference(types).c_str());
    return kOk;
  }
  if (const RegisteredType* known = types.named(type)) {
    std::printf("%s", languageReference(types, *known).c_str());
    return kOk;
  }
  const auto meant = closest(type, types.names());
  std::fprintf(stderr, "stadion: there is no node type \"%s\"%s\n", type.c_str(),
               meant ? ("; " + didYouMeanOne(type, *meant)).c_str() : "; `stadion nodes` lists them");
  return kBadInput;
}

int writeEditorFiles(const NodeRegistry& types, const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  for (const auto& [name, content] : {std::pair{"evs.tmLanguage.json", editorGrammar(types)},
                                      std::pair{"evs.completion.json", editorCompletion(types)}}) {
    const std::string path = folder + "/" + name;
    if (const auto wrong = writeFile(path, content)) {
      std::fprintf(stderr, "%s\n", format(*wrong).c_str());
      return kBadInput;
    }
    std::printf("%s\n", path.c_str());
  }
  return kOk;
}

}  // namespace

void addNodesCommand(CLI::App& app, int& code) {
  struct Options {
    std::string type, out;
    std::vector<std::string> plugins;
    SharedTypes types = standardNodes();
  };
  auto o = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("nodes", "Print the language reference: node types, attributes, events, commands");
  CommandOptions options(*command);
  options.add("TYPE", o->type);
  options.add("--out", o->out);
  addPluginOption(*command, o->plugins, o->types);
  command->footer(
      "--out DIR receives a TextMate grammar, evs.tmLanguage.json, and a completion file for editors, "
      "evs.completion.json.");
  command->callback([o, &code] {
    code = o->out.empty() ? printReference(*o->types, o->type) : writeEditorFiles(*o->types, o->out);
  });
}

}  // namespace stadion
