// VTK's projected tetrahedra, off the screen, by OpenGL.
//
// The method approximates: optics are taken at the corners of cells, in 8 bits, and are linear in
// between; lengths come from a table of square roots, and are linear over a cell's projection.

#include <fmt/format.h>
#include <vtkDataArray.h>
#include <vtkOpenGLCamera.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkOpenGLProjectedTetrahedraMapper.h>
#include <vtkOpenGLRenderer.h>
#include <vtkOpenGLState.h>
#include <vtkPixelBufferObject.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXOpenGLRenderWindow.h>

#include <cstdio>
#include <memory>

#include "plume/io/vtk_from_mesh.h"
#include "plume/tests/bench/peer.h"
#include "plume/tests/bench/vtk_view.h"

namespace plume::bench {
namespace {

// The mapper, whose frame buffer of floats can be read before it is drawn into a window's.
class OpenProjectedTetrahedra : public vtkOpenGLProjectedTetrahedraMapper {
 public:
  static OpenProjectedTetrahedra* New() { return made<OpenProjectedTetrahedra>(); }
  vtkOpenGLFramebufferObject* frame_buffer() { return Framebuffer; }
};

struct ProjectedTetrahedra {
  ProjectedTetrahedra(const PeerScene& scene, bool floats) : size(scene.size), in_floats(floats) {
    data = unstructured_from(scene.tetrahedra);
    mapper = vtkSmartPointer<OpenProjectedTetrahedra>::New();
    mapper->SetInputData(vtkUnstructuredGrid::SafeDownCast(data));
    mapper->SetScalarModeToUsePointFieldData();
    mapper->SelectScalarArray(PeerScene::kField);
    mapper->SetUseFloatingPointFrameBuffer(floats);
    volume->SetMapper(mapper);
    // It keeps attenuation in 8 bits from 0 to 1: the unit distance is that at which the greatest
    // is 1.
    double greatest = 0;
    for (const TransferFunction::Knot& knot : scene.transfer_function.knots)
      greatest = std::max<double>(greatest, knot.optics.extinction);
    set_optics(*volume->GetProperty(), scene.transfer_function, greatest > 0 ? 1 / greatest : 1);
    renderer->SetActiveCamera(camera);
    renderer->SetAutomaticLightCreation(0);
    renderer->SetBackground(0, 0, 0);
    renderer->SetBackgroundAlpha(0);
    renderer->AddVolume(volume);
    window->SetOffScreenRendering(1);
    window->SetMultiSamples(0);
    window->SetAlphaBitPlanes(1);
    window->SetSize(size, size);
    window->AddRenderer(renderer);
    aim(*camera, scene.camera, data->GetBounds());
  }

  void render() {
    window->Render();
    window->WaitForCompletion();
  }

  Image picture() {
    Image image = empty_picture(size);
    const auto side = static_cast<std::size_t>(size);
    std::vector<float> read(4 * side * side);
    if (in_floats) {
      vtkOpenGLState& state = *window->GetState();
      state.PushFramebufferBindings();
      mapper->frame_buffer()->Bind(vtkOpenGLFramebufferObject::GetReadMode());
      mapper->frame_buffer()->ActivateReadBuffer(0);
      int extent[4] = {0, size - 1, 0, size - 1};
      const auto pixels = vtkSmartPointer<vtkPixelBufferObject>::Take(
          mapper->frame_buffer()->DownloadColor4(extent, VTK_FLOAT));
      unsigned int sides[2] = {static_cast<unsigned>(size), static_cast<unsigned>(size)};
      vtkIdType increments[2] = {0, 0};
      pixels->Download2D(VTK_FLOAT, read.data(), sides, 4, increments);
      state.PopFramebufferBindings();
    } else {
      float* const shown = window->GetRGBAPixelData(0, 0, size - 1, size - 1, 0);
      std::copy_n(shown, read.size(), read.begin());
      window->ReleaseRGBAPixelData(shown);
    }
    for (std::size_t y = 0; y < side; ++y)
      std::copy_n(&read[4 * side * y], 4 * side, &image.rgba[4 * side * (side - 1 - y)]);
    return image;
  }

  int size;
  bool in_floats;
  vtkSmartPointer<vtkDataSet> data;
  vtkSmartPointer<OpenProjectedTetrahedra> mapper;
  vtkNew<vtkOpenGLRenderer> renderer;
  vtkNew<vtkOpenGLCamera> camera;
  vtkNew<vtkXOpenGLRenderWindow> window;
  vtkNew<vtkVolume> volume;
};

}  // namespace

std::vector<PeerWay> vtk_projected_tetrahedra_ways(const PeerScene& scene) {
  if (!has_x_display()) {
    std::fprintf(
        stderr,
        "plume_peers: VTK PROJECTED TETRAHEDRA ARE SKIPPED: they need OpenGL, and there is "
        "no X display; run under xvfb-run -a (Debian: xvfb, xauth)\n");
    return {};
  }
  std::vector<PeerWay> ways;
  for (const bool floats : {true, false}) {
    const auto projected = std::make_shared<ProjectedTetrahedra>(scene, floats);
    if (projected->window->SupportsOpenGL() == 0) {
      std::fprintf(stderr,
                   "plume_peers: VTK PROJECTED TETRAHEDRA ARE SKIPPED: the display's OpenGL will "
                   "not do (VTK takes 3.2)\n");
      return {};
    }
    // In its first frame VTK leaves out the first thousand cells, before which it has not told the
    // shader what it is given (9.1).
    projected->render();
    ways.push_back(
        {"VTK projected tetrahedra",
         fmt::format("{} a channel{}", floats ? "floats" : "8 bits", scene.on_tetrahedra()),
         [projected] { projected->render(); }, [projected] { return projected->picture(); }});
  }
  return ways;
}

}  // namespace plume::bench
