/// Errors that are asked for, and what comes of it.
#pragma once

namespace plume::bench {

/// Renders the thesis' two grids (the blunt fin as tetrahedra as well) in all modes with tolerances
/// of 1e-2, 1e-3 and 1e-4, `size` pixels along each side, on all threads, and compares them with
/// the reference, pixel by pixel; prints the plan, the greatest error, and the medians of the times
/// of `rounds` frames. False where an error is above what was asked.
bool check_tolerances(int size, int rounds);

}  // namespace plume::bench
