/// The isoparametric interpolation inside of a cell, by VTK's shape functions.
#pragma once

#include <array>
#include <optional>
#include <span>

namespace plume::reference {

/// The scalar at a place inside of a cell of a VTK type (hexahedron 12, wedge 13, pyramid 14) with
/// these points, in VTK's order, and values. vtkCell::EvaluatePosition() finds the parameters to
/// 1e-3; Newton's method with VTK's own shape functions and derivatives makes them good to 1e-12.
/// Nothing where that does not get there.
std::optional<double> isoparametric_scalar(int vtk_type,
                                           std::span<const std::array<double, 3>> points,
                                           std::span<const double> scalars,
                                           const std::array<double, 3>& place);

}  // namespace plume::reference
