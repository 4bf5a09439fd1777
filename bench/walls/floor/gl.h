#pragma once
/// OpenGL, linked in as only this program does. (Stadion itself looks functions up at run time.)

#include <GL/gl.h>
#include <GL/glext.h>
