/// stadion-assets: writes the show's own models into a folder.
///
/// The models in assets/ are made by this program and nothing else; a test compares them byte for byte. It
/// uses only arithmetic that is the same on every machine.

#include "cli/assets/models.h"
#include "cli/assets/olympia/olympia.h"
#include "cli/assets/picture.h"

#include <cstdio>
#include <filesystem>
#include <fstream>

namespace {

bool write(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream file(path, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) std::fprintf(stderr, "stadion-assets: cannot write %s\n", path.c_str());
  return bool(file);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: stadion-assets OUTDIR\n", stderr);
    return 2;
  }
  const std::filesystem::path out = argv[1];
  std::error_code error;
  std::filesystem::create_directories(out, error);
  using namespace stadion::assets;
  const ObjFile foot = toObj(crudeFoot(), "crude_foot");
  const std::pair<const char*, std::string> files[] = {
      {"football.3ds", to3ds(football())},
      {"plane.3ds", to3ds(pitch())},
      {"grass.png", grassPicture()},
      {"crude_foot.obj", foot.obj},
      {"crude_foot.mtl", foot.mtl},
      {"earth.png", earthPicture()},
      {"meadow.png", meadowPicture()},
      {"stone.png", stonePicture()},
      {"leaves.png", leavesPicture()},
      {"discus.glb", toGlb(discus())},
      {"javelin.glb", toGlb(javelin())},
      {"leather_ball.glb", toGlb(leatherBall())},
      {"olympia_ground.glb", toGlb(groundPlane())},
      {"olympia_track.glb", toGlb(track())},
      {"olympia_banks.glb", toGlb(embankments())},
      {"olympia_land.glb", toGlb(countryside())},
      {"olympia_trees.glb", toGlb(trees())},
      {"olympia_wood.glb", toGlb(kronosWood())},
      {"olympia_stands.glb", toGlb(stands())},
      {"olympia_temples.glb", toGlb(temples())},
      {"olympia_passage.glb", toGlb(passage())},
      {"crowd_north_1.glb", toGlb(crowd(1, -9, 42))},
      {"crowd_north_2.glb", toGlb(crowd(1, 42, 202))},
      {"crowd_south_1.glb", toGlb(crowd(-1, -9, 42))},
      {"crowd_south_2.glb", toGlb(crowd(-1, 42, 202))},
  };
  for (const auto& [name, bytes] : files)
    if (!write(out / name, bytes)) return 2;
  return 0;
}
