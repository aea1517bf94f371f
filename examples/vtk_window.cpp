// A program of VTK's that draws a volume and a surface, in which one line was changed.

#include <vtkActor.h>
#include <vtkColorTransferFunction.h>
#include <vtkContourFilter.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPiecewiseFunction.h>
#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>
#include <vtkWindowToImageFilter.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <cstdio>

#include "plume/vtk/volume_mapper.h"

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "usage: vtk_window MESH.vtu FIELD PICTURE.png\n");
    return 2;
  }
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(argv[1]);
  reader->Update();
  reader->GetOutput()->GetPointData()->SetActiveScalars(argv[2]);
  vtkDataArray* values = reader->GetOutput()->GetPointData()->GetScalars();
  if (values == nullptr) {
    std::fprintf(stderr, "%s: no array '%s' on points\n", argv[1], argv[2]);
    return 1;
  }
  double range[2];
  values->GetRange(range);

  vtkNew<vtkPlumeVolumeMapper> mapper;  // was: vtkUnstructuredGridVolumeRayCastMapper
  mapper->SetInputData(reader->GetOutput());
  vtkNew<vtkVolume> volume;
  volume->SetMapper(mapper);
  vtkNew<vtkColorTransferFunction> color;
  color->AddRGBPoint(range[0], 0.23, 0.30, 0.75);
  color->AddRGBPoint(range[1], 0.71, 0.02, 0.15);
  vtkNew<vtkPiecewiseFunction> opacity;
  opacity->AddPoint(range[0], 0);
  opacity->AddPoint(range[1], 0.5);
  volume->GetProperty()->SetColor(color);
  volume->GetProperty()->SetScalarOpacity(opacity);
  volume->GetProperty()->SetScalarOpacityUnitDistance(reader->GetOutput()->GetLength() / 20);

  vtkNew<vtkContourFilter> contour;
  contour->SetInputData(reader->GetOutput());
  contour->SetValue(0, 0.5 * (range[0] + range[1]));
  vtkNew<vtkPolyDataMapper> surface;
  surface->SetInputConnection(contour->GetOutputPort());
  surface->ScalarVisibilityOff();
  vtkNew<vtkActor> actor;
  actor->SetMapper(surface);
  actor->GetProperty()->SetColor(0.9, 0.8, 0.5);

  vtkNew<vtkRenderer> renderer;
  renderer->AddVolume(volume);
  renderer->AddActor(actor);
  renderer->SetBackground(0.1, 0.1, 0.15);
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetSize(320, 240);
  window->AddRenderer(renderer);
  window->Render();

  vtkNew<vtkWindowToImageFilter> screenshot;
  screenshot->SetInput(window);
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(screenshot->GetOutputPort());
  writer->SetFileName(argv[3]);
  writer->Write();
  return writer->GetErrorCode() == 0 ? 0 : 1;
}
