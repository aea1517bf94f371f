/// Fields that stand in for data sets that are not at hand: what they show is of the same kind, no
/// more.
#pragma once

#include <array>
#include <string>

#include "plume/mesh/mesh.h"

namespace plume::bench {

/// A scalar in [0, 1], more or less, over the unit cube.
using StandInField = double (*)(const std::array<double, 3>& p);

double orbital_field(const std::array<double, 3>& p);     ///< the density of hydrogen's 3d orbital
double bucky_ball_field(const std::array<double, 3>& p);  ///< 60 atoms at a truncated icosahedron
double neghip_field(const std::array<double, 3>& p);      ///< the potential of charges, both signs
double fuel_field(const std::array<double, 3>& p);        ///< a jet that breaks up
double aneurism_field(const std::array<double, 3>& p);    ///< thin vessels in nothing
double engine_field(const std::array<double, 3>& p);      ///< a block of metal with bores
double bonsai_field(const std::array<double, 3>& p);      ///< a pot, a trunk and rough leaves
double head_field(const std::array<double, 3>& p);        ///< skin, a skull, a brain
double foot_field(const std::array<double, 3>& p);        ///< bones in flesh

/// A regular grid of so many points along each axis with the field at its points, named "density";
/// voxels are cubes, the longest edge has a length of 1. In parallel.
Mesh stand_in_grid(StandInField field, const std::array<int, 3>& points);

/// A box of 6 size^3 jittered tetrahedra (`generate box-tetrahedra`) with the field at its points.
Mesh stand_in_tetrahedra(StandInField field, int size);

}  // namespace plume::bench
