#include "pipeline/draw_list/instance_batches.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

DrawItem paintedItem(MeshId mesh, std::uint32_t paint) {
  DrawItem item;
  item.model = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  item.mesh = mesh;
  item.paint = paint;
  return item;
}

TEST(InstanceBatches, ABatchHasOnePaint) {
  const std::vector<DrawItem> items{paintedItem(1, 0), paintedItem(1, 0), paintedItem(1, 2),
                                    paintedItem(1, 1), paintedItem(2, 1), paintedItem(2, 1)};
  InstanceBatches batches;
  batches.build(items, items);
  for (const auto some : {batches.opaque(), batches.transparent()}) {
    std::vector<std::array<std::uint32_t, 2>> found;
    for (const InstanceBatch& b : some) found.push_back({b.paint, b.count});
    EXPECT_EQ(found, (std::vector<std::array<std::uint32_t, 2>>{{0, 2}, {2, 1}, {1, 1}, {1, 2}}));
  }
}

}  // namespace
}  // namespace stadion
