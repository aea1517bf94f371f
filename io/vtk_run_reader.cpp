#include "plume/io/vtk_run_reader.h"

#include <vtkAlgorithm.h>
#include <vtkDataObject.h>
#include <vtkInformation.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <algorithm>
#include <string>

#include "plume/io/vtk_errors.h"
#include "plume/mesh/error.h"

namespace plume {

int choose_time_step(int count, const std::filesystem::path& file, const ReadOptions& options) {
  const int last = std::max(count, 1) - 1;
  const int step = options.time_step.value_or(last);
  if (step < 0 || step > last)
    throw Error(file.string() + ": there is no time step " + std::to_string(step) +
                "; choose one from 0 to " + std::to_string(last));
  return step;
}

vtkSmartPointer<vtkDataObject> run_reader(vtkAlgorithm& reader, const std::filesystem::path& file,
                                          const ReadOptions& options, const Notice& notice,
                                          const std::function<void()>& select,
                                          const std::vector<std::string>& expected) {
  // In two steps: readers that could not make sense of a file's header crash on its data.
  const auto update_information = [&] {
    reader.UpdateInformation();
    if (select) select();
  };
  with_vtk_errors(file, notice, check_the_file, update_information, expected);

  using Pipeline = vtkStreamingDemandDrivenPipeline;
  vtkInformation* const information = reader.GetOutputInformation(0);
  const bool has_time = information && information->Has(Pipeline::TIME_STEPS());
  const int steps = has_time ? information->Length(Pipeline::TIME_STEPS()) : 0;
  const int step = choose_time_step(steps, file, options);

  vtkSmartPointer<vtkDataObject> output;
  const auto update = [&] {
    if (steps > 0)
      reader.UpdateTimeStep(information->Get(Pipeline::TIME_STEPS())[step]);
    else
      reader.Update();
    output = reader.GetOutputDataObject(0);
  };
  with_vtk_errors(file, notice, check_the_file, update, expected);
  if (!output) throw Error(file.string() + ": VTK reads nothing from it; check the file's format");
  return output;
}

}  // namespace plume
