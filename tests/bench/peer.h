/// What other renderers are given, and what is asked of them.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "plume/lib/camera.h"
#include "plume/lib/image.h"
#include "plume/mesh/local_frame.h"
#include "plume/mesh/mesh.h"
#include "plume/preint/transfer_function.h"

namespace plume::bench {

/// One picture of one mesh, in terms that all renderers share.
struct PeerScene {
  /// Explicit cells with one field on points, named kField: one float a point.
  Mesh mesh;
  /// The same as tetrahedra: int32 connectivity, points in double. Of a mesh that is none of
  /// tetrahedra, cut by vtkDataSetTriangleFilter: another field between the points.
  Mesh tetrahedra;
  bool cut = false;  ///< whether that was so
  Bounds bounds;
  /// The cube root of the tetrahedra's volume over the number of the mesh's cells, in world units.
  double cell_size = 0;
  TransferFunction transfer_function;
  Camera camera;
  int size = 512;   ///< pixels along each side
  int threads = 1;  ///< for those that can use more than one

  static constexpr const char* kField = "scalar";

  /// What is said behind a method that stands on the tetrahedra.
  std::string on_tetrahedra() const { return cut ? " (cut into tetrahedra)" : ""; }
};

/// One way in which one of them makes that picture.
struct PeerWay {
  std::string family;  ///< who: "VTK ray cast"
  /// And how; without commas. Says what it stands on where the mesh was cut.
  std::string method;
  /// Makes one frame; what depends on mesh and transfer function alone is made before, or kept.
  std::function<void()> frame;
  /// The last frame, linear and premultiplied, before anybody rounds it to 8 bits where that can be
  /// had.
  std::function<Image()> picture;
};

/// Makes the scene. Requires a mesh and a field that check_structure() and select_field() let pass.
/// Throws Error, naming the field, where it is not on points, and where cells are hidden.
PeerScene make_peer_scene(const Mesh& mesh, const std::string& field);

/// A picture of nothing.
inline Image empty_picture(int size) {
  Image image;
  image.width = image.height = size;
  image.rgba.assign(4 * static_cast<std::size_t>(size) * static_cast<std::size_t>(size), 0);
  return image;
}

/// VTK's mappers, on tetrahedra. Each keeps a reference to the scene.
std::vector<PeerWay> vtk_ray_cast_ways(const PeerScene& scene);
std::vector<PeerWay> vtk_z_sweep_ways(const PeerScene& scene, bool quick);
/// None where Plume was built without VTK's OpenGL; none, and why on stderr, where no OpenGL
/// context is to be had.
std::vector<PeerWay> vtk_projected_tetrahedra_ways(const PeerScene& scene);
/// Samples at fixed steps, coarse to fine: the cell at each is found by VTK's locator, by Embree's
/// point query, or the scalar comes from voxels.
std::vector<PeerWay> vtk_locator_ways(const PeerScene& scene, bool quick);
std::vector<PeerWay> embree_ways(const PeerScene& scene, bool quick);
std::vector<PeerWay> voxel_ways(const PeerScene& scene, bool quick);
/// Where built with Open VKL.
std::vector<PeerWay> openvkl_ways(const PeerScene& scene, bool quick);
/// Where built with Viskores.
std::vector<PeerWay> viskores_ways(const PeerScene& scene, bool quick);

/// Whether windows can be opened, as VTK's OpenGL needs it, which ends the program where they
/// cannot.
bool has_x_display();
/// Sets, before a window is opened, how many threads Mesa's software rasterizer may use.
void limit_rasterizer_threads(int threads);

}  // namespace plume::bench
