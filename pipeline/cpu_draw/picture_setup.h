#pragma once
/// The triangles of one picture: instances are placed, and their triangles set up and sorted into bands.
///
/// Work     in pieces of a few thousand vertices or triangles. Sections of a mesh that the picture cannot see
///          are left out (mesh_section.h). How the work is divided depends on the list alone; so do the results.
/// Order    records of a band are in the order in which instances were added.
/// Threads  add() on one thread. Then all pieces of place(), on any; then all pieces of setUp(), on any.

#include "pipeline/cpu_draw/kernels/kernel_data.h"
#include "pipeline/cpu_draw/mesh/cpu_mesh.h"
#include "pipeline/cpu_draw/mesh/mesh_paints.h"
#include "pipeline/cpu_draw/view_geometry.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace stadion {

/// A mesh somewhere.
struct PictureInstance {
  std::shared_ptr<const CpuMesh> mesh;
  std::shared_ptr<const MeshPaint> paint;  ///< null: the materials are the mesh's
  std::array<float, 12> model;             ///< (3 x 4), row major: mesh coordinates to World axes
  std::array<float, 9> normals;            ///< (3 x 3), row major: normals to World axes, of any length
  PixelMatrix matrix;
  std::size_t firstVertex;  ///< among all placed ones
  bool mirrored;            ///< the model matrix turns left into right
};

/// Triangles of a part of an instance that are set up together.
struct TriangleStretch {
  std::uint32_t instance, first, count;
  const CpuPart* part;
  std::uint32_t material;  ///< among PictureSetup::materials
  bool transparent, masked;
};

/// Which part of a picture's triangles something is about.
enum class Transparency { Opaque, Transparent };

class TriangleClipper;

class PictureSetup {
public:
  explicit PictureSetup(const DrawKernels& kernels) : kernels_(kernels) {}

  /// Begins a picture with no instances. Depths are moved by a multiple of the slope and of the smallest
  /// step.
  void begin(const ViewGeometry& geometry, int samples, float slopeOffset = 0, float stepOffset = 0);
  /// Adds the opaque or the transparent parts of a mesh in its paint; null: it has none. Returns false, and adds nothing, if the matrix is
  /// not finite.
  bool add(const std::shared_ptr<const CpuMesh>& mesh, std::uint32_t level,
           const std::array<float, 12>& model, Transparency which,
           const std::shared_ptr<const MeshPaint>& paint = nullptr);
  /// After the last add().
  void divide();

  std::size_t placePieces() const { return placements_.size(); }
  void place(std::size_t piece);
  std::size_t setUpPieces() const { return chunksUsed_; }
  void setUp(std::size_t piece);

  /// Calls work(records, numbers, masked) for the triangles that may cover a sample of a band: the records
  /// with these numbers.
  template <class Work>
  void forEach(Transparency which, std::size_t band, const Work& work) const {
    for (const Chunk& chunk : std::span(chunks_.data(), chunksUsed_)) {
      const std::uint32_t first = chunk.binEnds[band], end = chunk.binEnds[band + 1];
      if (chunk.which == which && first < end)
        work(chunk.records.data(), std::span(chunk.bins).subspan(first, end - first), chunk.masked);
    }
  }
  const TriangleStretch& stretchOf(const TriangleRecord& record) const {
    return stretches_[record.sourceAndFlags >> kFlagBits];
  }

  const ViewGeometry& geometry() const { return geometry_; }
  int samples() const { return samples_; }
  std::size_t bands() const { return bands_; }
  /// Of an instance; not finite or without meaning for those behind the eye.
  PlacedVertices placed(const PictureInstance& instance) const {
    return {const_cast<float*>(placed_.data()) + 4 * instance.firstVertex};  // the kernels only read
  }
  const PictureInstance& instance(std::uint32_t i) const { return instances_[i]; }
  /// Returns true if a mesh has extras (SurfaceExtra).
  bool hasExtras() const { return hasExtras_; }
  std::span<const MaterialParameters* const> materials() const { return materials_; }
  /// Instances, a part of a mesh each, and their triangles.
  std::uint32_t partsAdded() const { return static_cast<std::uint32_t>(partsAdded_); }
  std::uint64_t trianglesAdded() const { return trianglesAdded_; }

private:
  struct Placement {
    std::uint32_t instance, first, count;  ///< vertices
  };
  struct Chunk {
    Transparency which = Transparency::Opaque;
    bool masked = false;
    std::uint32_t firstStretch = 0, endStretch = 0, triangles = 0;
    std::vector<TriangleRecord> records;
    std::vector<std::uint32_t> bins;     ///< numbers of records, by band
    std::vector<std::uint32_t> binEnds;  ///< where a band's begin; one more than there are bands
  };

  /// The vertices [first, end) of an instance, in multiples of kPlacedRounding.
  struct VertexRange {
    std::uint32_t first, end;
  };
  void addPart(std::uint32_t instance, const CpuPart& part, std::uint32_t material);
  void addPlacements(std::uint32_t instance);
  std::uint32_t materialNumber(const MaterialParameters& material);
  SetupParameters parametersOf(std::uint32_t stretch) const;
  void setUpStretch(std::uint32_t stretch, std::vector<TriangleRecord>& records) const;
  void finish(const TriangleRecord& record, const TriangleStretch& stretch, const TriangleClipper& clipper,
              std::vector<TriangleRecord>& records) const;
  void sortIntoBands(Chunk& chunk) const;

  const DrawKernels& kernels_;
  ViewGeometry geometry_;
  int samples_ = 1;
  float slopeOffset_ = 0, stepOffset_ = 0;
  std::size_t bands_ = 0;
  std::vector<PictureInstance> instances_;
  std::vector<TriangleStretch> stretches_;
  std::vector<const MaterialParameters*> materials_;
  std::vector<Placement> placements_;
  std::vector<VertexRange> wanted_;  ///< of the instance that is being added
  std::vector<Chunk> chunks_;        ///< keep their memory
  std::size_t chunksUsed_ = 0;
  std::size_t vertices_ = 0, partsAdded_ = 0;
  std::uint64_t trianglesAdded_ = 0;
  bool hasExtras_ = false;
  std::vector<float> placed_;
};

}  // namespace stadion
