#pragma once
/// The messages between the show and its importer program over a pair of stream sockets.
///
/// The show sends a request head together with the descriptor of the asset root, then the name below that
/// root and the selection of nodes. The program answers with an answer head, a text (the inventory, or the reason of the failure)
/// and the bytes of the mesh (see mesh_file). Both are the same build, so structs are sent as they are. The
/// show still trusts nothing it receives.

#include "engine/asset/format.h"
#include "engine/asset/mesh_file.h"

#include <cstdint>

namespace stadion {

constexpr std::uint32_t kImportMagic = 0x51495453;  // "STIQ"
constexpr std::uint32_t kAnswerMagic = 0x41495453;  // "STIA"
constexpr std::uint32_t kImportVersion = 7;
constexpr std::uint32_t kLongestPath = 4096;
constexpr std::uint32_t kLongestSelection = 1u << 20;
constexpr std::uint32_t kLongestText = 65536;
constexpr std::uint64_t kLongestAnswer = 1ull << 30;
constexpr int kOutOfMemoryExit = 77;

struct RequestHead {
  std::uint32_t magic = kImportMagic, version = kImportVersion;
  std::uint64_t addressSpace = 0;  ///< [bytes] RLIMIT_AS
  std::uint64_t fileBytes = 0;     ///< [bytes] largest file that is opened
  std::uint32_t cpuSeconds = 0;    ///< [s] for this file
  std::uint32_t nodeDepth = 0;
  MeshLimits mesh;
  double unit = 0;       ///< [m], 0 = as the format has it
  std::uint32_t up = 0;  ///< UpAxis + 1, 0 = as the format has it
  ModelForm form = ModelForm::Object;
  std::uint32_t pathBytes = 0;   ///< size of the file name that follows
  std::uint32_t nodesBytes = 0;  ///< size of the text of the selection of nodes that follows the name
};

enum class ImportStatus : std::uint32_t { Loaded, Failed, OutOfMemory };

struct AnswerHead {
  std::uint32_t magic = kAnswerMagic, version = kImportVersion;
  ImportStatus status = ImportStatus::Failed;
  std::uint32_t textBytes = 0;
  std::uint64_t meshBytes = 0;
};

}  // namespace stadion
