/// `fuzz_seeds DIR`: inputs that no file of the product holds, in a folder for each target.

#include "engine/asset/import.h"
#include "engine/asset/importer_answer.h"
#include "engine/input/scripted_input.h"
#include "engine/scene/scene_snapshot.h"
#include "pipeline/cluster/orders.h"
#include "tests/fuzz/built_show.h"
#include "tests/fuzz/packets.h"

#include <filesystem>
#include <fstream>
#include <lo/lo.h>

namespace stadion::fuzz {
namespace {

using Seed = std::vector<std::uint8_t>;

class Folder {
public:
  explicit Folder(const std::filesystem::path& path) : path_(path) {
    std::filesystem::create_directories(path_);
  }
  void add(const std::string& name, const Seed& seed) const {
    std::ofstream(path_ / name, std::ios::binary)
        .write(reinterpret_cast<const char*>(seed.data()), static_cast<std::streamsize>(seed.size()));
  }

private:
  std::filesystem::path path_;
};

Seed serialised(const char* path, lo_message message) {
  std::size_t size = 0;
  auto* bytes = static_cast<std::uint8_t*>(lo_message_serialise(message, path, nullptr, &size));
  Seed seed(bytes, bytes + size);
  std::free(bytes);
  return seed;
}

template <class... Floats>
lo_message floats(Floats... x) {
  lo_message m = lo_message_new();
  (lo_message_add_float(m, static_cast<float>(x)), ...);
  return m;
}

void writeOsc(const Folder& to) {
  const auto add = [&](const char* name, const char* path, lo_message m) {
    to.add(name, serialised(path, m));
    lo_message_free(m);
  };
  add("pose", "/tracker/head/pose", floats(0.5, 1, 1.25, 0, 0, 0, 1));
  lo_message button = lo_message_new();
  lo_message_add_int32(button, 2), lo_message_add_true(button);
  add("button", "/tracker/wand/button", button);
  lo_message axis = lo_message_new();
  lo_message_add_int64(axis, 1), lo_message_add_double(axis, -0.5);
  add("axis", "/tracker/wand/axis", axis);
  add("pause", "/stadion/pause", floats());
  add("volume", "/stadion/volume", floats(0.5));
  add("eyes", "/stadion/eye-separation/by", floats(-0.01));
  lo_message words = lo_message_new();
  lo_message_add_string(words, "on"), lo_message_add_nil(words), lo_message_add_char(words, 'x');
  const std::uint8_t bytes[] = {1, 2, 3};
  lo_blob blob = lo_blob_new(sizeof bytes, bytes);
  lo_message_add_blob(words, blob);
  lo_blob_free(blob);
  add("words", "/stadion/black", words);
  lo_bundle inner = lo_bundle_new({1, 0}), outer = lo_bundle_new({3'000'000'000U, 7});
  lo_bundle_add_message(inner, "/tracker/head/pose", floats(0, 1, 1, 0, 0, 0, 1));
  lo_bundle_add_bundle(outer, inner);
  lo_bundle_add_message(outer, "/tracker/wand/pose", floats(1, 1, 1, 0, 0, 0, 1));
  std::size_t size = 0;
  auto* packed = static_cast<std::uint8_t*>(lo_bundle_serialise(outer, nullptr, &size));
  to.add("bundle", Seed(packed, packed + size));
  std::free(packed);
  lo_bundle_free_recursive(outer);
}

/// Steps one after another, as cluster_wire takes them.
class Conversation {
public:
  Conversation& operator()(Step step, const Seed& bytes = {}) {
    seed_.push_back(static_cast<std::uint8_t>(step));
    seed_.push_back(static_cast<std::uint8_t>(bytes.size())),
        seed_.push_back(static_cast<std::uint8_t>(bytes.size() >> 8U));
    seed_.insert(seed_.end(), bytes.begin(), bytes.end());
    return *this;
  }
  template <class T>
  Conversation& operator()(Step step, const dds_topic_descriptor_t& type, const T& value) {
    return (*this)(step, written(type, value));
  }
  const Seed& seed() const { return seed_; }

private:
  Seed seed_;
};

Seed orderOf(std::uint64_t serial) {
  ScriptedInput visitor;
  visitor.key("head", 0, Vec3(0, 0, 1.7)).key("head", 1, Vec3(0, 1, 1.7), Vec3(10, 0, 0), true);
  visitor.key("wand", 0, Vec3(0.3, 0.5, 1.3)).key("wand", 0.51, Vec3(0.4, 0.5, 1.3), Vec3::Zero(), false, 1);
  FrameOrder order;
  order.signature = signatureAt(30 + serial, 60);
  order.signature.decisions.add({1, 4, 2});
  InputSample input;
  visitor.sampleFrame(order.signature.time - order.signature.step, order.signature.time, input);
  cluster::WrittenOrder written_order;
  return written(stadion_wire_Order_desc, written_order.write({1, serial, 7, 0}, order, &input));
}

void writeConversations(const Folder& to) {
  using namespace cluster;
  Session waiting{};
  waiting.number = 1, waiting.compatibility.script = 1, waiting.rate = 60, waiting.giver = kNoNode;
  Session begun = waiting;
  begun.begun = true;
  Session over = begun;
  over.over = true, over.shown = 40;
  std::vector<std::uint8_t> state(40, 7);
  StatePart part{};
  part.to = 1, part.session = 1, part.serial = 1, part.size = 2 * state.size();
  part.bytes._buffer = state.data(), part.bytes._length = part.bytes._maximum = 40;
  StatePart rest = part;
  rest.offset = 40;
  to.add("from_the_beginning",
         Conversation()(Step::Session, stadion_wire_Session_desc, waiting)(Step::Join)(
             Step::Order, orderOf(1))(Step::Order, orderOf(2))(Step::Next)(Step::Next)(Step::Show)(
             Step::Go, stadion_wire_Go_desc, Go{1, 2, 1})(Step::Session, stadion_wire_Session_desc, over)
             .seed());
  to.add("joins_later", Conversation()(Step::Session, stadion_wire_Session_desc,
                                       begun)(Step::StatePart, stadion_wire_StatePart_desc,
                                              part)(Step::StatePart, stadion_wire_StatePart_desc,
                                                    rest)(Step::Order, orderOf(2))(Step::Join)(Step::Next)
                            .seed());
  std::string where = "ball (show.evs:3), velocity", here = "1", there = "2";
  Difference difference{};
  difference.node = 1, difference.session = 1, difference.frame = 3, difference.found = true;
  difference.where = where.data(), difference.here = here.data(), difference.there = there.data();
  to.add("takes_over",
         Conversation()(Step::Presence, stadion_wire_Presence_desc, Presence{1, 9, 1, 0, 5, 2, 5, 3, 1})(
             Step::StatePart, stadion_wire_StatePart_desc, part)(Step::StatePart, stadion_wire_StatePart_desc,
                                                                 rest)(Step::TakeOver)(Step::Begin)
             .seed());
  to.add("leads",
         Conversation()(Step::Presence, stadion_wire_Presence_desc, Presence{1, 9, 1, 0, 1, 2, 1, 0, 1})(
             Step::Presence, stadion_wire_Presence_desc, Presence{2, 8, 1, 0, 1, 1, 0, 0, 1})(
             Step::Issue, {1})(Step::Drawn, stadion_wire_Drawn_desc, Drawn{1, 1, 1})(Step::Show)(
             Step::Simulated, {3})(Step::SceneHash, stadion_wire_SceneHash_desc, SceneHash{1, 1, 3, 4})(
             Step::SceneHash, stadion_wire_SceneHash_desc, SceneHash{2, 1, 5, 4})(Step::Simulated, {5})(
             Step::Difference, stadion_wire_Difference_desc, difference)(Step::Left, {2, 8})
             .seed());
}

void writeStates(const Folder& to) {
  const Workshop workshop;
  for (std::size_t which = 0; which < std::size(kShows); ++which) {
    BuiltShow show(workshop, kShows[which]);
    show.open();
    int count = 0;
    for (const int frames : {1, 1, 30, 30, 120}) {
      show.play(static_cast<std::uint64_t>(frames));
      Seed seed = SceneSnapshot(show.scene()).save();
      seed.insert(seed.begin(), static_cast<std::uint8_t>(which));
      to.add(std::string(kShows[which].name) + '_' + std::to_string(++count), seed);
    }
  }
}

Seed answered(ImportStatus status, const std::string& text, const Seed& mesh) {
  AnswerHead head;
  head.status = status, head.textBytes = static_cast<std::uint32_t>(text.size()),
  head.meshBytes = mesh.size();
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(&head);
  Seed seed(bytes, bytes + sizeof head);
  seed.insert(seed.end(), text.begin(), text.end());
  seed.insert(seed.end(), mesh.begin(), mesh.end());
  return seed;
}

void writeMeshes(const Folder& to) {
  Mesh plain = *standIn("box");
  plain.textures.clear(), plain.materials[0].maps[kBaseMap].texture = -1;
  Mesh coloured = plain;
  coloured.uvs.clear(), coloured.colours.assign(coloured.positions.size(), {255, 0, 0, 255});
  coloured.materials.push_back({});
  coloured.submeshes = {{0, 18, 0}, {18, 18, 1}};
  Mesh textured = plain;
  textured.textures.push_back({2, 1, Seed(8, 255), "two pixels"}),
      textured.materials[0].maps[kBaseMap].texture = 0;
  Mesh masked = textured;
  masked.materials[0].alphaCutoff = 0.5f, masked.materials[0].maps[kEmissiveMap].texture = 0;
  to.add("plain", answered(ImportStatus::Loaded, "", encode(plain)));
  to.add("coloured",
         answered(ImportStatus::Loaded, "a texture is missing\nanother one, too", encode(coloured)));
  to.add("textured", answered(ImportStatus::Loaded, "", encode(textured)));
  to.add("masked", answered(ImportStatus::Loaded, "", encode(masked)));
  to.add("failed", answered(ImportStatus::Failed, "is cut short", {}));
}

}  // namespace
}  // namespace stadion::fuzz

int main(int argc, char** argv) {
  using namespace stadion::fuzz;
  if (argc != 2) return std::fprintf(stderr, "fuzz_seeds DIR\n"), 2;
  const std::filesystem::path to = argv[1];
  writeOsc(Folder(to / "osc"));
  writeConversations(Folder(to / "cluster_wire"));
  writeStates(Folder(to / "scene_state"));
  writeMeshes(Folder(to / "imported_mesh"));
}
