#pragma once
/// Draws a wall's draw lists with OpenGL 3.3 core.
///
/// Order        shadow maps, as far as they have changed, then opaque things instanced by mesh, then the sky
/// where nothing was drawn, then what is transparent,
///              sorted for every sample (glass_layers.h; below OpenGL 4.3 by whole objects, far to near), blended
///              and without writing depth. 4 samples a pixel, light
///              computed in linear RGB, pictures in sRGB (shaders.h says how).
/// Beginning    with what is there of a list that is still filled: the first view's opaque things are drawn as
///              they come, unless all must be known first (what is timed alone, what hides what).
/// Same pixels  for the same list in every thread, context and provider of one Mesa version.
/// Ownership    owns its GL objects; the table, the mutex and the mesh store must outlive it.
///              Meshes are uploaded at
///              their first use and freed once the store has freed them.
/// Threads      made, used and destroyed on the thread on which its context is current. Renderers of a
///              software rasteriser take turns, since Mesa looks for a texture that is bound or read in what
///              its other contexts are drawing, without a lock (22.3, lp_scene_is_resource_referenced), and
///              crashes when one of them ends a scene just then. They wait for their pixels together.
/// Errors       returned once per kind, never thrown; what can be drawn is drawn.

#include "pipeline/draw/draw_sampler.h"
#include "pipeline/draw/gpu/mesh_cache.h"
#include "pipeline/draw/passes/eye_buffers.h"
#include "pipeline/draw/passes/glass_layers.h"
#include "pipeline/draw/passes/shadow_maps.h"
#include "pipeline/draw_list/draw_list.h"
#include "pipeline/draw_list/instance_batches.h"
#include "pipeline/gl/gl_program.h"
#include "pipeline/shader/look.h"
#include "pipeline/shader/shaders.h"
#include "pipeline/shader/uniform_blocks.h"

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>

namespace stadion {

/// What the last draw of a view consisted of: the same on every machine, so tests may pin it.
struct DrawCounts {
  std::uint32_t calls = 0;      ///< draw calls
  std::uint32_t instances = 0;  ///< meshes drawn, an instance of two parts counting twice
  std::uint64_t triangles = 0;
};

/// The same, of everything that was drawn so far.
struct DrawTotals {
  std::uint64_t frames = 0, calls = 0, instances = 0, triangles = 0;
  void add(const DrawCounts& c) { add({1, c.calls, c.instances, c.triangles}); }
  void add(const DrawTotals& t) {
    frames += t.frames, calls += t.calls, instances += t.instances, triangles += t.triangles;
  }
};

using ViewTotals = std::array<DrawTotals, DrawList::kMostViews>;  ///< by view of a wall

class Renderer {
public:
  /// Pictures of width x height pixels; fails if the size or the context does not serve.
  static Result<std::unique_ptr<Renderer>> create(const GlTable& gl, std::mutex& turns,
                                                  const MeshStore& meshes, std::uint32_t width,
                                                  std::uint32_t height, RenderQuality quality = {});
  ~Renderer();

  /// Draws every view of the list and waits until that is done: time around it is what drawing costs. Returns
  /// a problem that had not been reported before, or nothing. `giveUp`, if there is one, is asked now and
  /// then; once it says true, RunStopped is thrown and the pictures are void.
  std::optional<Diagnostic> draw(const DrawList& list, const std::function<bool()>& giveUp,
                                 FrameProbe* probe = nullptr);
  std::optional<Diagnostic> draw(const DrawList& list) { return draw(list, std::function<bool()>{}); }
  /// Draws one view.
  std::optional<Diagnostic> draw(const DrawList& list, std::uint32_t view);

  /// The last picture of `view`, which was drawn: 8-bit RGBA (height x width x 4), rows from the top, sRGB, alpha 255.
  /// Expects room for exactly that. Returns a new problem, or nothing.
  std::optional<Diagnostic> read(std::uint32_t view, std::span<std::uint8_t> rgba);

  /// The driver has given up the context (the graphics card was reset, or is gone): nothing can be drawn with
  /// it any more.
  bool contextIsLost() const { return contextIsLost_; }
  std::uint32_t width() const { return width_; }    ///< [pixels]
  std::uint32_t height() const { return height_; }  ///< [pixels]
  RenderQuality quality() const { return quality_; }
  const DrawCounts& counts() const { return counts_; }
  /// Shadow maps are not counted.
  const ViewTotals& totals() const { return totals_; }
  void forgetTotals() { totals_ = {}; }
  std::size_t meshesHeld() const { return cache_.size(); }
  /// Whether anything transparent has been drawn so far: else there are no buffers for it.
  bool holdsLayers() const { return layers_ != nullptr; }

private:
  static constexpr std::size_t kMostCounted = 4;  ///< lights for which there are programs of their own
  /// Those that differ in the mesh and in local lights, by SurfaceTraits::index(). The usual ones are built
  /// together, the others each at its first use.
  struct Surfaces {
    SurfaceTraits common;
    std::array<std::optional<GlProgram>, SurfaceTraits::kCount> programs;
    std::array<bool, SurfaceTraits::kCount> failed{};
    bool empty() const { return !programs[0]; }
  };
  struct Programs {
    /// One set for air without haze and shadows, which is there from the start; the others, each at its first
    /// use.
    std::array<Surfaces, 4 * (kMostCounted + 2)> surface;
    std::vector<GlProgram> sky;  ///< one
  };
  enum class Pass { Opaque, OpaqueParts, Transparent, Layers };  ///< Transparent: whole objects are sorted


  Renderer(const GlTable& gl, std::mutex& turns, const MeshStore& meshes, std::uint32_t width,
           std::uint32_t height, RenderQuality quality, Programs programs);
  std::unique_lock<std::mutex> turn() const;
  static Result<Programs> buildPrograms(const GlTable& gl, Look look);

  /// A mesh at the level at which it is drawn.
  struct MeshParts {
    const GlMesh* gl;
    const std::vector<GlSubmesh>& parts;
    std::uint32_t triangles;
  };
  static MeshParts partsOf(const GlMesh& mesh, std::uint32_t level);

  using Turn = std::unique_lock<std::mutex>;
  void drawViews(const DrawList& list, std::uint32_t first, std::uint32_t end);
  void submitViews(const DrawList& list, std::uint32_t first, std::uint32_t end, Turn& turn);
  void tellCounts() const;
  void beginSampling(const DrawList& list);
  void drawNothing();
  float workOf(std::size_t instance, const MeshParts& mesh) const;
  template <class F>
  void forEachBatch(const F& f);
  void weigh();
  std::uint32_t togetherFrom(const InstanceBatch& batch, std::uint32_t done, const MeshParts& mesh) const;
  void findPieces(std::uint32_t eye);
  std::span<const NodeShare> sharesOf(std::uint32_t eye, std::uint32_t first, std::uint32_t end);
  template <class Work>
  void part(Span what, const Work& work) {
    if (sample_ == DrawSample::Some)
      sampler_->part(what, work);
    else
      work();
  }
  static Span spanOf(const DrawView& view) {
    return view.eye == Eye::Left ? Span::LeftEye : Span::RightEye;
  }
  void drawViewAlone(const DrawView& view, std::uint32_t index, Turn& turn);
  void prepare(const DrawList& list);
  bool takeMore();
  bool hasOpaque(std::size_t batch);
  void uploadInstances();
  void prepareScene(const DrawList& list);
  void prepareShadows(const DrawList& list);
  static std::optional<Diagnostic> buildSurfaces(const GlTable& gl, const SurfaceTraits& common,
                                                 Surfaces& set);
  const GlProgram& surfaceFor(SurfaceTraits traits);
  void drawTransparent(const ViewBlock& view, std::uint32_t eye);
  bool coverTransparent(const ViewBlock& view, std::uint32_t eye);
  void drawLayers(std::uint32_t eye);
  void chooseSurfaces(bool shadowed, bool hazy, std::size_t lights);
  void drawView(const DrawView& from, std::uint32_t index, Turn& turn);
  bool drawSmallThings(const DrawView& from, std::uint32_t index, Turn& turn);
  void drawSmallThings(std::uint32_t eye, Turn* away);
  bool drawSmallThing(const MeshParts& mesh, const InstanceBatch& batch, std::uint32_t instance);
  void setUnchangingState();
  void settleState();
  bool isDrawn(std::uint32_t instance) const { return instance < isDrawn_.size() && isDrawn_[instance]; }
  void drawOpaqueBatches(std::uint32_t eye);
  void drawTransparentBatches(Pass pass, std::uint32_t eye);
  void drawBatch(const InstanceBatch& ofBoth, Pass pass, std::uint32_t eye);
  void drawInstances(const MeshParts& mesh, std::uint32_t first, std::uint32_t count, Pass pass);
  void drawSieved(const MeshParts& mesh, std::uint32_t first, std::uint32_t count);
  void drawOpaque(std::uint32_t eye);
  std::optional<float> nearQuarter(std::uint32_t eye);
  void drawOpaqueParts(const MeshParts& mesh, std::uint32_t first, std::uint32_t count, Pass pass);
  void drawTransparentParts(const MeshParts& mesh, std::uint32_t first, std::uint32_t count);
  void drawPart(const GlMesh& mesh, const GlSubmesh& part, std::uint32_t first, std::uint32_t instances,
                bool blended);
  void drawLayeredParts(const MeshParts& mesh, std::uint32_t first, std::uint32_t count);
  SurfaceTraits surfaceTraits(const GlSubmesh& part, bool blended) const;
  void beginPart(const GlMesh& mesh, const GlSubmesh& part, bool blended);
  void drawIndices(std::uintptr_t from, GLsizei count, std::uint32_t first, std::uint32_t instances);
  void stopIfAsked() const;
  void drawBackground();
  void drawSky();
  void cull(bool front, bool back);
  void use(const GlProgram& program);
  void bindMaterial(GLuint buffer, GLintptr at);
  std::optional<Diagnostic> collectProblems();
  void report(std::string what);

  const GlTable& gl_;
  std::mutex& turns_;
  std::unique_lock<std::mutex> lastTurn_;  ///< held while the members below are destroyed
  bool takesTurns_ = false;
  bool basesInstances_;  ///< a draw call may begin at any instance
  ClipDepth clipDepth_;
  bool layersGlass_;     ///< what is transparent is sorted for every sample
  std::uint32_t width_, height_;
  RenderQuality quality_;
  Programs programs_;
  EyeBuffers buffers_;
  MeshCache cache_;
  const DrawList* list_ = nullptr;            ///< that is drawn
  InstanceBatches batches_;                   ///< what was taken up of it
  bool complete_ = false;                     ///< that is all
  std::size_t uploaded_ = 0;                  ///< instances
  std::optional<TriangleSieve> sieve_;        ///< where it pays
  std::vector<TriangleSieve::Range> sieved_;  ///< by part and instance, while they are drawn
  std::array<float, 2> drawnFrom_{};          ///< what is sieved is this far, at least and less than [m]
  std::vector<float> depths_, distances_;
  std::optional<SmallThings> small_;  ///< likewise
  std::vector<bool> isDrawn_;         ///< by instance: as a small thing, for this eye
  bool mirrored_ = false;             ///< the batch that is drawn
  GlBuffer instances_, scene_, indices_;
  std::vector<GlBuffer> views_;  ///< as many as a list had at most
  GlVertexArray nothing_;  // the sky's triangle has no vertex data
  GLuint usedProgram_ = 0;
  std::pair<GLuint, GLintptr> boundMaterial_{};  ///< buffer, place in it [bytes]; in this eye
  bool localLights_ = false, shadowed_ = false;
  SceneBlock lit_{};                               ///< of the list that is drawn
  bool skyIsFlat_ = false;                         ///< one colour: cleared, not drawn
  Surfaces* surfaces_ = nullptr;                   ///< of the list that is drawn
  std::unique_ptr<GlassLayers> layers_;            ///< from the first list with something transparent on
  CoveredAreas covered_;                           ///< by what is transparent, for the eye that is drawn
  std::uint32_t layerTriangles_ = 0;               ///< that were kept before this call's, of this eye
  std::vector<DrawItem> sorted_;                   ///< what is transparent, where whole objects are sorted
  std::unique_ptr<ShadowMaps> shadows_;            ///< from the first list with shadows on
  bool noShadows_ = false;                         ///< this OpenGL cannot
  const std::function<bool()>* giveUp_ = nullptr;  ///< while a list is drawn
  FrameProbe* probe_ = nullptr;                    ///< likewise; null = none
  std::unique_ptr<DrawSampler> sampler_;           ///< from the first frame on that is sampled
  DrawSample sample_ = DrawSample::None;           ///< of the list that is drawn
  float work_ = 0;                                 ///< all there is to draw, while somebody asks
  std::vector<NodeShare> shares_;                  ///< of what is drawn alone
  std::vector<std::uint32_t> pieces_;              ///< likewise: the first instance of each
  std::vector<std::size_t> wanted_;                ///< of these, those that are to have a turn
  DrawCounts counts_;
  ViewTotals totals_{};
  std::set<std::string> reported_;
  std::optional<Diagnostic> problem_;
  bool contextIsLost_ = false;
};

}  // namespace stadion
