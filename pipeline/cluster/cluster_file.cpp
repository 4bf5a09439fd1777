#include "pipeline/cluster/cluster_file.h"

#include "engine/base/plain_file.h"
#include "engine/hall_formats/hall_import.h"
#include "engine/plain_text/statement_reader.h"
#include "engine/plain_text/suggestion.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace stadion {
namespace {

constexpr std::size_t kMostBytes = 1 << 20;
constexpr std::size_t kMostInterface = 15;  // of Linux, and of an IPv4 address

/// A name of a network interface, or an IPv4 address. It goes unescaped into the network's configuration,
/// which is XML.
bool canBeInterface(std::string_view text) {
  constexpr std::string_view kCharacters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_.:@-";
  return text.size() <= kMostInterface && text.find_first_not_of(kCharacters) == text.npos;
}

class ClusterParser {
public:
  ClusterParser(std::string_view text, const std::string& file, Diagnostics& out) : in_(text, file, out) {
    cluster_.file = file;
    cluster_.wallsAt.where.file = file;
  }

  std::optional<ClusterFile> run() {
    while (in_.next()) in_.read(*this, kStatements);
    if (!in_.failed() && cluster_.nodes.empty())
      in_.errorOfFile("there is no node in the file; add a line such as: node front  front");
    if (!in_.failed()) takeLead();
    if (in_.failed()) return std::nullopt;
    return std::move(cluster_);
  }

private:
  static const Statement<ClusterParser> kStatements[9];

  void node() {
    const auto name = in_.name("the node's name", "a node");
    if (!name) return;
    if (cluster_.find(*name))
      return in_.error(in_.last(), quotedWord(*name) + " is a node already; names are unique");
    if (cluster_.nodes.size() == ClusterFile::kMostNodes)
      return in_.error(in_.keyword(), fmt::format("there are more than {} nodes", ClusterFile::kMostNodes));
    ClusterNode node{*name, {}, in_.line(), {}, in_.excerpt()};
    while (in_.more()) {
      const Word& wall = *in_.word("a wall");
      for (const ClusterNode& other : cluster_.nodes)
        if (std::ranges::find(other.walls, wall.text) != other.walls.end())
          return in_.error(wall, fmt::format("{} is shown by {} already; a wall has one node",
                                             quotedWord(wall.text), other.name));
      if (std::ranges::find(node.walls, wall.text) != node.walls.end())
        return in_.error(wall, quotedWord(wall.text) + " is named twice");
      node.walls.emplace_back(wall.text);
      node.wallColumns.push_back(wall.column);
    }
    cluster_.nodes.push_back(std::move(node));
  }

  /// The one word of a statement that has one; null after an error.
  const Word* only(std::string_view what) {
    const Word* word = in_.word(what);
    return word && in_.finished() ? word : nullptr;
  }

  void walls() {
    const Word* word = only("a wall file, or its name");
    if (!word) return;
    cluster_.wallsAt = in_.place(*word);
    const std::filesystem::path beside = std::filesystem::path(cluster_.file).parent_path() / word->text;
    std::error_code none;
    cluster_.walls =
        std::filesystem::is_regular_file(beside, none) ? beside.string() : std::string(word->text);
  }
  void lead() {
    const Word* word = only("the name of a node");
    if (word) {
      lead_ = word->text;
      leadAt_ = in_.place(*word);
    }
  }
  void interface() {
    const Word* word = only("a network interface or its address");
    if (!word) return;
    if (!canBeInterface(word->text))
      return in_.error(*word,
                       fmt::format("{} is no network interface: use its IPv4 address or its name, up to {} "
                                   "letters, digits, '-', '_', '.', ':' and '@'",
                                   quotedWord(word->text), kMostInterface));
    cluster_.interface = word->text;
    cluster_.interfaceAt = in_.place(*word);
  }
  void partition() {
    const auto name = in_.name("the partition's name", "a partition");
    if (name && in_.finished()) cluster_.partition = *name;
  }
  void domain() {
    constexpr std::uint64_t kMost = 230;  // of DDS: beyond it there are no ports left
    const auto number = in_.count("the domain", 0, kMost);
    if (number && in_.finished()) cluster_.domain = static_cast<std::uint32_t>(*number);
  }
  void deadline() {
    const auto seconds = in_.number("the deadline", 0.1, 60, " s");
    if (seconds && in_.finished()) cluster_.deadline = *seconds;
  }
  void hashEvery() {
    const auto frames = in_.count("the number of frames", 1, 1000);
    if (frames && in_.finished()) cluster_.hashEvery = *frames;
  }
  void onDifference() {
    static constexpr std::string_view kAnswers[] = {"resync", "stop"};
    const auto answer = in_.choice("an answer to a difference", kAnswers);
    if (answer && in_.finished()) cluster_.stopOnDifference = *answer == 1;
  }

  /// Finds the leader. Called after the last line, as its node may stand below.
  void takeLead() {
    if (lead_.empty()) return;
    if (const auto at = cluster_.find(lead_))
      cluster_.lead = *at;
    else
      in_.errorAt(leadAt_, quotedWord(lead_) + " is no node" + didYouMeanOrKnown(lead_, cluster_.names()));
  }

  StatementReader in_;
  ClusterFile cluster_;
  std::string lead_;  ///< as the file names it; empty: it does not
  StatementPlace leadAt_;
};

constexpr Statement<ClusterParser> ClusterParser::kStatements[9] = {
    {"node", &ClusterParser::node, true},
    {"walls", &ClusterParser::walls},
    {"lead", &ClusterParser::lead},
    {"interface", &ClusterParser::interface},
    {"domain", &ClusterParser::domain},
    {"partition", &ClusterParser::partition},
    {"deadline", &ClusterParser::deadline},
    {"hash-every", &ClusterParser::hashEvery},
    {"on-difference", &ClusterParser::onDifference}};

}  // namespace

std::optional<std::size_t> ClusterFile::find(std::string_view name) const {
  const auto at = std::ranges::find(nodes, name, &ClusterNode::name);
  if (at == nodes.end()) return std::nullopt;
  return static_cast<std::size_t>(at - nodes.begin());
}

std::vector<std::string> ClusterFile::names() const {
  std::vector<std::string> all;
  for (const ClusterNode& n : nodes) all.push_back(n.name);
  return all;
}

std::optional<ClusterFile> parseCluster(std::string_view text, const std::string& file, Diagnostics& out) {
  return ClusterParser(text, file, out).run();
}

std::optional<ClusterFile> loadCluster(const std::string& file, Diagnostics& out) {
  const Result<std::string> text = readPlainFile(file, kMostBytes);
  if (!text) {
    out.add(text.error());
    return std::nullopt;
  }
  return parseCluster(text.value(), file, out);
}

std::optional<WallFile> loadWallsOf(const ClusterFile& cluster, const std::string& folder, Diagnostics& out) {
  Diagnostics found;
  auto walls = loadHall(cluster.walls, folder, found);
  if (walls) return walls;
  for (Diagnostic d : found.all()) {
    if (d.where.file.empty()) {
      d.where = cluster.wallsAt.where;
      d.excerpt = cluster.wallsAt.excerpt;
    }
    out.add(std::move(d));
  }
  return std::nullopt;
}

void checkWalls(const ClusterFile& cluster, const std::vector<std::string>& walls, Diagnostics& out) {
  std::vector<std::string> unseen = walls;
  for (const ClusterNode& node : cluster.nodes)
    for (std::size_t i = 0; i < node.walls.size(); ++i) {
      const std::string& wall = node.walls[i];
      std::erase(unseen, wall);
      if (std::ranges::find(walls, wall) == walls.end())
        out.error(
            {cluster.file, node.line, node.wallColumns[i]},
            fmt::format("{} has no wall {}{}", cluster.walls, quotedWord(wall), didYouMean(wall, walls)),
            node.excerpt);
    }
  for (const std::string& wall : unseen)
    out.warning(cluster.wallsAt.where,
                fmt::format("no host shows the wall \"{}\" of {}", wall, cluster.walls),
                cluster.wallsAt.excerpt);
}

}  // namespace stadion
