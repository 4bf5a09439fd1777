#include "engine/asset/mesh_file.h"
#include "tests/engine/asset/gltf_builder.h"
#include "tests/engine/asset/importing.h"

namespace stadion::test {
namespace {

/// A square for each node. The file's +Y is up: its (x, y, z) is (x, -z, y) in a show.
///
///   hall            at the origin
///     roof          3 m up, turned by 90 degrees about the vertical, twice as large
///       lamp 1      1 m further along the roof's x, that is 2 m along the hall's -z
///     door
GltfBuilder hallModel() {
  GltfBuilder b;
  b.square();
  b.json["nodes"] = nlohmann::json::parse(
      R"([{"name": "hall", "mesh": 0, "children": [1, 3]},
          {"name": "roof", "mesh": 0, "translation": [0, 3, 0], "rotation": [0, 0.7071067811865476, 0, 0.7071067811865476],
           "scale": [2, 2, 2], "children": [2]},
          {"name": "lamp 1", "mesh": 0, "translation": [1, 0, 0]},
          {"name": "door", "mesh": 0, "translation": [5, 0, 0]}])");
  return b;
}

Imported partsOf(const GltfBuilder& b, const NodeSelection& nodes, ModelForm form = ModelForm::Object) {
  TestFolder folder;
  folder.write("hall.glb", b.glb());
  ImportOptions options;
  options.form = form;
  options.nodes = nodes;
  return importOf(folder.path(), "hall.glb", options);
}

/// Where the model has the vertices of a part.
std::vector<Vec3> placesOf(const Mesh& mesh) {
  std::vector<Vec3> places;
  for (const auto& p : mesh.positions)
    places.push_back(mesh.place * Vec3(double{p[0]}, double{p[1]}, double{p[2]}));
  return places;
}

/// The greatest distance of a place to the nearest of the others.
double farthest(const std::vector<Vec3>& places, const std::vector<Vec3>& from) {
  double most = 0;
  for (const Vec3& p : places) {
    double nearest = 1e9;
    for (const Vec3& q : from) nearest = std::min(nearest, (p - q).norm());
    most = std::max(most, nearest);
  }
  return most;
}

TEST(PartImport, TheRestAndThePartsAreTheWholeWhereItWas) {
  const GltfBuilder b = hallModel();
  const Imported whole = partsOf(b, {}), rest = partsOf(b, {"", {"roof", "roof/lamp_1"}}),
                 roof = partsOf(b, {"roof", {"roof/lamp_1"}}), lamp = partsOf(b, {"lamp_1", {"roof"}});
  ASSERT_TRUE(whole.mesh && rest.mesh && roof.mesh && lamp.mesh) << rest.error << roof.error << lamp.error;
  EXPECT_EQ(whole.mesh->indices.size(), 24u);
  EXPECT_EQ(rest.mesh->indices.size(), 12u);
  EXPECT_EQ(roof.mesh->indices.size(), 6u);
  EXPECT_EQ(lamp.mesh->indices.size(), 6u);
  std::vector<Vec3> all;
  for (const Imported* i : {&rest, &roof, &lamp})
    for (const Vec3& p : placesOf(*i->mesh)) all.push_back(p);
  EXPECT_EQ(all.size(), 16u);
  EXPECT_LT(farthest(placesOf(*whole.mesh), all), 1e-6);
  EXPECT_LT(farthest(all, placesOf(*whole.mesh)), 1e-6);
}

TEST(PartImport, APartHasItsNodesPlaceWithoutTheScale) {
  const Imported roof = partsOf(hallModel(), {"roof", {}}), lamp = partsOf(hallModel(), {"roof/lamp_1", {}});
  ASSERT_TRUE(roof.mesh && lamp.mesh) << roof.error << lamp.error;
  EXPECT_LT((roof.mesh->place.translation() - Vec3(0, 0, 3)).norm(), 1e-12);
  EXPECT_LT((lamp.mesh->place.translation() - Vec3(0, 2, 3)).norm(), 1e-12);
  EXPECT_LT((roof.mesh->place.linear() * Vec3::UnitX() - Vec3::UnitY()).norm(), 1e-7);
  EXPECT_NEAR(roof.mesh->place.linear().determinant(), 1, 1e-12);
  // The square is 2 m wide: the scale is in the part's vertices.
  EXPECT_NEAR(lamp.mesh->bounds.hi.x(), 2, 1e-6);
  EXPECT_NE(roof.mesh->hash, lamp.mesh->hash) << "the same square, with another place";
}

TEST(PartImport, AllOfAModelMayBeInParts) {
  const Imported rest = partsOf(hallModel(), {"", {"hall"}});
  ASSERT_TRUE(rest.mesh) << rest.error;
  EXPECT_TRUE(rest.mesh->indices.empty());
}

TEST(PartImport, AnUnknownPartIsRefusedWithTheNamesThatThereAre) {
  const Imported none = partsOf(hallModel(), {"rof", {}});
  EXPECT_FALSE(none.mesh);
  EXPECT_TRUE(
      contains(none.error, "has no part \"rof\"; it has 4 nodes (\"hall\", \"roof\", \"lamp_1\" and 1 more)"))
      << none.error;
  const Imported above = partsOf(hallModel(), {"roof/door", {}});
  EXPECT_FALSE(above.mesh) << "the door is not below the roof";
}

TEST(PartImport, ADamagedPlaceIsNoMesh) {
  const Imported roof = partsOf(hallModel(), {"roof", {}});
  ASSERT_TRUE(roof.mesh);
  Mesh mesh = *roof.mesh;
  EXPECT_TRUE(decode(encode(mesh)));
  mesh.place.linear() *= 2;
  EXPECT_FALSE(decode(encode(mesh))) << "with a scale";
  mesh.place.linear() = Mat3::Constant(std::nan(""));
  EXPECT_FALSE(decode(encode(mesh)));
}

}  // namespace
}  // namespace stadion::test
