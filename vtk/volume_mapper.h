/// Plume in a VTK program: a volume mapper.
#pragma once

#include <vtkUnstructuredGridVolumeMapper.h>

#include <memory>

/// Draws a volume of unstructured (or curvilinear, rectilinear, regular) cells with Plume, in the
/// place of vtkUnstructuredGridVolumeRayCastMapper:
///
///     vtkNew<vtkPlumeVolumeMapper> mapper;
///
/// The rest of the program stays: input, array and component, volume property, camera, actors.
///
/// - **Input**: any vtkDataSet with volume cells; arrays are borrowed. The scene that is made of it
///   is kept. Where the field's values change, they alone are put in anew; where the volume
///   property changes, its transfer function alone is made; where the camera moves, nothing is. As
///   everywhere in VTK, who writes into an array calls its Modified().
/// - **Property**: colour (RGB or gray), scalar opacity and its unit distance of component 0, as
///   VTK's ray casters of unstructured grids take them: extinction is opacity / unit distance, and
///   colours are blended as the numbers that they are. Gradient opacity and shading are passed
///   over, as there. Cell data is constant in each cell. Unit distances are in data coordinates.
/// - **Camera**: perspective and parallel, with window centre, tiles and viewports; rays go through
///   the middles of pixels. The clipping range is honoured where it cuts the mesh, and so are
///   clipping planes (AddClippingPlane). A volume that is turned, moved or scaled alike along all
///   axes is drawn so.
/// - **Depth**: opaque geometry that the renderer has drawn hides what is behind it, pixel by
/// pixel.
/// - **Errors** (no volume cells, no such array, a stereo camera ...) are reported by
/// vtkErrorMacro,
///   and nothing is drawn. No exception leaves Render().
///
/// The window's abort check is asked while a picture is made; an aborted one is not drawn.
class vtkPlumeVolumeMapper : public vtkUnstructuredGridVolumeMapper {
  vtkTypeMacro(vtkPlumeVolumeMapper, vtkUnstructuredGridVolumeMapper)

 public:
  /// A new one, of which the caller owns the first reference.
  static vtkPlumeVolumeMapper* New();
  /// Prints the settings.
  void PrintSelf(ostream& os, vtkIndent indent) override;

  using vtkUnstructuredGridVolumeMapper::SetInputData;
  /// Any data set.
  void SetInputData(vtkDataSet* data) override;

  /// Which component of an array of several is shown, from 0. By default none is chosen, which is
  /// an error where there are several: other mappers would mix their optics.
  void SetComponent(int component);
  /// Shows the magnitude of an array of several components.
  void SetComponentToMagnitude();

  /// The greatest error of a colour channel, in [0, 1); the cheapest method that keeps to it is
  /// taken (Tolerance in plume/lib/render.h). Below 0, the default: closed-form integration of
  /// scalars that are linear along each cell's segment.
  void SetTolerance(double tolerance);
  /// As it was set.
  double GetTolerance() const;

  /// Threads to use; 0, the default, for all.
  void SetNumberOfThreads(int threads);
  /// As it was set.
  int GetNumberOfThreads() const;

  /// Whether what the renderer has drawn hides what is behind it. On by default.
  void SetIntermixIntersectingGeometry(bool intermix);
  /// As it was set.
  bool GetIntermixIntersectingGeometry() const;
  void IntermixIntersectingGeometryOn() { SetIntermixIntersectingGeometry(true); }    ///< see Set
  void IntermixIntersectingGeometryOff() { SetIntermixIntersectingGeometry(false); }  ///< see Set

  /// How often a mesh was made ready to be traced, new values were put into one, and a transfer
  /// function was made, since the mapper was made: what changes in a pipeline have cost.
  int GetMeshesMade() const;
  int GetFieldsPut() const;              ///< see GetMeshesMade()
  int GetTransferFunctionsMade() const;  ///< see GetMeshesMade()

  /// For the renderer.
  void Render(vtkRenderer* renderer, vtkVolume* volume) override;

  vtkPlumeVolumeMapper(const vtkPlumeVolumeMapper&) = delete;
  vtkPlumeVolumeMapper& operator=(const vtkPlumeVolumeMapper&) = delete;

 protected:
  /// See New().
  vtkPlumeVolumeMapper();
  ~vtkPlumeVolumeMapper() override;

  /// Any data set.
  int FillInputPortInformation(int port, vtkInformation* information) override;

 private:
  void Draw(vtkRenderer& renderer, vtkVolume& volume);

  struct Inside;
  const std::unique_ptr<Inside> inside_;
};
