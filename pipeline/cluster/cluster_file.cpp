#include "pipeline/cluster/cluster_file.h"

#include "engine/base/plain_file.h"
#include "engine/base/text_line.h"
#include "engine/script/suggestion.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <span>

namespace stadion {
namespace {

constexpr std::size_t kMostBytes = 1 << 20;
constexpr std::size_t kMostInterface = 15;  // of Linux, and of an IPv4 address

/// A name of a network interface, or an IPv4 address. The network's configuration, which is XML, takes it as
/// it is.
bool canBeInterface(std::string_view text) {
  constexpr std::string_view kCharacters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_.:@-";
  return text.size() <= kMostInterface && text.find_first_not_of(kCharacters) == text.npos;
}

class Parser {
public:
  Parser(std::string_view text, const std::string& file, Diagnostics& out)
      : file_(file), out_(out), in_(text, file, out) {}

  std::optional<ClusterFile> run() {
    cluster_.file = file_, cluster_.wallsAt.where.file = file_;
    while (in_.next()) statement();
    if (!in_.failed() && cluster_.nodes.empty())
      out_.error({file_, 0, 0}, "there is no node in the file; add a line such as: node front  front");
    if (!in_.failed() && !cluster_.nodes.empty()) takeLead();
    if (in_.failed() || cluster_.nodes.empty()) return std::nullopt;
    return std::move(cluster_);
  }

private:
  struct Statement {
    const char* name;
    const char* what;  ///< of its one word
    void (Parser::*read)(const Word&);
  };

  static std::span<const Statement> statements() {
    static constexpr Statement kStatements[] = {
        {"walls", "a wall file, or its name", &Parser::walls},
        {"lead", "the name of a node", &Parser::lead},
        {"interface", "a network interface or its address", &Parser::interface},
        {"domain", "a number", &Parser::domain},
        {"partition", "a name", &Parser::partition},
        {"deadline", "seconds", &Parser::deadline},
        {"hash-every", "a number of frames", &Parser::hashEvery},
        {"on-difference", "resync or stop", &Parser::onDifference}};
    return kStatements;
  }

  void statement() {
    const Word& keyword = in_.words()[0];
    if (keyword.text == "node") return node();
    std::vector<std::string> known{"node"};
    for (const Statement& s : statements()) {
      known.emplace_back(s.name);
      if (keyword.text != s.name) continue;
      if (std::ranges::find(seen_, s.name) != seen_.end())
        return in_.error(keyword.column, fmt::format("\"{}\" is given twice; keep one of them", s.name));
      seen_.emplace_back(s.name);
      if (in_.words().size() < 2) return in_.error(in_.endColumn(), fmt::format("{} is missing", s.what));
      if (in_.words().size() > 2)
        return in_.error(in_.words()[2].column,
                         quotedWord(in_.words()[2].text) + " is one word too many here");
      return (this->*s.read)(in_.words()[1]);
    }
    in_.error(keyword.column,
              quotedWord(keyword.text) + " does not begin a statement" + didYouMean(keyword.text, known));
  }

  void node() {
    if (in_.words().size() < 2) return in_.error(in_.endColumn(), "the node's name is missing");
    const auto name = in_.name(in_.words()[1], "a node");
    if (!name) return;
    if (cluster_.find(*name))
      return in_.error(in_.words()[1].column, quotedWord(*name) + " is a node already; names are unique");
    if (cluster_.nodes.size() == ClusterFile::kMostNodes)
      return in_.error(in_.words()[0].column,
                       fmt::format("there are more than {} nodes", ClusterFile::kMostNodes));
    ClusterNode node{*name, {}, in_.line(), {}, in_.excerpt()};
    for (std::size_t i = 2; i < in_.words().size(); ++i) {
      const Word& wall = in_.words()[i];
      for (const ClusterNode& other : cluster_.nodes)
        if (std::ranges::find(other.walls, wall.text) != other.walls.end())
          return in_.error(wall.column, fmt::format("{} is shown by {} already; a wall has one node",
                                                    quotedWord(wall.text), other.name));
      if (std::ranges::find(node.walls, wall.text) != node.walls.end())
        return in_.error(wall.column, quotedWord(wall.text) + " is named twice");
      node.walls.emplace_back(wall.text), node.wallColumns.push_back(wall.column);
    }
    cluster_.nodes.push_back(std::move(node));
  }

  ClusterPlace placeOf(const Word& word) const { return {in_.at(word.column), in_.excerpt()}; }

  void walls(const Word& word) {
    cluster_.wallsAt = placeOf(word);
    const std::filesystem::path beside = std::filesystem::path(file_).parent_path() / word.text;
    std::error_code none;
    cluster_.walls =
        std::filesystem::is_regular_file(beside, none) ? beside.string() : std::string(word.text);
  }
  void lead(const Word& word) { lead_ = word, leadAt_ = placeOf(word); }
  void interface(const Word& word) {
    if (!canBeInterface(word.text))
      return in_.error(word.column,
                       fmt::format("{} is no network interface: use its IPv4 address or its name, up to {} "
                                   "letters, digits, '-', '_', '.', ':' and '@'",
                                   quotedWord(word.text), kMostInterface));
    cluster_.interface = word.text, cluster_.interfaceAt = placeOf(word);
  }
  void partition(const Word& word) {
    if (const auto name = in_.name(word, "a partition")) cluster_.partition = *name;
  }
  void domain(const Word& word) {
    constexpr std::uint64_t kMost = 230;  // of DDS: beyond it there are no ports left
    if (const auto number = in_.count(word, "the domain", 0, kMost))
      cluster_.domain = static_cast<std::uint32_t>(*number);
  }
  void deadline(const Word& word) {
    const auto seconds = in_.number(word, "the deadline");
    if (seconds && (*seconds < 0.1 || *seconds > 60))
      in_.error(word.column, fmt::format("the deadline must be from 0.1 s to 60 s, not {} s", *seconds));
    else if (seconds)
      cluster_.deadline = *seconds;
  }
  void hashEvery(const Word& word) {
    if (const auto frames = in_.count(word, "the number of frames", 1, 1000)) cluster_.hashEvery = *frames;
  }

  void onDifference(const Word& word) {
    if (word.text != "resync" && word.text != "stop")
      return in_.error(word.column, quotedWord(word.text) + " is neither resync nor stop");
    cluster_.stopOnDifference = word.text == "stop";
  }

  /// Once all nodes are known.
  void takeLead() {
    if (!lead_) return;
    if (const auto at = cluster_.find(lead_->text))
      cluster_.lead = *at;
    else
      out_.error(leadAt_.where,
                 quotedWord(lead_->text) + " is no node" +
                     didYouMean(std::string(lead_->text), cluster_.names()),
                 leadAt_.excerpt);
    if (!cluster_.find(lead_->text)) cluster_.nodes.clear();
  }

  std::string file_;
  Diagnostics& out_;
  LineReader in_;
  ClusterFile cluster_;
  std::vector<std::string> seen_;
  std::optional<Word> lead_;
  ClusterPlace leadAt_;
};

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
  return Parser(text, file, out).run();
}

std::optional<ClusterFile> loadCluster(const std::string& file, Diagnostics& out) {
  const Result<std::string> text = readPlainFile(file, kMostBytes);
  if (!text) return out.add(text.error()), std::nullopt;
  return parseCluster(text.value(), file, out);
}

std::optional<WallFile> loadWallsOf(const ClusterFile& cluster, const std::string& folder, Diagnostics& out) {
  Diagnostics found;
  auto walls = loadWalls(cluster.walls, folder, found);
  if (walls) return walls;
  for (Diagnostic d : found.all()) {
    if (d.where.file.empty()) d.where = cluster.wallsAt.where, d.excerpt = cluster.wallsAt.excerpt;
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
                fmt::format("no node shows the wall \"{}\" of {}", wall, cluster.walls),
                cluster.wallsAt.excerpt);
}

}  // namespace stadion
