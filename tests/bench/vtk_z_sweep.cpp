// VTK's Z sweep.

#include <fmt/format.h>
#include <vtkDataArray.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridLinearRayIntegrator.h>
#include <vtkUnstructuredGridPreIntegration.h>
#include <vtkUnstructuredGridVolumeZSweepMapper.h>

#include <memory>

#include "plume/io/vtk_from_mesh.h"
#include "plume/tests/bench/peer.h"
#include "plume/tests/bench/vtk_view.h"

namespace plume::bench {
namespace {

// The mapper, whose picture can be had before it is rounded to 8 bits.
class OpenZSweep : public vtkUnstructuredGridVolumeZSweepMapper {
 public:
  static OpenZSweep* New() { return made<OpenZSweep>(); }
  const float* picture() const { return RealRGBAImage; }
  std::size_t row() const { return static_cast<std::size_t>(ImageMemorySize[0]); }
};

// VTK rounds projected vertices down to whole pixels, so a pixel is, on average, the ray through
// its centre. A picture `finer` times as large, of which every `finer`-th pixel is taken, halves
// that error and so on: `finer` is odd, so that the pixel taken is in the middle.
struct ZSweep {
  ZSweep(const PeerScene& scene, bool linear, int times) : finer(times), size(scene.size) {
    keep_pictures_off_the_screen();
    data = unstructured_from(scene.tetrahedra);
    mapper = vtkSmartPointer<OpenZSweep>::New();
    mapper->SetInputData(vtkUnstructuredGrid::SafeDownCast(data));
    mapper->SetScalarModeToUsePointFieldData();
    mapper->SelectScalarArray(PeerScene::kField);
    mapper->SetAutoAdjustSampleDistances(0);
    mapper->SetImageSampleDistance(1);
    mapper->SetIntermixIntersectingGeometry(0);
    if (linear)
      mapper->SetRayIntegrator(vtkSmartPointer<vtkUnstructuredGridLinearRayIntegrator>::New());
    else
      mapper->SetRayIntegrator(vtkSmartPointer<vtkUnstructuredGridPreIntegration>::New());
    volume->SetMapper(mapper);
    set_optics(*volume->GetProperty(), scene.transfer_function);
    window->AddRenderer(renderer);
    window->SetSize(finer * size, finer * size);
    aim(*renderer->GetActiveCamera(), scene.camera, data->GetBounds());
  }

  void render() { mapper->Render(renderer, volume); }

  Image picture() const {
    Image image = empty_picture(size);
    const auto side = static_cast<std::size_t>(size), times = static_cast<std::size_t>(finer);
    for (std::size_t y = 0; y < side; ++y)
      for (std::size_t x = 0; x < side; ++x)
        std::copy_n(mapper->picture() +
                        4 * ((times * y + times / 2) * mapper->row() + times * x + times / 2),
                    4, &image.rgba[4 * ((side - 1 - y) * side + x)]);
    return image;
  }

  int finer, size;
  vtkSmartPointer<vtkDataSet> data;
  vtkSmartPointer<OpenZSweep> mapper;
  vtkNew<BlindRenderer> renderer;
  vtkNew<BlindWindow> window;
  vtkNew<vtkVolume> volume;
};

}  // namespace

std::vector<PeerWay> vtk_z_sweep_ways(const PeerScene& scene, bool quick) {
  std::vector<PeerWay> ways;
  for (const bool linear : {true, false})
    for (const int finer : {1, 3, 5}) {
      if (finer > 1 && finer * scene.size > 1024) continue;  // takes minutes, and gigabytes
      if (finer > 1 && (!linear || (quick && finer > 3))) continue;
      const auto sweep = std::make_shared<ZSweep>(scene, linear, finer);
      ways.push_back({"VTK Z sweep",
                      fmt::format("{}{}{}", linear ? "linear" : "pre-integration",
                                  finer > 1 ? fmt::format(": {0} x {0} pixels for one", finer) : "",
                                  scene.on_tetrahedra()),
                      [sweep] { sweep->render(); }, [sweep] { return sweep->picture(); }});
    }
  return ways;
}

}  // namespace plume::bench
