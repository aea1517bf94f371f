#include "plume/mesh/cell_faces.h"

namespace plume {
namespace {

constexpr FaceLoop kTetrahedron[] = {
    {3, {1, 2, 3}}, {3, {0, 3, 2}}, {3, {0, 1, 3}}, {3, {0, 2, 1}}};
constexpr FaceLoop kVoxel[] = {{4, {0, 4, 6, 2}}, {4, {1, 3, 7, 5}}, {4, {0, 1, 5, 4}},
                               {4, {2, 6, 7, 3}}, {4, {0, 2, 3, 1}}, {4, {4, 5, 7, 6}}};
constexpr FaceLoop kHexahedron[] = {{4, {0, 4, 7, 3}}, {4, {1, 2, 6, 5}}, {4, {0, 1, 5, 4}},
                                    {4, {3, 7, 6, 2}}, {4, {0, 3, 2, 1}}, {4, {4, 5, 6, 7}}};
// VTK's wedge has its first triangle facing outwards: points 0, 1, 2 as seen from outside.
constexpr FaceLoop kWedge[] = {
    {3, {0, 1, 2}}, {3, {3, 5, 4}}, {4, {0, 3, 4, 1}}, {4, {1, 4, 5, 2}}, {4, {2, 5, 3, 0}}};
constexpr FaceLoop kPyramid[] = {
    {4, {0, 3, 2, 1}}, {3, {0, 1, 4}}, {3, {1, 2, 4}}, {3, {2, 3, 4}}, {3, {3, 0, 4}}};
constexpr FaceLoop kPentagonalPrism[] = {
    {5, {0, 4, 3, 2, 1}}, {5, {5, 6, 7, 8, 9}}, {4, {0, 1, 6, 5}}, {4, {1, 2, 7, 6}},
    {4, {2, 3, 8, 7}},    {4, {3, 4, 9, 8}},    {4, {4, 0, 5, 9}}};
constexpr FaceLoop kHexagonalPrism[] = {
    {6, {0, 5, 4, 3, 2, 1}}, {6, {6, 7, 8, 9, 10, 11}}, {4, {0, 1, 7, 6}},   {4, {1, 2, 8, 7}},
    {4, {2, 3, 9, 8}},       {4, {3, 4, 10, 9}},        {4, {4, 5, 11, 10}}, {4, {5, 0, 6, 11}}};

}  // namespace

std::span<const FaceLoop> faces_of(CellType type) {
  switch (type) {
    case CellType::tetrahedron:
      return kTetrahedron;
    case CellType::voxel:
      return kVoxel;
    case CellType::hexahedron:
      return kHexahedron;
    case CellType::wedge:
      return kWedge;
    case CellType::pyramid:
      return kPyramid;
    case CellType::pentagonal_prism:
      return kPentagonalPrism;
    case CellType::hexagonal_prism:
      return kHexagonalPrism;
    case CellType::polyhedron:
      break;
  }
  return {};
}

}  // namespace plume
