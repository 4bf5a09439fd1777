#pragma once
/// The messages between a show and a process that draws one of its walls, or in the plain look one view.
///
/// The show sends an OrderHead, and the process answers with an AnswerHead and a text. The messages travel
/// over a pair of sockets that keep them apart (SOCK_SEQPACKET). The first message carries the descriptors of
/// three memory segments: the draw list, the meshes (shared_meshes.h) and the pictures. Both programs are of
/// one build, so structs travel as they are. If one program exits, the other one's socket ends. The two share
/// no lock.

#include "pipeline/draw_list/draw_counts.h"
#include "pipeline/draw_list/renderer.h"
#include "pipeline/platform/processor_set.h"
#include "pipeline/shader/look.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace stadion::wall_process {

constexpr std::uint32_t kMagic = 0x57445453;  // "STDW"
constexpr std::uint32_t kVersion = 8;
constexpr std::size_t kLongestText = 4096;

// Address space, not memory.
constexpr std::size_t kListReserve = std::size_t{1} << 32, kMeshReserve = std::size_t{1} << 38,
                      kPictureReserve = std::size_t{1} << 32;

enum class Order : std::uint32_t {
  Open,  ///< with the segments' descriptors: list, meshes, pictures
  Draw,  ///< draws the list in the list's segment; with `read`, then does as Read
  Read,  ///< writes the pictures drawn last into the pictures' segment, view by view
};

struct OrderHead {
  std::uint32_t magic = kMagic, version = kVersion;
  Order order = Order::Open;
  // Of Open.
  std::uint32_t width = 0, height = 0;  ///< size of one view's picture [pixels]
  RendererKind renderer = RendererKind::OsMesa;
  std::uint32_t rasteriserThreads = 0;  ///< 0: the thread that draws makes the pixels, too
  RenderQuality quality{};
  std::optional<std::uint32_t> card{};  ///< graphics card that draws; none: the provider's choice
  ProcessorSet processors{};            ///< processors that the process may use; empty: all
  // Of Draw.
  std::uint32_t read = 0;    ///< 1: one answer for drawing and reading, so no crash can fall between them
  std::uint32_t warmUp = 0;  ///< 1: what it draws is not counted
  std::uint64_t listBytes = 0;
};

struct AnswerHead {
  std::uint32_t magic = kMagic;
  Order to = Order::Open;
  std::uint32_t failed = 0;  ///< the text says why
  std::uint32_t textBytes = 0;
  ViewTotals totals{};  ///< totals since the process began; for Draw
};

}  // namespace stadion::wall_process
