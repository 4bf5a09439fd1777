#pragma once
/// The OpenGL functions that Stadion calls, as pointers from one provider.
///
/// No GL library is linked: several implementations live in one process, and each fills a table of its own.
/// The set is OpenGL 3.3 core, and some newer functions if they exist. To add a function, add its line here.
///
/// Ownership  plain pointers into a library that stays loaded until the process ends.
/// Threads    immutable once loaded; a call acts on the context that is current on the calling thread.

#include "engine/base/diagnostic.h"

#include <GL/glcorearb.h>

namespace stadion {

#define STADION_GL_FUNCTIONS(X)                                                                              \
  X(PFNGLACTIVETEXTUREPROC, ActiveTexture)                                                                   \
  X(PFNGLATTACHSHADERPROC, AttachShader)                                                                     \
  X(PFNGLBINDBUFFERPROC, BindBuffer)                                                                         \
  X(PFNGLBEGINQUERYPROC, BeginQuery)                                                                         \
  X(PFNGLBINDBUFFERBASEPROC, BindBufferBase)                                                                 \
  X(PFNGLBINDBUFFERRANGEPROC, BindBufferRange)                                                               \
  X(PFNGLBINDFRAMEBUFFERPROC, BindFramebuffer)                                                               \
  X(PFNGLBINDRENDERBUFFERPROC, BindRenderbuffer)                                                             \
  X(PFNGLBINDTEXTUREPROC, BindTexture)                                                                       \
  X(PFNGLBINDVERTEXARRAYPROC, BindVertexArray)                                                               \
  X(PFNGLBLENDFUNCSEPARATEPROC, BlendFuncSeparate)                                                           \
  X(PFNGLBLITFRAMEBUFFERPROC, BlitFramebuffer)                                                               \
  X(PFNGLBUFFERDATAPROC, BufferData)                                                                         \
  X(PFNGLBUFFERSUBDATAPROC, BufferSubData)                                                                   \
  X(PFNGLCHECKFRAMEBUFFERSTATUSPROC, CheckFramebufferStatus)                                                 \
  X(PFNGLCLEARPROC, Clear)                                                                                   \
  X(PFNGLCLEARCOLORPROC, ClearColor)                                                                         \
  X(PFNGLCLEARDEPTHPROC, ClearDepth)                                                                         \
  X(PFNGLCLIENTWAITSYNCPROC, ClientWaitSync)                                                                 \
  X(PFNGLCOLORMASKPROC, ColorMask)                                                                           \
  X(PFNGLCOMPILESHADERPROC, CompileShader)                                                                   \
  X(PFNGLCREATEPROGRAMPROC, CreateProgram)                                                                   \
  X(PFNGLCREATESHADERPROC, CreateShader)                                                                     \
  X(PFNGLCULLFACEPROC, CullFace)                                                                             \
  X(PFNGLDELETEBUFFERSPROC, DeleteBuffers)                                                                   \
  X(PFNGLDELETEFRAMEBUFFERSPROC, DeleteFramebuffers)                                                         \
  X(PFNGLDELETEPROGRAMPROC, DeleteProgram)                                                                   \
  X(PFNGLDELETEQUERIESPROC, DeleteQueries)                                                                   \
  X(PFNGLDELETERENDERBUFFERSPROC, DeleteRenderbuffers)                                                       \
  X(PFNGLDELETESHADERPROC, DeleteShader)                                                                     \
  X(PFNGLDELETESYNCPROC, DeleteSync)                                                                         \
  X(PFNGLDELETETEXTURESPROC, DeleteTextures)                                                                 \
  X(PFNGLDELETEVERTEXARRAYSPROC, DeleteVertexArrays)                                                         \
  X(PFNGLDEPTHFUNCPROC, DepthFunc)                                                                           \
  X(PFNGLDEPTHMASKPROC, DepthMask)                                                                           \
  X(PFNGLDISABLEPROC, Disable)                                                                               \
  X(PFNGLDRAWARRAYSPROC, DrawArrays)                                                                         \
  X(PFNGLDRAWBUFFERPROC, DrawBuffer)                                                                         \
  X(PFNGLDRAWELEMENTSINSTANCEDPROC, DrawElementsInstanced)                                                   \
  X(PFNGLENABLEPROC, Enable)                                                                                 \
  X(PFNGLENABLEVERTEXATTRIBARRAYPROC, EnableVertexAttribArray)                                               \
  X(PFNGLENDQUERYPROC, EndQuery)                                                                             \
  X(PFNGLFENCESYNCPROC, FenceSync)                                                                           \
  X(PFNGLFINISHPROC, Finish)                                                                                 \
  X(PFNGLFLUSHPROC, Flush)                                                                                   \
  X(PFNGLFRAMEBUFFERRENDERBUFFERPROC, FramebufferRenderbuffer)                                               \
  X(PFNGLFRAMEBUFFERTEXTURE2DPROC, FramebufferTexture2D)                                                     \
  X(PFNGLFRONTFACEPROC, FrontFace)                                                                           \
  X(PFNGLGENBUFFERSPROC, GenBuffers)                                                                         \
  X(PFNGLGENFRAMEBUFFERSPROC, GenFramebuffers)                                                               \
  X(PFNGLGENQUERIESPROC, GenQueries)                                                                         \
  X(PFNGLGENRENDERBUFFERSPROC, GenRenderbuffers)                                                             \
  X(PFNGLGENTEXTURESPROC, GenTextures)                                                                       \
  X(PFNGLGENVERTEXARRAYSPROC, GenVertexArrays)                                                               \
  X(PFNGLGENERATEMIPMAPPROC, GenerateMipmap)                                                                 \
  X(PFNGLGETBUFFERSUBDATAPROC, GetBufferSubData)                                                             \
  X(PFNGLGETERRORPROC, GetError)                                                                             \
  X(PFNGLGETINTEGERVPROC, GetIntegerv)                                                                       \
  X(PFNGLGETPROGRAMINFOLOGPROC, GetProgramInfoLog)                                                           \
  X(PFNGLGETPROGRAMIVPROC, GetProgramiv)                                                                     \
  X(PFNGLGETQUERYOBJECTUI64VPROC, GetQueryObjectui64v)                                                       \
  X(PFNGLGETSHADERINFOLOGPROC, GetShaderInfoLog)                                                             \
  X(PFNGLGETSHADERIVPROC, GetShaderiv)                                                                       \
  X(PFNGLGETSTRINGPROC, GetString)                                                                           \
  X(PFNGLGETSTRINGIPROC, GetStringi)                                                                         \
  X(PFNGLGETUNIFORMBLOCKINDEXPROC, GetUniformBlockIndex)                                                     \
  X(PFNGLGETUNIFORMLOCATIONPROC, GetUniformLocation)                                                         \
  X(PFNGLISBUFFERPROC, IsBuffer)                                                                             \
  X(PFNGLLINKPROGRAMPROC, LinkProgram)                                                                       \
  X(PFNGLPIXELSTOREIPROC, PixelStorei)                                                                       \
  X(PFNGLPOLYGONOFFSETPROC, PolygonOffset)                                                                   \
  X(PFNGLREADBUFFERPROC, ReadBuffer)                                                                         \
  X(PFNGLREADPIXELSPROC, ReadPixels)                                                                         \
  X(PFNGLRENDERBUFFERSTORAGEMULTISAMPLEPROC, RenderbufferStorageMultisample)                                 \
  X(PFNGLSCISSORPROC, Scissor)                                                                               \
  X(PFNGLSHADERSOURCEPROC, ShaderSource)                                                                     \
  X(PFNGLTEXBUFFERPROC, TexBuffer)                                                                           \
  X(PFNGLTEXIMAGE2DPROC, TexImage2D)                                                                         \
  X(PFNGLTEXIMAGE2DMULTISAMPLEPROC, TexImage2DMultisample)                                                   \
  X(PFNGLTEXPARAMETERFPROC, TexParameterf)                                                                   \
  X(PFNGLTEXPARAMETERIPROC, TexParameteri)                                                                   \
  X(PFNGLTEXSUBIMAGE2DPROC, TexSubImage2D)                                                                   \
  X(PFNGLUNIFORM1IPROC, Uniform1i)                                                                           \
  X(PFNGLUNIFORM3FPROC, Uniform3f)                                                                           \
  X(PFNGLUNIFORM4FPROC, Uniform4f)                                                                           \
  X(PFNGLUNIFORM4IPROC, Uniform4i)                                                                           \
  X(PFNGLUNIFORMBLOCKBINDINGPROC, UniformBlockBinding)                                                       \
  X(PFNGLUNIFORMMATRIX3FVPROC, UniformMatrix3fv)                                                             \
  X(PFNGLUSEPROGRAMPROC, UseProgram)                                                                         \
  X(PFNGLVERTEXATTRIB4FPROC, VertexAttrib4f)                                                                 \
  X(PFNGLVERTEXATTRIBDIVISORPROC, VertexAttribDivisor)                                                       \
  X(PFNGLVERTEXATTRIBPOINTERPROC, VertexAttribPointer)                                                       \
  X(PFNGLVIEWPORTPROC, Viewport)

/// Functions of newer versions; null if missing. The extension tells whether a context has them.
#define STADION_GL_MORE_FUNCTIONS(X)                                                                         \
  X(PFNGLBUFFERSTORAGEPROC, BufferStorage)                                                                   \
  X(PFNGLCLEARBUFFERSUBDATAPROC, ClearBufferSubData)                                                         \
  X(PFNGLCLIPCONTROLPROC, ClipControl)                                                                       \
  X(PFNGLDRAWELEMENTSINSTANCEDBASEINSTANCEPROC, DrawElementsInstancedBaseInstance)                           \
  X(PFNGLMAPBUFFERRANGEPROC, MapBufferRange)                                                                 \
  X(PFNGLMEMORYBARRIERPROC, MemoryBarrier)                                                                   \
  X(PFNGLMULTIDRAWELEMENTSINDIRECTPROC, MultiDrawElementsIndirect)

struct GlTable {
#define STADION_GL_MEMBER(type, name) type name = nullptr;
  STADION_GL_FUNCTIONS(STADION_GL_MEMBER)
  STADION_GL_MORE_FUNCTIONS(STADION_GL_MEMBER)
#undef STADION_GL_MEMBER
};

using GlSymbol = void (*)();
using GlResolver = GlSymbol (*)(const char* name);

/// Asks `resolve` for every function of the table; fails with the name of the first missing one.
Result<GlTable> loadGlTable(GlResolver resolve);

/// Returns true if the current context has the extension.
bool hasGlExtension(const GlTable& gl, const char* name);

/// From clip coordinates to depths: z / w itself, or (z / w + 1) / 2 in contexts that support nothing else.
enum class ClipDepth { ZeroToOne, MinusOneToOne };

/// Makes the current context take z / w as the depth, if it can, and returns its mode. Depths of single
/// precision are then exact near 0; otherwise they are correct, but coarser far away.
ClipDepth setClipDepth(const GlTable& gl);

/// Returns true if the current context draws on the processor.
bool isSoftware(const GlTable& gl);

/// Returns the name of an error that glGetError returned.
const char* glErrorName(GLenum error);

}  // namespace stadion
