#include "show/doctor/doctor_needs.h"

#include "engine/asset/roots.h"
#include "engine/base/installed_files.h"
#include "engine/hall_formats/hall_import.h"
#include "engine/plain_text/suggestion.h"
#include "engine/script/script.h"
#include "engine/script/script_texts.h"
#include "pipeline/cluster/cluster_file.h"
#include "show/base/standard_nodes.h"

#include <algorithm>
#include <filesystem>

namespace stadion {
namespace {

/// Whether the word names walls that ship with Stadion, such as cave4.
bool isBuiltInRoom(const std::string& word) {
  std::error_code unreadable;
  return word.find('/') == word.npos &&
         std::filesystem::exists(shareFolder() + "/walls/" + word + ".walls", unreadable);
}

bool hasSounds(const SourceText& text, const NodeRegistry& types) {
  Diagnostics ignored;  // check reports them
  const Document document = parseScript(text, types, ignored);
  for (const Declaration d : document)
    if (d.kind() == "sound") return true;
  return false;
}

}  // namespace

std::unique_ptr<MachineNeeds> MachineNeeds::read(const std::vector<std::string>& words,
                                                 Diagnostics& findings) {
  auto wanted = std::make_unique<MachineNeeds>();
  bool all = true;
  for (const std::string& word : words) all &= wanted->add(word, findings);
  return all ? std::move(wanted) : nullptr;
}

DoctorNeeds MachineNeeds::needs() const {
  DoctorNeeds needs;
  needs.topics = topics_;
  needs.interfaces = interfaces_;
  for (const WallFile& walls : walls_) needs.walls.push_back(&walls);
  return needs;
}

bool MachineNeeds::add(const std::string& word, Diagnostics& findings) {
  if (word.ends_with(".evs")) return addShow(word, findings);
  if (word.ends_with(".walls") || isBuiltInRoom(word)) return addWalls(word, findings);
  if (word.ends_with(".cluster")) return addCluster(word, findings);
  if (word == "cluster") {
    topics_.insert(topics_.end(), {"programs", "network"});
    return true;
  }
  const auto topics = doctorTopics();
  if (std::ranges::find(topics, word) != topics.end()) {
    topics_.push_back(word);
    return true;
  }
  std::vector<std::string> known(topics.begin(), topics.end());
  known.emplace_back("cluster");
  findings.error(
      {},
      "--for: \"" + word +
          "\" is no show (.evs), wall file (.walls), room (cave4, ...), cluster file (.cluster) or topic" +
          didYouMean(word, known) + "; stadion doctor --help lists the topics");
  return false;
}

bool MachineNeeds::addShow(const std::string& file, Diagnostics& findings) {
  const SharedTypes types = standardNodes();
  const auto texts = ScriptTexts::read(file, AssetRoots::ofScript(file), *types);
  const auto show = texts->show();
  if (!show) {
    findings.add(show.error());
    return false;
  }
  topics_.insert(topics_.end(), {"programs", "drawing"});
  bool sounds = hasSounds(show.value(), *types);
  for (const std::string& name : texts->parts())
    if (const auto part = texts->part(name)) sounds |= hasSounds(part.value(), *types);
  if (sounds) topics_.emplace_back("sound");
  return true;
}

bool MachineNeeds::addWalls(const std::string& file, Diagnostics& findings) {
  auto walls = loadHall(file, shareFolder() + "/walls", findings);
  if (!walls) return false;
  topics_.insert(topics_.end(), {"programs", "drawing", "displays"});
  walls_.push_back(std::move(*walls));
  return true;
}

bool MachineNeeds::addCluster(const std::string& file, Diagnostics& findings) {
  const auto cluster = loadCluster(file, findings);
  if (!cluster) return false;
  topics_.insert(topics_.end(), {"programs", "network"});
  if (!cluster->interface.empty()) interfaces_.push_back(cluster->interface);
  return true;
}

}  // namespace stadion
