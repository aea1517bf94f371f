/// All of the library's face in one include.
#pragma once

#include "plume/lib/camera.h"
#include "plume/lib/clip.h"
#include "plume/lib/color_map.h"
#include "plume/lib/image.h"
#include "plume/lib/render.h"
#include "plume/lib/scene.h"
#include "plume/lib/shading.h"
#include "plume/lib/version.h"
#include "plume/mesh/error.h"
#include "plume/mesh/mesh.h"
