#include "plume/vtk/kept_scene.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataSet.h>
#include <vtkIdTypeArray.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>
#include <vtkPoints.h>
#include <vtkRectilinearGrid.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkVolumeProperty.h>

#include <algorithm>
#include <utility>

#include "plume/io/vtk_data_sets.h"
#include "plume/io/vtk_to_mesh.h"
#include "plume/mesh/error.h"
#include "plume/mesh/same_mesh.h"
#include "plume/vtk/transfer_function_of.h"

namespace plume {
namespace {

// When points or cells that a Mesh borrows were last said to have changed.
vtkMTimeType time_of_cells(vtkDataSet& data) {
  vtkMTimeType latest = 0;
  const auto look_at = [&latest](vtkObject* object) {
    if (object != nullptr) latest = std::max(latest, object->GetMTime());
  };
  if (auto* const set = vtkPointSet::SafeDownCast(&data); set != nullptr && set->GetPoints()) {
    look_at(set->GetPoints());
    look_at(set->GetPoints()->GetData());
  }
  if (auto* const grid = vtkUnstructuredGrid::SafeDownCast(&data)) {
    look_at(grid->GetCellTypesArray());
    look_at(grid->GetFaces());
    look_at(grid->GetFaceLocations());
    if (vtkCellArray* const cells = grid->GetCells()) {
      look_at(cells);
      look_at(cells->GetOffsetsArray());
      look_at(cells->GetConnectivityArray());
    }
  }
  if (auto* const grid = vtkRectilinearGrid::SafeDownCast(&data)) {
    look_at(grid->GetXCoordinates());
    look_at(grid->GetYCoordinates());
    look_at(grid->GetZCoordinates());
  }
  return latest;
}

// Points and cells of a data set with one of its arrays: others would be converted for nothing.
vtkSmartPointer<vtkDataSet> with_one_array(vtkDataSet& data, const ChosenArray& chosen) {
  auto view = vtkSmartPointer<vtkDataSet>::Take(data.NewInstance());
  view->CopyStructure(&data);
  if (auto* const ghosts = data.GetPointGhostArray()) view->GetPointData()->AddArray(ghosts);
  if (auto* const ghosts = data.GetCellGhostArray()) view->GetCellData()->AddArray(ghosts);
  if (chosen.on_cells)
    view->GetCellData()->SetScalars(chosen.values);
  else
    view->GetPointData()->SetScalars(chosen.values);
  return view;
}

std::string names_of_arrays(vtkDataSet& data) {
  std::string names;
  const auto add = [&names](vtkDataSetAttributes& arrays, const char* where) {
    for (int i = 0; i < arrays.GetNumberOfArrays(); ++i)
      if (const char* const name = arrays.GetArrayName(i))
        names += (names.empty() ? "" : ", ") + std::string(name) + where;
  };
  add(*data.GetPointData(), " (point)");
  add(*data.GetCellData(), " (cell)");
  return names.empty() ? "it has none" : "there are " + names;
}

bool shares_memory(const Mesh& a, const Mesh& b) {
  const auto shares = [](const Array& one, const Array& other) {
    return !one.empty() && one.data() == other.data();
  };
  return shares(a.points, b.points) || shares(a.axes[0], b.axes[0]) ||
         shares(a.axes[1], b.axes[1]) || shares(a.axes[2], b.axes[2]) ||
         shares(a.cells.types, b.cells.types) || shares(a.cells.offsets, b.cells.offsets) ||
         shares(a.cells.connectivity, b.cells.connectivity) ||
         shares(a.cells.polyhedron_faces, b.cells.polyhedron_faces) ||
         shares(a.cells.polyhedron_locations, b.cells.polyhedron_locations);
}

}  // namespace

// Arrays that stayed where they are may have been written to since the scene was made of them.
bool KeptScene::has_same_cells(const Mesh& mesh, vtkMTimeType time) const {
  if (time != cells_time_ && shares_memory(mesh, cells_)) return false;
  return same_points_and_cells(mesh, cells_);
}

Scene& KeptScene::update(vtkDataObject& data, const Choose& choose,
                         const std::optional<int>& component, const Notice& notice) {
  std::vector<Seen> arrays;
  std::vector<vtkSmartPointer<vtkDataSet>> views;
  vtkMTimeType time = 0;
  bool on_cells = false;
  int components = 1;
  std::string name;
  for (const auto& part : data_sets_in(data)) {
    if (part->GetNumberOfCells() == 0) continue;
    const ChosenArray chosen = choose(*part);
    if (chosen.values == nullptr)
      throw Error(who_ + ": no such array of numbers to show; " + names_of_arrays(*part));
    arrays.push_back({chosen.values, chosen.values->GetMTime()});
    views.push_back(with_one_array(*part, chosen));
    time = std::max(time, time_of_cells(*part));
    on_cells = chosen.on_cells;
    components = chosen.values->GetNumberOfComponents();
    name = chosen.values->GetName() != nullptr ? chosen.values->GetName() : "unnamed";
  }
  const Seen seen{&data, data.GetMTime()};
  if (scene_ && seen == data_ && arrays == arrays_ && component == component_) return *scene_;

  if (views.empty())
    throw Error(who_ +
                ": no cells, and Plume needs tetrahedra, hexahedra, wedges, pyramids, prisms "
                "or polyhedra (vtkDelaunay3D makes tetrahedra of points)");
  if (components > 1 && !component)
    throw Error(who_ + ": the array '" + name + "' has " + std::to_string(components) +
                " components; say which is shown (SetComponent), or their magnitude "
                "(SetComponentToMagnitude)");
  Mesh mesh;
  Notice noted = notice;
  if (views.size() == 1) {
    mesh = mesh_from_vtk(*views[0], who_, {}, noted);
  } else {
    vtkNew<vtkMultiBlockDataSet> blocks;
    for (unsigned i = 0; i < views.size(); ++i) blocks->SetBlock(i, views[i]);
    mesh = mesh_from_vtk(*blocks, who_, {}, noted);
  }
  SceneOptions options;
  options.keep_field_order = true;
  options.field.association = on_cells ? Association::cell : Association::point;
  if (components > 1 && !mesh.fields.empty())
    options.field.name = mesh.fields.front().name + ":" +
                         (*component < 0 ? "magnitude" : std::to_string(*component));

  if (scene_ && scene_->field().association == options.field.association &&
      has_same_cells(mesh, time)) {
    if (arrays != arrays_ || component != component_) {
      scene_->set_field(mesh, options.field);
      ++fields_put_;
    }
  } else {
    scene_.reset();
    scene_.emplace(mesh, options);
    has_optics_ = false;
    ++meshes_made_;
  }
  data_ = seen;
  arrays_ = std::move(arrays);
  component_ = component;
  cells_ = std::move(mesh);
  cells_.fields.clear();
  cells_time_ = time;
  return *scene_;
}

void KeptScene::show(vtkVolumeProperty* property) {
  const Seen seen{property, property != nullptr ? property->GetMTime() : 0};
  if (has_optics_ && seen == property_) return;
  if (property != nullptr) {
    if (!(seen == property_)) {
      optics_ = transfer_function_of(*property);
      ++optics_made_;
    }
  } else {
    optics_ = in_display_colors(
        to_transfer_function(scene_->default_color_map(), scene_->default_unit_distance()));
    ++optics_made_;
  }
  scene_->set_transfer_function(optics_);
  property_ = seen;
  has_optics_ = true;
}

}  // namespace plume
