/// A figure in a pose is drawn as a mesh that has this form.

#include "engine/figure/skinning.h"
#include "pipeline/cpu_draw/mesh/posed_meshes.h"
#include "tests/pipeline/cpu_draw/compared_pictures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <thread>

namespace stadion::test {
namespace {

constexpr std::uint32_t kSide = 160;

Affine moved(double x, double y, double z) {
  Affine X = Affine::Identity();
  X.translation() = Vec3(x, y, z);
  return X;
}

/// A column of boxes, carried by two bones, of which the upper turns by one radian in a second.
std::unique_ptr<Mesh> column() {
  MeshMaker maker(matt(0.7f, 0.4f, 0.2f));
  for (int i = 0; i < 8; ++i) maker.box(Vec3(-0.2, -0.2, 0.25 * i), Vec3(0.2, 0.2, 0.25 * i + 0.2));
  auto mesh = maker.seal();
  Skeleton s;
  const auto addBone = [&](std::int32_t parent, double height) {
    Bone bone;
    bone.parent = parent;
    bone.X_PB = moved(0, 0, height);
    bone.rest.translation = Vec3(0, 0, height);
    s.bones.push_back(bone);
  };
  addBone(-1, 0);
  addBone(0, 1);
  s.joints = {{0, Affine::Identity()}, {1, moved(0, 0, -1)}};
  const auto half = [](double angle) { return std::array{std::sin(angle / 2), std::cos(angle / 2)}; };
  ClipChannel turn{1, ChannelTarget::Rotation, Interpolation::Linear, {0, 1}, {0, 0, 0, 1, 0, 0, 0, 1}};
  turn.values[4] = static_cast<float>(half(1)[0]);
  turn.values[7] = static_cast<float>(half(1)[1]);
  s.clips.push_back({"turn", 1, {turn}});
  for (const auto& p : mesh->positions) {
    VertexJoints v;
    const float upper = std::clamp(2 * p[2] - 1.5f, 0.0f, 1.0f);
    v.joint = {0, 1, 0, 0};
    v.weight = {1 - upper, upper, 0, 0};
    mesh->joints.push_back(v);
  }
  mesh->skeleton = std::make_shared<const Skeleton>(std::move(s));
  return mesh;
}

FigureRecord at(double time) {
  FigureRecord r;
  r.layerCount = 1;
  r.layers[0] = {0, 1, time};
  return r;
}

std::unique_ptr<Mesh> posedCopy(const Mesh& mesh, const FigureRecord& playing) {
  auto copy = std::make_unique<Mesh>(mesh);
  FigurePose pose;
  pose.set(*mesh.skeleton, playing);
  std::vector<SkinnedVertex> vertices(mesh.positions.size());
  skin({mesh.positions, mesh.normals, mesh.joints}, pose.palette(), 0, vertices);
  for (std::size_t i = 0; i < vertices.size(); ++i)
    copy->positions[i] = vertices[i].position, copy->normals[i] = vertices[i].normal;
  skinTangents(mesh.tangents, mesh.joints, pose.palette(), 0, copy->tangents);
  copy->skeleton = nullptr;
  copy->joints.clear();
  copy->hash ^= 12345;
  return copy;
}

DrawList lit() {
  DrawList list = plainList();
  list.views[0] = lookAt(Vec3(2.2, -3, 1.8), Vec3(0, 0, 0.9), 0.9, 1);
  DrawLight sun;
  sun.direction = {-0.3f, 0.6f, -0.74f};
  list.lights.push_back(sun);
  return list;
}

/// Adds a normal map that leans to a side, with tangents that differ from those of the texture coordinates.
void addRelief(Mesh& mesh) {
  mesh.textures.push_back({1, 1, {200, 150, 220, 255}, "leaning"});
  mesh.materials[0].maps[kNormalMap].texture = 0;
  for (const auto& n : mesh.normals) {
    const Vec3 t = Vec3(0.3, 0.5, 0.8).cross(Vec3(n[0], n[1], n[2])).normalized();
    mesh.tangents.push_back(
        {static_cast<float>(t.x()), static_cast<float>(t.y()), static_cast<float>(t.z()), -1});
  }
}

struct FigureScene {
  explicit FigureScene(double time, bool relief = false) : playing(at(time)) {
    auto mesh = column();
    if (relief) addRelief(*mesh);
    const MeshId fixed = meshes.add(posedCopy(*mesh, playing));
    const MeshId figure = meshes.add(std::move(mesh));
    asMesh = asFigure = lit();
    asMesh.opaque.push_back(place(fixed));
    asFigure.opaque.push_back(place(figure));
    asFigure.opaque.back().figure = 2;
    asFigure.figures = {at(0), playing};
  }
  FigureRecord playing;
  MeshStore meshes;
  DrawList asMesh, asFigure;
};

TEST(FigureDrawing, APoseIsDrawnAsAMeshOfThatForm) {
  const FigureScene atRest(0);
  const Picture rest = drawnByCpu(atRest.meshes, atRest.asMesh, kSide, kSide);
  for (const double time : {0.0, 0.4, 1.0}) {
    const FigureScene scene(time);
    const Picture figure = drawnByCpu(scene.meshes, scene.asFigure, kSide, kSide);
    EXPECT_EQ(figure, drawnByCpu(scene.meshes, scene.asMesh, kSide, kSide)) << time;
    for (const std::size_t threads : {2u, 5u})
      EXPECT_EQ(figure, drawnByCpu(scene.meshes, scene.asFigure, kSide, kSide, {}, threads)) << threads;
    EXPECT_EQ(time == 0, figure == rest);
  }
}

TEST(FigureDrawing, OpenGlDrawsTheSameAsOfAMeshOfThatForm) {
  for (const Look look : {Look::Full, Look::Plain})
    for (const std::uint32_t samples : {1u, 4u}) {
      RenderQuality quality;
      quality.look = look;
      quality.samples = samples;
      for (const double time : {0.4, 1.0}) {
        const FigureScene scene(time);
        EXPECT_EQ(drawnByOpenGl(scene.meshes, scene.asFigure, kSide, kSide, quality),
                  drawnByOpenGl(scene.meshes, scene.asMesh, kSide, kSide, quality))
            << time << " " << samples;
      }
    }
}

/// One renderer draws list after list: a figure's vertices follow it.
TEST(FigureDrawing, OpenGlFollowsAFigureFromFrameToFrame) {
  FigureScene scene(1);
  Stage stage(scene.meshes, kSide, kSide);
  std::vector<Picture> pictures;
  for (const double time : {0.0, 0.5, 1.0, 0.5}) {
    scene.asFigure.figures[1] = at(time);
    pictures.push_back(stage.draw(scene.asFigure));
  }
  EXPECT_EQ(pictures[1], pictures[3]);
  EXPECT_NE(pictures[0], pictures[1]);
  EXPECT_EQ(pictures[2], stage.draw(scene.asMesh));
}

TEST(FigureDrawing, BothRenderersDrawFiguresAlike) {
  for (const bool relief : {false, true}) {
    const FigureScene scene(0.7, relief);
    const PictureDifference d = difference(drawnByCpu(scene.meshes, scene.asFigure, kSide, kSide),
                                           drawnByOpenGl(scene.meshes, scene.asFigure, kSide, kSide));
    EXPECT_LE(d.mean, 0.3) << relief;
    EXPECT_GE(d.alike, 0.995) << relief;
  }
}

TEST(FigureDrawing, TangentsTurnWithTheBones) {
  const FigureScene scene(1, true), flat(1);
  const Picture cpu = drawnByCpu(scene.meshes, scene.asFigure, kSide, kSide);
  EXPECT_EQ(cpu, drawnByCpu(scene.meshes, scene.asMesh, kSide, kSide));
  EXPECT_EQ(drawnByOpenGl(scene.meshes, scene.asFigure, kSide, kSide),
            drawnByOpenGl(scene.meshes, scene.asMesh, kSide, kSide));
  EXPECT_GT(difference(cpu, drawnByCpu(flat.meshes, flat.asFigure, kSide, kSide)).mean, 0.5);
  // As a matrix turns all of a mesh, a bone turns the vertices that it alone carries.
  const std::array<std::array<float, 4>, 1> along{{{1, 0, 0, -1}}};
  const std::array<VertexJoints, 1> carried{{{{0, 0, 0, 0}, {1, 0, 0, 0}}}};
  const auto turned = [&](const JointMatrix& m) {
    std::array<std::array<float, 4>, 1> out{};
    skinTangents(along, carried, std::span(&m, 1), 0, out);
    return out[0];
  };
  EXPECT_EQ(turned({0, 2, 0, 0, -2, 0, 0, 0, 0, 0, 2, 0, 5, 5, 5, 1}), (std::array<float, 4>{0, 1, 0, -1}));
  EXPECT_EQ(turned({-3, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}), (std::array<float, 4>{-1, 0, 0, 1}));
}

TEST(FigureDrawing, TwoFiguresOfOneModelHaveTheirOwnPoses) {
  FigureScene scene(1);
  const MeshId figure = scene.asFigure.opaque[0].mesh;
  scene.asFigure.opaque = {place(figure, moved(-0.8, 0, 0)), place(figure, moved(0.8, 0, 0))};
  scene.asFigure.opaque[0].figure = 2;
  scene.asFigure.opaque[1].figure = 1;
  const MeshId fixed = scene.asMesh.opaque[0].mesh, still = scene.meshes.add(posedCopy(*column(), at(0)));
  scene.asMesh.opaque = {place(fixed, moved(-0.8, 0, 0)), place(still, moved(0.8, 0, 0))};
  EXPECT_EQ(drawnByCpu(scene.meshes, scene.asFigure, kSide, kSide),
            drawnByCpu(scene.meshes, scene.asMesh, kSide, kSide));
}

TEST(FigureDrawing, ANumberBeyondTheListIsDrawnAtRest) {
  FigureScene scene(1);
  scene.asFigure.opaque[0].figure = 99;
  FigureScene rest(0);
  EXPECT_EQ(drawnByCpu(scene.meshes, scene.asFigure, kSide, kSide),
            drawnByCpu(rest.meshes, rest.asMesh, kSide, kSide));
}

TEST(PosedMeshes, APoseIsMadeOnceAndItsMemoryServesAgain) {
  MeshStore store;
  const MeshId id = store.add(column());
  const Mesh& mesh = *store.find(id);
  const auto rest = std::make_shared<const CpuMesh>(mesh, Look::Full);
  PosedMeshes poses;
  poses.begin(1);
  const auto first = poses.find(mesh, rest, at(0.5));
  EXPECT_EQ(poses.find(mesh, rest, at(0.5)), first);
  EXPECT_NE(poses.find(mesh, rest, at(0.6)), first);
  EXPECT_EQ(poses.size(), 2u);
  const CpuMesh* unused = poses.find(mesh, rest, at(0.6)).get();
  poses.begin(2);
  poses.begin(3);
  EXPECT_EQ(poses.size(), 0u);
  EXPECT_EQ(poses.find(mesh, rest, at(0.7)).get(), unused) << "one that is in use is not taken";
  poses.begin(0);  // the show restarts
  EXPECT_NE(poses.find(mesh, rest, at(0.5)), nullptr);
}

TEST(PosedMeshes, ManyThreadsGetOnePose) {
  MeshStore store;
  const MeshId id = store.add(column());
  const Mesh& mesh = *store.find(id);
  const auto rest = std::make_shared<const CpuMesh>(mesh, Look::Full);
  PosedMeshes poses;
  for (std::uint64_t frame = 1; frame < 40; ++frame) {
    std::array<std::shared_ptr<const CpuMesh>, 4> got;
    std::vector<std::thread> threads;
    for (auto& mine : got)
      threads.emplace_back([&] {
        poses.begin(frame);
        mine = poses.find(mesh, rest, at(0.01 * static_cast<double>(frame)));
      });
    for (std::thread& t : threads) t.join();
    for (const auto& one : got) EXPECT_EQ(one, got[0]);
  }
}

}  // namespace
}  // namespace stadion::test
