#pragma once
/// What is fuzzed: each target reads some bytes as the product would read them, and ends the program where
/// what it accepts is not what it promises.
///
/// Threads  one at a time.

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <string_view>

namespace stadion::fuzz {

using Bytes = std::span<const std::uint8_t>;

void script(Bytes bytes);           ///< a script: checked, linted, built with stand-ins for its models
void walls(Bytes bytes);            ///< a wall file
void input_log(Bytes bytes);        ///< an input log, and what it says in frames
void rig_file(Bytes bytes);         ///< a rig file, and measurements that go through it
void cluster_file(Bytes bytes);     ///< a cluster file
void suite(Bytes bytes);            ///< a suite file
void osc(Bytes bytes);              ///< packets on the OSC ports of trackers and operator
void tracker_packets(Bytes bytes);  ///< packets on the ports of DTrack and FreeD
void cluster_wire(Bytes bytes);     ///< what the machines of a cluster hear from each other
void scene_state(Bytes bytes);      ///< a scene's state, as the leader of a cluster sends it
void imported_mesh(Bytes bytes);    ///< what the importer program answers
void mpcdi(Bytes bytes);            ///< an MPCDI archive, or mpcdi.xml, a zero byte and one file for all names
void sgct(Bytes bytes);             ///< a configuration of SGCT, a zero byte and one file for all names
void ndisplay(Bytes bytes);         ///< a configuration of nDisplay, likewise
void warp_mesh(Bytes bytes);        ///< the number of a warp format, and a file of it
void light_map(Bytes bytes);        ///< a PNG file
void web(Bytes bytes);              ///< a request to the operator's page, and the command in it
void colour_table(Bytes bytes);     ///< a .cube file

struct Target {
  std::string_view name;
  void (*read)(Bytes);
};

inline constexpr Target kTargets[] = {{"script", script},
                                      {"walls", walls},
                                      {"input_log", input_log},
                                      {"rig_file", rig_file},
                                      {"cluster_file", cluster_file},
                                      {"suite", suite},
                                      {"osc", osc},
                                      {"tracker_packets", tracker_packets},
                                      {"cluster_wire", cluster_wire},
                                      {"scene_state", scene_state},
                                      {"imported_mesh", imported_mesh},
                                      {"mpcdi", mpcdi},
                                      {"sgct", sgct},
                                      {"ndisplay", ndisplay},
                                      {"warp_mesh", warp_mesh},
                                      {"light_map", light_map},
                                      {"web", web},
                                      {"colour_table", colour_table}};

inline std::string_view asText(Bytes bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// A promise: where it is broken, the input is a finding.
inline void require(bool kept, const char* promise) {
  if (kept) return;
  std::fprintf(stderr, "broken promise: %s\n", promise);
  std::abort();
}

}  // namespace stadion::fuzz
