/// stadion-assets: writes the show's own models into a folder.
///
/// The models in assets/ are made by this program and nothing else; a test compares them byte for byte. It
/// uses only arithmetic that is the same on every machine.

#include "cli/assets/models.h"

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
  const bool good = write(out / "football.3ds", to3ds(football())) &&
                    write(out / "plane.3ds", to3ds(pitch())) && write(out / "grass.png", grassPicture()) &&
                    write(out / "crude_foot.obj", foot.obj) && write(out / "crude_foot.mtl", foot.mtl);
  return good ? 0 : 2;
}
