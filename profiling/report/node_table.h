#pragma once
/// The nodes of a report as a tree: the most expensive ones, and all nodes above them.
///
/// Ownership  points into the figures from which it was made.

#include "profiling/report/show_figures.h"

#include <map>
#include <vector>

namespace stadion {

struct TableNode {
  NodeName name;
  std::size_t parent = 0;        ///< index in the table; its own index = placed in World
  const NodeRow* row = nullptr;  ///< costs of the node; null: it has no costs of its own
  NodeRow rest;                  ///< instead: the sum of the nodes without a place in the table
  std::size_t restCount = 0;
};

class NodeTable {
public:
  /// Takes at most `most` nodes with costs.
  NodeTable(const ShowFigures& figures, const NodeNames& names, std::size_t most);

  const std::vector<TableNode>& nodes() const { return nodes_; }
  /// Returns the index of a node, also of one without figures; -1 = unknown.
  long find(NodeRef node);

private:
  long place(NodeRef node);
  void addRest(const NodeRow& row);

  const NodeNames& names_;
  std::vector<TableNode> nodes_;
  std::map<NodeRef, std::size_t> places_;
  std::map<long, std::size_t> rests_;  ///< by parent
};

}  // namespace stadion
