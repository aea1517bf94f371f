// Point sampling through VTK's cell locator.

#include <vtkDataArray.h>
#include <vtkGenericCell.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkStaticCellLocator.h>
#include <vtkUnstructuredGrid.h>

#include <array>
#include <limits>
#include <memory>
#include <vector>

#include "plume/io/vtk_from_mesh.h"
#include "plume/tests/bench/fixed_step.h"
#include "plume/tests/bench/peer.h"

namespace plume::bench {
namespace {

struct Located {
  vtkSmartPointer<vtkDataSet> data;
  std::vector<float> scalars;
  vtkNew<vtkStaticCellLocator> locator;
};

// For one thread. The cell of the last sample is looked at first, as for Embree's.
class Sampler {
 public:
  explicit Sampler(const Located& located) : located_(&located) {}

  float operator()(std::array<double, 3> place) {
    int sub = 0;
    double parameters[3], distance = 0;
    const bool still = last_ >= 0 && cell_->EvaluatePosition(place.data(), nullptr, sub, parameters,
                                                             distance, weights_.data()) == 1;
    if (!still)
      last_ = located_->locator->FindCell(place.data(), 0, cell_, parameters, weights_.data());
    if (last_ < 0) return std::numeric_limits<float>::quiet_NaN();
    double sum = 0;
    for (vtkIdType i = 0; i < cell_->GetNumberOfPoints(); ++i)
      sum += weights_[static_cast<std::size_t>(i)] *
             located_->scalars[static_cast<std::size_t>(cell_->GetPointId(i))];
    return static_cast<float>(sum);
  }

 private:
  const Located* located_;
  vtkSmartPointer<vtkGenericCell> cell_ = vtkSmartPointer<vtkGenericCell>::New();
  std::array<double, VTK_CELL_SIZE> weights_{};
  vtkIdType last_ = -1;
};

}  // namespace

std::vector<PeerWay> vtk_locator_ways(const PeerScene& scene, bool quick) {
  const auto located = std::make_shared<Located>();
  located->data = unstructured_from(scene.mesh);
  scene.mesh.fields.front().values.visit([&](auto values) {
    for (const auto value : values) located->scalars.push_back(static_cast<float>(value));
  });
  located->locator->SetDataSet(located->data);
  located->locator->CacheCellBoundsOn();
  located->locator->BuildLocator();
  return marching_ways(scene, "VTK locator sampling", "vtkStaticCellLocator: ", quick,
                       [located] { return Sampler(*located); });
}

}  // namespace plume::bench
