/// stadion-assets: writes the show's own models and sounds into a folder, and the scripts of its athletes
/// into another.
///
/// The models in assets/ are made by this program and nothing else; a test compares them byte for byte. It
/// uses only arithmetic that is the same on every machine.

#include "assets/generator/craft/models.h"
#include "assets/generator/craft/picture.h"
#include "assets/generator/craft/sounds.h"
#include "assets/generator/olympia/athletes.h"
#include "assets/generator/olympia/body.h"
#include "assets/generator/olympia/olympia.h"

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
  if (isHelp || argc < 2 || argc > 3 || argv[1][0] == '-') {
    std::fputs("Usage: stadion-assets MODELDIR [SCRIPTDIR]\n"
               "Writes the models, pictures and sounds of the shows into MODELDIR. If SCRIPTDIR is given, it "
               "also writes "
               "the scripts of the athletes there.\n",
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
      {"athlete_pelvis.glb", toGlb(pelvis())},
      {"athlete_chest.glb", toGlb(chest())},
      {"athlete_head_dark.glb", toGlb(head(Hair::Dark, 0.0098))},
      {"athlete_head_fair.glb", toGlb(head(Hair::Fair, 0.0098))},
      {"athlete_head_beard.glb", toGlb(head(Hair::Bearded, 0.0098))},
      {"judge_head.glb", toGlb(head(Hair::Bearded, 0.0145))},
      {"herald_head.glb", toGlb(head(Hair::Fair, 0.0145))},
      {"judge_robe.glb", toGlb(robe({0.50, 0.18, 0.28}, {0.86, 0.74, 0.46}))},
      {"herald_robe.glb", toGlb(robe({0.92, 0.89, 0.82}, {0.62, 0.22, 0.18}))},
      {"trumpet.glb", toGlb(trumpet())},
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
      {"crowd_north_1.glb", toGlb(crowd(1, -50, 42))},
      {"crowd_north_2.glb", toGlb(crowd(1, 42, 202))},
      {"crowd_south_1.glb", toGlb(crowd(-1, -50, 42))},
      {"crowd_south_2.glb", toGlb(crowd(-1, 42, 202))},
  };
  const std::pair<const char*, Parts> limbs[] = {{"upper_arm", upperArm()}, {"forearm", forearm()},
                                                 {"hand", hand()},          {"thigh", thigh()},
                                                 {"shin", shin()},          {"foot", foot()}};
  for (const auto& [name, right] : limbs)
    if (!write(out / ("athlete_right_" + std::string(name) + ".glb"), toGlb(right)) ||
        !write(out / ("athlete_left_" + std::string(name) + ".glb"), toGlb(leftOf(right))))
      return 2;
  for (const auto& [name, bytes] : files)
    if (!write(out / name, bytes)) return 2;
  if (!writeSounds(out)) return 2;
  if (argc == 2) return 0;
  const std::filesystem::path scripts = argv[2];
  std::filesystem::create_directories(scripts, error);
  const bool written = write(scripts / "athlete_discus.evs", discusScript()) &&
                       write(scripts / "athlete_javelin.evs", javelinScript()) &&
                       write(scripts / "athlete_ball.evs", ballScript()) &&
                       write(scripts / "officials.evs", officialsScript());
  return written ? 0 : 2;
}
