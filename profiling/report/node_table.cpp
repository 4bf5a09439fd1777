#include "profiling/report/node_table.h"

namespace stadion {
namespace {

void add(NodeRow& to, const NodeRow& row) {
  to.receive += row.receive;
  to.simulate += row.simulate;
  to.dispatch += row.dispatch;
  to.settle += row.settle;
  to.publish += row.publish;
  to.app += row.app;
  to.cull += row.cull;
  to.draw += row.draw;
  to.cullMeasured = to.cullMeasured && row.cullMeasured;
  to.drawMeasured = to.drawMeasured && row.drawMeasured;
  to.drawTooLittle = to.drawTooLittle || row.drawTooLittle;
  to.total += row.total;
  to.share += row.share;
  to.visits += row.visits;
  to.walls.resize(row.walls.size());
  for (std::size_t w = 0; w < row.walls.size(); ++w) {
    to.walls[w].cull += row.walls[w].cull;
    for (std::size_t eye = 0; eye < 2; ++eye) to.walls[w].draw[eye] += row.walls[w].draw[eye];
  }
}

}  // namespace

NodeTable::NodeTable(const ShowFigures& figures, const NodeNames& names, std::size_t most) : names_(names) {
  std::size_t placed = 0;
  for (const NodeRow& row : figures.nodes) {
    if (placed++ >= most) {
      addRest(row);
      continue;
    }
    // The visitor is no node of the script.
    long at = row.node.valid() ? place(row.node) : -1;
    if (at < 0) {
      at = static_cast<long>(nodes_.size());
      nodes_.push_back({row.name, nodes_.size(), nullptr, {}, 0});
    }
    nodes_[static_cast<std::size_t>(at)].row = &row;
  }
}

long NodeTable::place(NodeRef node) {
  if (const auto at = places_.find(node); at != places_.end()) return static_cast<long>(at->second);
  auto name = names_.find(node);
  if (!name) return -1;
  const long parent = name->parent.valid() ? place(name->parent) : -1;
  const std::size_t at = nodes_.size();
  nodes_.push_back({std::move(*name), parent < 0 ? at : static_cast<std::size_t>(parent), nullptr, {}, 0});
  places_[node] = at;
  return static_cast<long>(at);
}

void NodeTable::addRest(const NodeRow& row) {
  const long parent = row.name.parent.valid() ? place(row.name.parent) : -1;
  const auto [at, isNew] = rests_.try_emplace(parent, nodes_.size());
  if (isNew)
    nodes_.push_back({{}, parent < 0 ? at->second : static_cast<std::size_t>(parent), nullptr, {}, 0});
  TableNode& rest = nodes_[at->second];
  add(rest.rest, row);
  ++rest.restCount;
  rest.name.path = std::to_string(rest.restCount) + " more";
}

long NodeTable::find(NodeRef node) {
  return place(node);
}

}  // namespace stadion
