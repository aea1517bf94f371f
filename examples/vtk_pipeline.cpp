// A pipeline of VTK's with Plume in it: reader, filter, writer. Neither window nor display is
// needed.

#include <vtkColorTransferFunction.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPiecewiseFunction.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkVolumeProperty.h>
#include <vtkXMLImageDataWriter.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <cstdio>
#include <string>

#include "plume/vtk/image_filter.h"

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "usage: vtk_pipeline MESH.vtu FIELD PICTURE.png|PICTURE.vti\n");
    return 2;
  }
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(argv[1]);
  reader->Update();
  vtkDataArray* values = reader->GetOutput()->GetPointData()->GetArray(argv[2]);
  if (values == nullptr) {
    std::fprintf(stderr, "%s: no array '%s' on points\n", argv[1], argv[2]);
    return 1;
  }

  double range[2];
  values->GetRange(range);
  vtkNew<vtkColorTransferFunction> color;
  color->AddRGBPoint(range[0], 0.23, 0.30, 0.75);
  color->AddRGBPoint(0.5 * (range[0] + range[1]), 0.87, 0.87, 0.87);
  color->AddRGBPoint(range[1], 0.71, 0.02, 0.15);
  vtkNew<vtkPiecewiseFunction> opacity;
  opacity->AddPoint(range[0], 0.9);
  opacity->AddPoint(range[1], 0);
  vtkNew<vtkVolumeProperty> property;
  property->SetColor(color);
  property->SetScalarOpacity(opacity);
  property->SetScalarOpacityUnitDistance(reader->GetOutput()->GetLength() / 20);

  vtkNew<vtkPlumeImageFilter> filter;
  filter->SetInputConnection(reader->GetOutputPort());
  filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, argv[2]);
  filter->SetVolumeProperty(property);
  filter->SetSize(320, 240);

  const std::string picture = argv[3];
  if (picture.ends_with(".vti")) {
    vtkNew<vtkXMLImageDataWriter> writer;  // floats, as they are
    writer->SetInputConnection(filter->GetOutputPort());
    writer->SetFileName(argv[3]);
    return writer->Write() == 1 ? 0 : 1;
  }
  filter->SetOutputScalarTypeToUnsignedChar();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(filter->GetOutputPort());
  writer->SetFileName(argv[3]);
  writer->Write();
  return writer->GetErrorCode() == 0 && filter->GetErrorCode() == 0 ? 0 : 1;
}
