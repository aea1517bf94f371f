/// The scene of what a VTK pipeline gives, kept for as long as that stays.
#pragma once

#include <vtkType.h>

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "plume/io/read_mesh.h"
#include "plume/lib/scene.h"

class vtkDataArray;
class vtkDataObject;
class vtkDataSet;
class vtkVolumeProperty;

namespace plume {

/// Which array of a data set is shown.
struct ChosenArray {
  vtkDataArray* values = nullptr;  ///< null where the data set has none that was asked for
  bool on_cells = false;           ///< whether its values are those of cells
};

/// Makes a scene of a data object, and next time no more than what has changed: VTK's modification
/// times say what that may be.
class KeptScene {
 public:
  /// `who` is named in messages.
  explicit KeptScene(std::string who) : who_(std::move(who)) {}

  using Choose = std::function<ChosenArray(vtkDataSet&)>;

  /// The scene of `data` (a data set, or a composite one, of which all are taken), with the arrays
  /// that `choose` names. An array of several components needs `component`: from 0, or -1 for the
  /// magnitude. Arrays are borrowed where their types allow it. Where points and cells are those
  /// of last time, no more is done than to put in the field's values.
  /// Throws Error where there are no volume cells or no such array.
  Scene& update(vtkDataObject& data, const Choose& choose, const std::optional<int>& component,
                const Notice& notice);

  /// Gives the scene the property's optics, or where that is null those fitted to its field.
  /// Requires a scene.
  void show(vtkVolumeProperty* property);

  /// How often a mesh was made walkable, a field's values were put in, optics were made.
  int meshes_made() const { return meshes_made_; }
  int fields_put() const { return fields_put_; }
  int optics_made() const { return optics_made_; }

 private:
  // What a picture was made of: the same again means that nothing has changed.
  struct Seen {
    const void* object = nullptr;
    vtkMTimeType time = 0;
    bool operator==(const Seen&) const = default;
  };

  bool has_same_cells(const Mesh& mesh, vtkMTimeType time) const;

  std::string who_;
  std::optional<Scene> scene_;
  Seen data_;
  std::vector<Seen> arrays_;
  std::optional<int> component_;
  Mesh cells_;                   // of the scene, without fields
  vtkMTimeType cells_time_ = 0;  // of them, when the scene was made
  Seen property_;
  bool has_optics_ = false;
  TransferFunction optics_;
  int meshes_made_ = 0, fields_put_ = 0, optics_made_ = 0;
};

}  // namespace plume
