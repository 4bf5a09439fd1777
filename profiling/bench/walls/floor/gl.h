#pragma once
/// OpenGL, linked in as this program alone does. (Stadion itself looks up what it calls.)

#include <GL/gl.h>
#include <GL/glext.h>
