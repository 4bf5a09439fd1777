#include "tests/fuzz/built_show.h"

#include "dynamics/nodes/body_maker.h"
#include "engine/asset/import.h"
#include "engine/asset/sound_file.h"
#include "engine/script/script.h"
#include "tests/fuzz/targets.h"
#include "tests/node_types.h"

#include <cmath>

namespace stadion::fuzz {
namespace {

constexpr const char* kFolder = STADION_SOURCE_DIR "/tests/fuzz/shows/";

/// By what they are asked for; read once.
const std::map<std::string, Document>& documents() {
  static const std::map<std::string, Document> kDocuments = [] {
    std::map<std::string, Document> all;
    const auto read = [&](const std::string& name, const std::string& path,
                          std::vector<const Document*> enclosing) {
      auto source = SourceText::read(path);
      require(static_cast<bool>(source), "the show is there");
      Diagnostics findings;
      Document& document = all.emplace(name, parseScript(std::move(source.value()), testTypes(), findings)).first->second;
      resolveNames(document, {std::move(enclosing), [](Declaration) { return nullptr; }}, findings);
      for (const Diagnostic& d : findings.all()) std::fprintf(stderr, "%s\n", format(d).c_str());
      require(!findings.hasErrors(), "the show is right");
    };
    for (const auto& [show, bodies] : kShows)
      read(std::string(show), kFolder + std::string(show) + ".evs", {});
    read("part.evs", STADION_SOURCE_DIR "/tests/corpus/shows/part.evs", {&all.at("everything")});
    read("sub.evs", std::string(kFolder) + "sub.evs", {&all.at("parts")});
    return all;
  }();
  return kDocuments;
}

}  // namespace

Workshop::Workshop() : box_(meshes_.add(standIn("box"))) {
  for (const auto& [name, document] : documents()) {
    Diagnostics findings;
    kept_.push_back(build(document, 1, {}, Affine::Identity(), {}, findings).load);
  }
}

Built Workshop::build(const Document& document, std::uint32_t number, NodeRef owner, const Affine& X_WO,
                      std::vector<std::uint32_t> surroundings, Diagnostics& findings) const {
  const BuildInput input{document,
                         number,
                         owner,
                         X_WO,
                         std::move(surroundings),
                         services_,
                         [this](const Declaration&) { return box_; },
                         meshes_,
                         [](const Declaration&) { return kSilentStandIn; }};
  return buildLoad(input, findings);
}

void BuiltShow::open() {
  require(scene_.open(std::string(show_)), "the show opens");
}

void BuiltShow::play(std::uint64_t frames) {
  InputSample input;
  input.trackers.resize(2);
  for (; frames > 0; --frames) {
    const TimeSignature now = signatureAt(next_++, 60);
    const double t = toSeconds(now.time);
    input.time = now.time;
    TrackerSample &head = input.trackers[0], &wand = input.trackers[1];
    head.name = "head", head.X_RT.p = Vec3(0.1 * t, 0, 1.7);
    wand.name = "wand", wand.X_RT.p = Vec3(0.3, 0.5 + 0.2 * t, 1.3);
    wand.buttons = now.frame / 30 % 2;
    wand.axes[1] = now.frame > 20 ? 0.5F : 0.F;
    scene_.advance(now, input, changes_, nullptr);
  }
}

void BuiltShow::goOn() {
  constexpr Nanoseconds kStep = 16'666'667;
  InputSample input;
  for (std::uint64_t frame = 1'000'000; frame < 1'000'004; ++frame) {
    input.time = scene_.now() + kStep;
    scene_.advance({frame, input.time, kStep, {}}, input, changes_, nullptr);
  }
}

void BuiltShow::request(std::uint32_t number, const std::string& file, NodeRef owner, const Affine& X_WO) {
  asked_[number] = {file, owner, X_WO};
}

std::unique_ptr<LoadedScene> BuiltShow::take(std::uint32_t number) {
  const Asked asked = asked_.at(number);
  const auto document = documents().find(asked.file);
  if (document == documents().end()) return nullptr;
  Diagnostics findings;
  std::vector<std::uint32_t> surroundings;
  if (asked.owner.valid()) surroundings.push_back(asked.owner.load);
  Built built = workshop_.build(document->second, number, asked.owner, asked.X_WO, surroundings, findings);
  if (findings.hasErrors()) return nullptr;
  records_[number] = std::move(built.staticRecords);
  built.load->chunkRecords = records_[number];
  if (!records_[number].empty()) built.load->chunk = number;
  return std::move(built.load);
}

}  // namespace stadion::fuzz
