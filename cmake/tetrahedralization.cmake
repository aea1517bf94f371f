# Engines that make tetrahedra of point clouds and surfaces. Off unless asked for: their licences bind
# whoever passes the build on.
option(PLUME_WITH_TETGEN "Tetrahedra of points and surfaces by TetGen (AGPL)" OFF)
option(PLUME_WITH_CGAL "Tetrahedra of points by CGAL (GPL)" OFF)

# For those who link to what is installed.
set(PLUME_ENGINE_LINK "")
if(PLUME_WITH_TETGEN)
  string(APPEND PLUME_ENGINE_LINK " -ltet")
  find_path(TETGEN_INCLUDE_DIR tetgen.h)
  find_library(TETGEN_LIBRARY NAMES tet)
  if(NOT TETGEN_INCLUDE_DIR OR NOT TETGEN_LIBRARY)
    message(FATAL_ERROR "PLUME_WITH_TETGEN is on, and TetGen is not installed (Debian: libtet1.5-dev)")
  endif()
  message(NOTICE "plume: with TetGen (PLUME_WITH_TETGEN): this build falls under the GNU AGPL, version 3 "
                 "or later. Whoever passes it on must offer its source, and whoever changes it and lets "
                 "others use it over a network as well (README.md).")
endif()
if(PLUME_WITH_CGAL)
  string(APPEND PLUME_ENGINE_LINK " -lgmp -lmpfr")
  find_package(CGAL 5.5 QUIET)
  if(NOT CGAL_FOUND)
    message(FATAL_ERROR "PLUME_WITH_CGAL is on, and CGAL 5.5 is not installed (Debian: libcgal-dev)")
  endif()
  message(NOTICE "plume: with CGAL's 3D triangulations (PLUME_WITH_CGAL): this build falls under the GNU "
                 "GPL, version 3 or later. Whoever passes it on must offer its source (README.md).")
endif()
if(NOT PLUME_WITH_TETGEN AND NOT PLUME_WITH_CGAL)
  message(STATUS "Point clouds: off. PLUME_WITH_TETGEN (AGPL) or PLUME_WITH_CGAL (GPL) turns them on.")
endif()
