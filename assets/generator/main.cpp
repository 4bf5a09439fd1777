/// stadion-assets: writes the show's own models and sounds into a folder.
///
/// The models in assets/ are made by this program and nothing else; a test compares them byte for byte. It
/// uses only arithmetic that is the same on every machine.

#include "assets/generator/craft/models.h"
#include "assets/generator/craft/picture.h"
#include "assets/generator/craft/sounds.h"
#include "assets/generator/olympia/athletes.h"
#include "assets/generator/olympia/officials.h"
#include "assets/generator/olympia/olympia.h"
#include "assets/generator/olympia/spectators.h"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

namespace {

bool write(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream file(path, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) std::fprintf(stderr, "stadion-assets: cannot write %s\n", path.c_str());
  return bool(file);
}

bool writeSounds(const std::filesystem::path& out) {
  using namespace stadion::assets;
  return write(out / "wind.wav", toWav(wind())) && write(out / "cheer.wav", toWav(cheer())) &&
         write(out / "trumpet.wav", toWav(trumpetCall())) && write(out / "thud.wav", toWav(thud())) &&
         write(out / "whoosh.wav", toWav(whoosh()));
}

}  // namespace

int main(int argc, char** argv) {
  const bool isHelp = argc == 2 && (argv[1] == std::string("--help") || argv[1] == std::string("-h"));
  if (isHelp || argc != 2 || argv[1][0] == '-') {
    std::fputs("Usage: stadion-assets MODELDIR\n"
               "Writes the models, pictures and sounds of the shows into MODELDIR.\n",
               isHelp ? stdout : stderr);
    return isHelp ? 0 : 2;
  }
  const std::filesystem::path out = argv[1];
  std::error_code error;
  std::filesystem::create_directories(out, error);
  using namespace stadion::assets;
  const ObjFile footFiles = toObj(crudeFoot(), "crude_foot");
  const std::pair<const char*, std::string> files[] = {
      {"football.3ds", to3ds(football())},
      {"plane.3ds", to3ds(pitch())},
      {"grass.png", grassPicture()},
      {"crude_foot.obj", footFiles.obj},
      {"crude_foot.mtl", footFiles.mtl},
      {"earth.png", earthPicture()},
      {"meadow.png", meadowPicture()},
      {"stone.png", stonePicture()},
      {"leaves.png", leavesPicture()},
      {"discus.glb", toGlb(discus())},
      {"javelin.glb", toGlb(javelin())},
      {"herald.glb", toGlb(herald())},
      {"judge.glb", toGlb(judge())},
      {"staff.glb", toGlb(staff())},
      {"trumpet.glb", toGlb(trumpet())},
      {"athlete_discus.glb", toGlb(discusThrower())},
      {"athlete_javelin.glb", toGlb(javelinThrower())},
      {"athlete_ball.glb", toGlb(ballPlayer())},
      {"leather_ball.glb", toGlb(leatherBall())},
      {"plinth.glb", toGlb(plinth())},
      {"whiteboard.glb", toGlb(whiteboard())},
      {"javelin_rack.glb", toGlb(javelinRack())},
      {"olympia_ground.glb", toGlb(groundPlane())},
      {"olympia_track.glb", toGlb(track())},
      {"olympia_stonework.glb", toGlb(stonework())},
      {"olympia_banks.glb", toGlb(embankments())},
      {"olympia_land.glb", toGlb(countryside())},
      {"olympia_trees.glb", toGlb(trees())},
      {"olympia_wood.glb", toGlb(kronosWood())},
      {"olympia_stands.glb", toGlb(stands())},
      {"olympia_temples.glb", toGlb(temples())},
      {"olympia_passage.glb", toGlb(passage())},
      {"spectators_north.glb", toGlb(nearSpectators(1), 0.004, 0.02)},
      {"spectators_south.glb", toGlb(nearSpectators(-1), 0.004, 0.02)},
      {"crowd_north_1.glb", toGlb(crowd(1, -50, 42))},
      {"crowd_north_2.glb", toGlb(crowd(1, 42, 202))},
      {"crowd_south_1.glb", toGlb(crowd(-1, -50, 42))},
      {"crowd_south_2.glb", toGlb(crowd(-1, 42, 202))},
  };
  for (const auto& [name, bytes] : files)
    if (!write(out / name, bytes)) return 2;
  return writeSounds(out) ? 0 : 2;
}
