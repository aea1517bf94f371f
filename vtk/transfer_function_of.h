/// A volume property of VTK's as a transfer function.
#pragma once

#include "plume/lib/scene.h"

class vtkVolumeProperty;

namespace plume {

/// The optics that VTK's ray casters of unstructured grids give to a property of one component
/// (vtkUnstructuredGridLinearRayIntegrator, after Moreland and Angel, "A Fast High Accuracy Volume
/// Renderer for Unstructured Data", 2004): the scalar opacity divided by its unit distance is the
/// extinction, and colours are taken as the numbers that they are, neither decoded nor encoded, so
/// that the picture blends with what VTK draws.
///
/// Functions that are linear between their points (RGB or gray, sharpness 0, midpoint 0.5) become
/// knots at these points, exactly. For other spaces, sharpness, midpoints and logarithmic scales
/// knots are added until colours are within 1e-3, and opacities within 1e-3 of the greatest, of
/// what VTK says; the space Lab CIEDE2000, which VTK itself has in steps of 1/255, is taken from a
/// table of 1024 colours. Beyond the first and the last point VTK's clamping
/// is followed. Gradient opacity and shading are passed over, as VTK's ray casters do.
///
/// Throws Error where a function has no points, where the unit distance is not above 0, and where
/// an opacity or a colour is negative or not finite.
TransferFunction transfer_function_of(vtkVolumeProperty& property);

/// The same transfer function with its knots' colours as display values (sRGB): what a picture of
/// fitted colours needs to look beside those of VTK's properties.
TransferFunction in_display_colors(TransferFunction function);

}  // namespace plume
