#include "engine/scene/placements.h"

#include <gtest/gtest.h>
#include <limits>

namespace stadion {
namespace {

Affine at(double x, double y, double z) {
  return Affine(Eigen::Translation3d(x, y, z));
}

/// A quarter turn about +Z: X becomes Y.
Affine turned() {
  Affine X = Affine::Identity();
  X.linear() << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  return X;
}

/// A parent at (1, 0, 0), its child at (0, 2, 0) and the child's child at (0, 0, 3).
class PlacementsTree : public testing::Test {
protected:
  Placements placements;
  PlacementId parent = placements.add(kWorldPlacement, at(1, 0, 0));
  PlacementId child = placements.add(parent, at(0, 2, 0));
  PlacementId leaf = placements.add(child, at(0, 0, 3));

  Vec3 place(PlacementId id) const { return placements.world(id).translation(); }
};

TEST_F(PlacementsTree, AParentCarriesItsDescendants) {
  EXPECT_EQ(place(leaf), Vec3(1, 2, 3));
  placements.setLocal(parent, at(5, 0, 0));
  EXPECT_EQ(place(child), Vec3(5, 2, 0));
  EXPECT_EQ(place(leaf), Vec3(5, 2, 3));
}

TEST_F(PlacementsTree, AHeldPlacementStaysWhenItsParentMoves) {
  ASSERT_TRUE(placements.holdInWorld(child, at(7, 7, 7)));
  EXPECT_EQ(place(leaf), Vec3(7, 7, 10)) << "the child's child goes with it";
  placements.setLocal(parent, at(5, 0, 0));
  EXPECT_EQ(place(child), Vec3(7, 7, 7));
  EXPECT_EQ(place(leaf), Vec3(7, 7, 10));
  ASSERT_TRUE(placements.holdInWorld(child, at(8, 7, 7)));
  EXPECT_EQ(place(leaf), Vec3(8, 7, 10));
  EXPECT_EQ(placements.carrier(child), kWorldPlacement);
}

TEST_F(PlacementsTree, AMovedParentCarriesItsChildAgainAfterAHold) {
  placements.holdInWorld(child, at(7, 7, 7));
  EXPECT_EQ(place(leaf), Vec3(7, 7, 10));
  placements.setLocal(child, at(0, 4, 0));
  EXPECT_EQ(place(child), Vec3(1, 4, 0));
  EXPECT_EQ(place(leaf), Vec3(1, 4, 3));
}

TEST_F(PlacementsTree, APlacementThatRejoinsItsParentStaysWhereItIs) {
  placements.holdInWorld(child, at(7, 7, 7));
  placements.rejoin(child, placements.world(parent));
  EXPECT_EQ(place(child), Vec3(7, 7, 7));
  placements.setLocal(parent, at(2, 0, 0));
  EXPECT_EQ(place(child), Vec3(8, 7, 7));
}

TEST_F(PlacementsTree, AHeldPositionLeavesTheOrientationToTheParent) {
  placements.holdInWorld(child, at(7, 7, 7), HeldParts::All);
  EXPECT_EQ(place(leaf), Vec3(7, 7, 10));
  placements.holdInWorld(child, at(7, 7, 7), HeldParts::Position);
  placements.setLocal(parent, turned());
  EXPECT_EQ(place(child), Vec3(7, 7, 7));
  EXPECT_EQ(placements.world(child).linear(), turned().linear());
  EXPECT_EQ(placements.carrier(child), parent);
}

TEST_F(PlacementsTree, AHeldOrientationLeavesThePositionToTheParent) {
  placements.holdInWorld(child, turned(), HeldParts::Orientation);
  placements.setLocal(parent, at(5, 0, 0));
  EXPECT_EQ(place(child), Vec3(5, 2, 0));
  EXPECT_EQ(placements.world(child).linear(), turned().linear());
}

TEST_F(PlacementsTree, AMatrixThatIsNotFiniteIsRefused) {
  const Affine broken = at(std::numeric_limits<double>::quiet_NaN(), 0, 0);
  EXPECT_FALSE(placements.setLocal(child, broken));
  EXPECT_FALSE(placements.setWorld(child, broken));
  EXPECT_FALSE(placements.holdInWorld(child, broken));
  EXPECT_EQ(place(leaf), Vec3(1, 2, 3));
}

}  // namespace
}  // namespace stadion
