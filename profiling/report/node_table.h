#pragma once
/// The nodes of a report: the dearest, and all that they are placed below, as a tree.
///
/// Ownership  points into the figures that it was made of.

#include "profiling/report/show_figures.h"

#include <map>
#include <vector>

namespace stadion {

struct TableNode {
  NodeName name;
  std::size_t parent = 0;        ///< index in the table; its own = placed in World
  const NodeRow* row = nullptr;  ///< what it cost; null: nothing by itself
  NodeRow rest;                  ///< instead: the sum of those that have no place in the table
  std::size_t restCount = 0;
};

class NodeTable {
public:
  /// At most `most` nodes that cost something.
  NodeTable(const ShowFigures& figures, const NodeNames& names, std::size_t most);

  const std::vector<TableNode>& nodes() const { return nodes_; }
  /// The place of a node, also of one that was not in the figures; -1 = nobody knows it.
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
