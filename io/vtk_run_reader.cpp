#include "plume/io/vtk_run_reader.h"

#include <vtkAlgorithm.h>
#include <vtkDataObject.h>
#include <vtkInformation.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <utility>

#include "plume/io/vtk_errors.h"
#include "plume/mesh/error.h"

namespace plume {
namespace {

using Pipeline = vtkStreamingDemandDrivenPipeline;

std::vector<double> times_of(vtkAlgorithm& reader) {
  // VTK 9.1 says 0 of a legacy file with a TimeValue, whatever that is.
  if (reader.IsA("vtkGenericDataObjectReader")) return {};
  vtkInformation* const information = reader.GetOutputInformation(0);
  if (!information || !information->Has(Pipeline::TIME_STEPS())) return {};
  const double* const first = information->Get(Pipeline::TIME_STEPS());
  return {first, first + information->Length(Pipeline::TIME_STEPS())};
}

class VtkStepReader : public StepReader {
 public:
  VtkStepReader(vtkSmartPointer<vtkAlgorithm> reader, std::filesystem::path file,
                std::vector<std::string> expected)
      : StepReader(times_of(*reader)),
        reader_(std::move(reader)),
        file_(std::move(file)),
        expected_(std::move(expected)) {}

  vtkSmartPointer<vtkDataObject> read(std::size_t step, const Notice& notice) override {
    vtkSmartPointer<vtkDataObject> output;
    const auto update = [&] {
      if (times().empty())
        reader_->Update();
      else
        reader_->UpdateTimeStep(times()[step]);
      output = reader_->GetOutputDataObject(0);
    };
    with_vtk_errors(file_, notice, check_the_file, update, expected_);
    if (!output)
      throw Error(file_.string() + ": VTK reads nothing from it; check the file's format");
    return output;
  }

 private:
  vtkSmartPointer<vtkAlgorithm> reader_;
  std::filesystem::path file_;
  std::vector<std::string> expected_;
};

}  // namespace

std::unique_ptr<StepReader> open_reader(vtkSmartPointer<vtkAlgorithm> reader,
                                        const std::filesystem::path& file, const Notice& notice,
                                        const std::function<void()>& select,
                                        std::vector<std::string> expected) {
  // Apart from reading: readers that could not make sense of a file's header crash on its data.
  const auto update_information = [&] {
    reader->UpdateInformation();
    if (select) select();
  };
  with_vtk_errors(file, notice, check_the_file, update_information, expected);
  return std::make_unique<VtkStepReader>(std::move(reader), file, std::move(expected));
}

}  // namespace plume
