/// Plume in a VTK pipeline: pictures without a window.
#pragma once

#include <vtkImageAlgorithm.h>

#include <memory>

class vtkCamera;
class vtkVolumeProperty;

/// Makes a picture of a data set with volume cells: no window, no display and no graphics library
/// is needed.
///
/// The input is any vtkDataSet or composite data set; the array is that of
/// SetInputArrayToProcess(), by default the active scalars. What is kept from one update to the
/// next, and what a property means, is as in vtkPlumeVolumeMapper.
///
/// The output is a vtkImageData of the wanted size whose scalars, "RGBA", are four floats a pixel:
/// premultiplied by alpha, colours as the property's numbers. Bad input is reported by
/// vtkErrorMacro, the update fails, and the output is empty.
class vtkPlumeImageFilter : public vtkImageAlgorithm {
  vtkTypeMacro(vtkPlumeImageFilter, vtkImageAlgorithm)

 public:
  /// A new one, of which the caller owns the first reference.
  static vtkPlumeImageFilter* New();
  /// Prints the settings.
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// What values look like; null, the default, for colours that are fitted to them.
  void SetVolumeProperty(vtkVolumeProperty* property);
  /// As it was set.
  vtkVolumeProperty* GetVolumeProperty() const;

  /// Where the picture is taken from; null, the default, for one that looks along -z and sees all
  /// of the mesh. Its clipping range is not looked at.
  void SetActiveCamera(vtkCamera* camera);
  /// As it was set.
  vtkCamera* GetActiveCamera() const;

  /// Width and height in pixels, 1 to 65536; 1024 x 768 by default.
  void SetSize(int width, int height);
  /// Of the two, as they were set.
  const int* GetSize() const;

  /// Scalars as four unsigned chars a pixel, not premultiplied, as PNG files have them.
  void SetOutputScalarTypeToUnsignedChar();
  /// Scalars as four floats a pixel, premultiplied: the default.
  void SetOutputScalarTypeToFloat();

  /// Whether there is a further array "depth", one float a pixel: the distance along the pixel's
  /// ray to the first contribution, infinite where there is none. Off by default.
  void SetComputeDepth(bool depth);
  /// As it was set.
  bool GetComputeDepth() const;
  void ComputeDepthOn() { SetComputeDepth(true); }    ///< see SetComputeDepth()
  void ComputeDepthOff() { SetComputeDepth(false); }  ///< see SetComputeDepth()

  /// See vtkPlumeVolumeMapper.
  void SetComponent(int component);
  void SetComponentToMagnitude();        ///< see vtkPlumeVolumeMapper
  void SetTolerance(double tolerance);   ///< see vtkPlumeVolumeMapper
  double GetTolerance() const;           ///< as it was set
  void SetNumberOfThreads(int threads);  ///< see vtkPlumeVolumeMapper
  int GetNumberOfThreads() const;        ///< as it was set
  int GetMeshesMade() const;             ///< see vtkPlumeVolumeMapper
  int GetFieldsPut() const;              ///< see vtkPlumeVolumeMapper
  int GetTransferFunctionsMade() const;  ///< see vtkPlumeVolumeMapper

  /// Of camera and property as well.
  vtkMTimeType GetMTime() override;

  vtkPlumeImageFilter(const vtkPlumeImageFilter&) = delete;
  vtkPlumeImageFilter& operator=(const vtkPlumeImageFilter&) = delete;

 protected:
  /// See New().
  vtkPlumeImageFilter();
  ~vtkPlumeImageFilter() override;

  /// A data set, or a composite one.
  int FillInputPortInformation(int port, vtkInformation* information) override;
  /// The picture's size and type.
  int RequestInformation(vtkInformation* request, vtkInformationVector** inputs,
                         vtkInformationVector* outputs) override;
  /// All of the input, whatever part of the picture is wanted.
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputs,
                          vtkInformationVector* outputs) override;
  /// Makes the picture.
  int RequestData(vtkInformation* request, vtkInformationVector** inputs,
                  vtkInformationVector* outputs) override;

 private:
  void Draw(vtkDataObject& data, vtkImageData& output);

  struct Inside;
  const std::unique_ptr<Inside> inside_;
};
