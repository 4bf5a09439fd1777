/// A second way to what the simulator says: the hall as an ordinary scene. Its screen is a mesh that carries a
/// projector's picture as a projective texture. The renderer draws it from the visitor's eye, once for each
/// projector, and their light adds up.

#include "engine/maths/srgb.h"
#include "show/player/player.h"
#include "show/player/show_renderer.h"
#include "show/simulation/drawn_pictures.h"
#include "show/simulation/hall_simulation.h"
#include "tests/engine/asset/gltf_builder.h"
#include "tests/programs/program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace stadion::test {
namespace {

/// Three projectors beside the axis, which overlap by 10 to 20 degrees.
const std::string kRoundHall =
    "visitor 0 0 1.7 within 0.3\n"
    "screen round cylinder centre 0 0 0  radius 3  azimuth -75 75  height 0.6 2.9\n"
    "projector left   screen round pixels 160 140 at -0.3 0.2 1.8 turn -50 0 throw 0.9\n"
    "projector middle screen round pixels 160 140 at  0.0 0.3 1.6 turn   0 2 throw 0.9 shift 0 0.04\n"
    "projector right  screen round pixels 160 140 at  0.3 0.2 1.8 turn  50 0 roll 1 throw 0.9\n";
constexpr double kRadius = 3, kBottom = 0.6, kTop = 2.9, kSide = 75 * 3.14159265358979323846 / 180;

/// The walls between which the eye looks, each as many pixels wide; together 180 degrees.
const std::string kLookout =
    "wall left  lower-left -1.4142 0 0.7  lower-right 0 1.4142 0.7  upper-left -1.4142 0 2.7\n"
    "wall right lower-left 0 1.4142 0.7  lower-right 1.4142 0 0.7  upper-left 0 1.4142 2.7\n";

/// Remembers what each output got last.
class RememberedPictures final : public PictureSource {
public:
  explicit RememberedPictures(PictureSource& source) : source_(source) {}
  std::vector<Picture> draw(std::size_t entry, const Pose& X_RH, const Painter& paint) override {
    std::vector<Picture> all = source_.draw(entry, X_RH, paint);
    last[entry] = all.front();
    return all;
  }
  std::map<std::size_t, Picture> last;

private:
  PictureSource& source_;
};

/// The projective texture of a lens: the share of its picture that a point gets, as projector.h defines it.
std::optional<Vec2> shareAt(const Projector& projector, const Vec3& aside, const Vec3& point) {
  const auto& lens = std::get<LensImage>(projector.image);
  const Vec3 p = lens.X_RP.q.conjugate() * (point - lens.X_RP.p - aside);
  if (p.y() < 0.1) return std::nullopt;
  const double w = 1 / lens.throwRatio, h = w * projector.height / projector.width;
  return Vec2(0.5 - lens.shift.x() + p.x() / p.y() / w, 0.5 + lens.shift.y() - p.z() / p.y() / h);
}

constexpr std::uint32_t kMargin = 8;  ///< black pixels around a picture in its texture

/// The screen with the picture on it, shifted by `offset`, so that the eye is where the head is.
GltfBuilder screenWith(const Projector& projector, const Vec3& aside, const Vec3& offset) {
  constexpr std::uint16_t kColumns = 300, kRows = 60;
  std::vector<float> points, places;
  std::vector<char> lit;
  for (int j = 0; j <= kRows; ++j)
    for (int i = 0; i <= kColumns; ++i) {
      const double azimuth = kSide * (2.0 * i / kColumns - 1);
      const Vec3 p(kRadius * std::sin(azimuth), kRadius * std::cos(azimuth),
                   kBottom + (kTop - kBottom) * j / kRows);
      const auto share = shareAt(projector, aside, p);
      lit.push_back(share.has_value());
      const Vec2 pixel =
          share ? Vec2(share->x() * projector.width, share->y() * projector.height) : Vec2(0, 0);
      places.push_back(static_cast<float>((pixel.x() + kMargin) / (projector.width + 2 * kMargin)));
      places.push_back(static_cast<float>((pixel.y() + kMargin) / (projector.height + 2 * kMargin)));
      const Vec3 shown = p + offset;  // glTF has +Y up
      for (const double c : {shown.x(), shown.z(), -shown.y()}) points.push_back(static_cast<float>(c));
    }
  std::vector<std::uint16_t> corners;
  for (int j = 0; j < kRows; ++j)
    for (int i = 0; i < kColumns; ++i) {
      const int a = j * (kColumns + 1) + i, b = a + kColumns + 1;
      if (!lit[static_cast<std::size_t>(a)] || !lit[static_cast<std::size_t>(b + 1)]) continue;
      for (const int corner : {a, a + 1, b + 1, a, b + 1, b})
        corners.push_back(static_cast<std::uint16_t>(corner));
    }
  GltfBuilder b;
  b.attribute("POSITION", points, GltfBuilder::kFloat, "VEC3", points.size() / 3);
  b.attribute("TEXCOORD_0", places, GltfBuilder::kFloat, "VEC2", places.size() / 2);
  b.primitive()["indices"] = b.accessor(corners, GltfBuilder::kUnsignedShort, "SCALAR", corners.size());
  b.primitive()["material"] = 0;
  b.json["materials"] =
      nlohmann::json::parse(R"([{"doubleSided": true, "extensions": {"KHR_materials_unlit": {}},
      "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}])");
  b.json["extensionsUsed"] = {"KHR_materials_unlit"};
  b.json["textures"] = nlohmann::json::parse(R"([{"source": 0, "sampler": 0}])");
  constexpr int kLinear = 9729, kClampToEdge = 33071;
  b.json["samplers"] = {
      {{"minFilter", kLinear}, {"magFilter", kLinear}, {"wrapS", kClampToEdge}, {"wrapT", kClampToEdge}}};
  return b;
}

Picture withMargin(const Picture& picture) {
  Picture wide(picture.width + 2 * kMargin, picture.height + 2 * kMargin);
  for (std::uint32_t y = 0; y < wide.height; ++y)
    for (std::uint32_t x = 0; x < wide.width; ++x) {
      const bool inside =
          x >= kMargin && y >= kMargin && x < kMargin + picture.width && y < kMargin + picture.height;
      for (std::uint32_t c = 0; c < 4; ++c)
        wide.at(x, y)[c] = c == 3 ? 255 : inside ? picture.at(x - kMargin, y - kMargin)[c] : 0;
    }
  return wide;
}

class OneFrame final : public PictureSink {
public:
  bool wants(const TimeSignature&) const override { return true; }
  Failure take(const TimeSignature&, const std::vector<EyePictures>& walls) override {
    pictures.clear();
    for (const EyePictures& wall : walls) pictures.push_back(wall.eyes.front());
    return {};
  }
  std::vector<Picture> pictures;
};

/// What the eye sees on the walls of the lookout while one projector is on.
std::vector<Picture> seenAlone(const TestFolder& folder, const std::string& model) {
  folder.write("lookout.walls", kLookout);
  ShowOptions options;
  options.script =
      folder.write("hall.evs", "sky( zenith=\"0, 0, 0\", horizon=\"0, 0, 0\", ground=\"0, 0, 0\" )\n"
                               "tones( curve=clamp )\nobject( name=screen, file=" +
                                   model + " )\n");
  options.walls = folder.path() / "lookout.walls";
  options.size = "1600x1600";
  options.input = "none";
  options.frames = 1;
  Diagnostics findings;
  const std::unique_ptr<Player> player =
      options.complete(findings) ? Player::create(options, findings) : nullptr;
  printFindings(findings);
  const auto renderer = ShowRenderer::open({RendererChoice::Cpu});
  if (!player || !renderer) return {};
  OneFrame sink;
  ShowParts parts = player->parts(StereoLayout::Off);
  renderer.value()->drawFor(parts);
  parts.sink = &sink;
  ShowStages stages(std::move(parts));
  const std::atomic<bool> never = false;
  FrameLoop loop(stages, player->loopOptions(), never);
  EXPECT_FALSE(loop.run().failure);
  return sink.pictures;
}

/// The light that comes along a direction, between the pixels of the lookout.
Vec3 lightAlong(const std::vector<Picture>& walls, const Vec3& direction) {
  const bool right = direction.x() > 0;
  const Picture& picture = walls[right ? 1 : 0];
  const double turned = std::sqrt(0.5);
  const double depth = turned * ((right ? direction.x() : -direction.x()) + direction.y());
  const double across = turned * (right ? direction.x() - direction.y() : direction.x() + direction.y());
  const double x = 0.5 * picture.width * (1 + across / depth) - 0.5;
  const double y = 0.5 * picture.height * (1 - direction.z() / depth) - 0.5;
  const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
  Vec3 light = Vec3::Zero();
  for (int k = 0; k < 4; ++k) {
    const int column = std::clamp(i + k % 2, 0, static_cast<int>(picture.width) - 1);
    const int row = std::clamp(j + k / 2, 0, static_cast<int>(picture.height) - 1);
    const double share = (k % 2 == 1 ? x - i : 1 - x + i) * (k / 2 == 1 ? y - j : 1 - y + j);
    const std::uint8_t* value =
        picture.at(static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row));
    for (int c = 0; c < 3; ++c) light[c] += share * linearFromSrgb(value[c] / 255.0);
  }
  return light;
}

/// Whether an edge of the screen or of a picture is nearer than two pixels: light ends there, and a renderer
/// that samples beside pixels' centres sees a part of it.
bool nearAnEdge(const WallFile& hall, const Vec3& point) {
  constexpr double kNear = 0.06;  // [m]
  const double aside = kRadius * (kSide - std::abs(std::atan2(point.x(), point.y())));
  if (aside < kNear || point.z() < kBottom + kNear || point.z() > kTop - kNear) return true;
  return std::ranges::any_of(hall.walls, [&](const WallEntry& e) {
    const Projector& p = *e.projector;
    const auto share = shareAt(p, Vec3::Zero(), point);
    if (!share) return false;
    const auto beyond = [](double place, double size) { return std::max(-place, place - 1) * size; };
    return std::abs(std::max(beyond(share->x(), p.width), beyond(share->y(), p.height))) < 2;
  });
}

struct Difference {
  double mean = 0, most = 0;  ///< of the light, as a share of white
  std::size_t count = 0;
};

using SeenWalls = std::vector<Picture>;  ///< of the lookout

/// What the eye sees of one projector, which is `aside` of its place.
SeenWalls sceneOf(const WallFile& hall, std::size_t entry, const Picture& output, const Vec3& aside) {
  const TestFolder folder;
  const Vec3 offset(0.5 * hall.eyeSeparation, 0, 0);  // the left eye is half of it to the left of the head
  GltfBuilder model = screenWith(*hall.walls[entry].projector, aside, offset);
  EXPECT_FALSE(writePng((folder.path() / "output.png").string(), withMargin(output)));
  model.json["images"] = {{{"uri", "output.png"}}};
  folder.write("screen.glb", model.glb());
  return seenAlone(folder, "screen.glb");
}

/// Compares what the simulator saw with the scenes' sum.
Difference differenceOf(const WallFile& hall, const std::vector<SeenPixel>& seen,
                        const std::vector<SeenWalls>& scenes) {
  Difference d;
  for (const SeenPixel& pixel : seen) {
    if (nearAnEdge(hall, pixel.point)) continue;
    Vec3 sum = Vec3::Zero();
    for (const SeenWalls& walls : scenes) sum += lightAlong(walls, pixel.direction);
    const double error = (sum - pixel.light).cwiseAbs().maxCoeff();
    d.mean += error;
    d.most = std::max(d.most, error);
    ++d.count;
  }
  d.mean /= static_cast<double>(std::max<std::size_t>(1, d.count));
  return d;
}

TEST(ProjectedTextures, ShowTheHallAsTheSimulatorSeesIt) {
  Diagnostics out;
  const auto hall = parseWalls(kRoundHall, "round.walls", out);
  ASSERT_TRUE(hall) << (out.all().empty() ? "" : out.all()[0].message);
  auto drawn = drawnPictures(*hall);
  ASSERT_TRUE(drawn);
  RememberedPictures source(*drawn.value());
  std::vector<SeenPixel> seen;
  SimulationSettings settings;
  settings.every = 3;
  settings.seen = [&](const SeenPixel& pixel) { seen.push_back(pixel); };
  ASSERT_TRUE(simulateHall(*hall, source, settings));
  ASSERT_EQ(source.last.size(), 3u);
  ASSERT_GT(seen.size(), 3000u);
  std::vector<SeenWalls> scenes;
  for (const auto& [entry, output] : source.last)
    scenes.push_back(sceneOf(*hall, entry, output, Vec3::Zero()));
  for (const SeenWalls& walls : scenes) ASSERT_EQ(walls.size(), 2u);
  // What is left comes from sampling lines that are 1.4 pixels wide: this was 0.007 and 0.09.
  const Difference same = differenceOf(*hall, seen, scenes);
  EXPECT_GT(same.count, 5000u);
  EXPECT_LE(same.mean, 0.01);
  EXPECT_LE(same.most, 0.12);
  scenes[0] = sceneOf(*hall, 0, source.last[0], Vec3(0.01, 0, 0));
  const Difference moved = differenceOf(*hall, seen, scenes);
  EXPECT_GE(moved.mean, 1.5 * same.mean) << "one of three projectors, 1 cm aside, must be seen";
  EXPECT_GE(moved.most, 2.5 * same.most);
}

}  // namespace
}  // namespace stadion::test
