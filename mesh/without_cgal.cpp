// Takes the place of cgal_engine.cpp in a build without CGAL.
#include "plume/mesh/error.h"
#include "plume/mesh/tetrahedralization_engines.h"

namespace plume {

bool has_cgal() { return false; }

Array cgal_delaunay(std::span<const double>) {
  throw Error(
      "this build has no CGAL: configure with -DPLUME_WITH_CGAL=ON (Debian: libcgal-dev; its "
      "triangulations' licence is the GPL)");
}

}  // namespace plume
