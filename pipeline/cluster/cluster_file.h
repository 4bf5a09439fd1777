#pragma once
/// Cluster files: text that says which host shows which walls of one show.
///
///     # Four machines, a wall each; the first one leads.
///     walls cave4
///     node front  front
///     node left   left
///     node right  right
///     node floor  floor
///
/// One statement a line; `#` begins a comment.
///
///     walls FILE|NAME             the room (without this line cave4); a file is looked for beside this one
///     node NAME [WALL...]         a host and the walls that it shows; none: it shows nothing
///     lead NAME                   the host that provides clock and trackers (the first one)
///     interface NAME|ADDRESS      of the network between them (the loopback interface: all on one host);
///                                 checkInterface() looks for it
///     domain N                    of DDS, 0 to 230 (0); clusters in one network need different ones, or
///     partition NAME              different names (stadion)
///     deadline SECONDS            a host that is silent for so long is left out, 0.1 to 60 (0.5)
///     hash-every FRAMES           how often the scenes are compared, 1 to 1000 (30)
///     on-difference resync|stop   a host with another state takes over the leader's (resync), or all end
///
/// At most one host shows each wall of the room. A cluster has 1 to 24 hosts.
///
/// Threads  plain values, any thread.
/// Errors   go to the Diagnostics with line, column and a fix if one is known; there may be several.

#include "engine/base/diagnostic.h"
#include "engine/display/wall_file.h"
#include "engine/plain_text/statement_reader.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stadion {

struct ClusterNode {
  std::string name;
  std::vector<std::string> walls;
  std::uint32_t line = 0;                    ///< in the file
  std::vector<std::uint32_t> wallColumns{};  ///< column of each wall's name
  std::string excerpt{};                     ///< text of line `line`
};

struct ClusterFile {
  static constexpr std::size_t kMostNodes = 24;

  std::string file;  ///< as the user named it
  std::string walls = "cave4";
  StatementPlace wallsAt;  ///< the whole file, if it does not say
  std::vector<ClusterNode> nodes;
  std::size_t lead = 0;   ///< index of a node
  std::string interface;  ///< empty: loopback
  StatementPlace interfaceAt;
  std::uint32_t domain = 0;
  std::string partition = "stadion";
  double deadline = 0.5;  ///< [s]
  std::uint64_t hashEvery = 30;
  bool stopOnDifference = false;

  /// Returns the index of the node with that name.
  std::optional<std::size_t> find(std::string_view name) const;
  std::vector<std::string> names() const;
};

/// Reads the text; returns nothing if it has errors. checkWalls() checks whether the room has these walls.
std::optional<ClusterFile> parseCluster(std::string_view text, const std::string& file, Diagnostics& out);
std::optional<ClusterFile> loadCluster(const std::string& file, Diagnostics& out);

/// The room's walls, as loadHall() finds them. Errors about their name are reported at its place in the
/// cluster file; the program that opens the show reports warnings.
std::optional<WallFile> loadWallsOf(const ClusterFile& cluster, const std::string& folder, Diagnostics& out);

/// Reports walls of hosts that are not among these, and warns of walls that no host shows.
void checkWalls(const ClusterFile& cluster, const std::vector<std::string>& walls, Diagnostics& out);

}  // namespace stadion
