#include "plume/tests/reference/isoparametric.h"

#include <vtkCell.h>
#include <vtkGenericCell.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPoints.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace plume::reference {
namespace {

using Vector = std::array<double, 3>;

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

}  // namespace

std::optional<double> isoparametric_scalar(int vtk_type, std::span<const Vector> points,
                                           std::span<const double> scalars, const Vector& place) {
  vtkNew<vtkGenericCell> cell;
  cell->SetCellType(vtk_type);
  const std::size_t n = points.size();
  cell->GetPoints()->SetDataTypeToDouble();
  for (std::size_t i = 0; i < n; ++i) {
    const auto id = static_cast<vtkIdType>(i);
    cell->GetPointIds()->SetId(id, id);
    cell->GetPoints()->SetPoint(id, points[i].data());
  }
  std::vector<double> weights(n), derivatives(3 * n);
  Vector closest, parameters{0.5, 0.5, 0.5};
  double distance2 = 0;
  int part = 0;
  if (cell->EvaluatePosition(place.data(), closest.data(), part, parameters.data(), distance2,
                             weights.data()) < 0)
    parameters = {0.4, 0.4, 0.4};
  for (int step = 0; step < 30; ++step) {
    cell->InterpolateFunctions(parameters.data(), weights.data());
    cell->InterpolateDerivs(parameters.data(), derivatives.data());
    Vector left = place;
    std::array<Vector, 3> by{};
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t a = 0; a < 3; ++a) {
        left[a] -= weights[i] * points[i][a];
        for (std::size_t p = 0; p < 3; ++p) by[p][a] += derivatives[p * n + i] * points[i][a];
      }
    const double volume = dot(by[0], cross(by[1], by[2]));
    const Vector way{dot(left, cross(by[1], by[2])) / volume,
                     dot(left, cross(by[2], by[0])) / volume,
                     dot(left, cross(by[0], by[1])) / volume};
    double largest = 0;
    for (std::size_t p = 0; p < 3; ++p) {
      parameters[p] += way[p];
      largest = std::max(largest, std::abs(way[p]));
    }
    if (!(largest < 1e3)) return std::nullopt;
    if (largest > 1e-12) continue;
    cell->InterpolateFunctions(parameters.data(), weights.data());
    double scalar = 0;
    for (std::size_t i = 0; i < n; ++i) scalar += weights[i] * scalars[i];
    return scalar;
  }
  return std::nullopt;
}

}  // namespace plume::reference
