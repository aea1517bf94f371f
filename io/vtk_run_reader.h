/// Runs one of VTK's readers.
#pragma once

#include <vtkSmartPointer.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "plume/io/read_mesh.h"

class vtkAlgorithm;
class vtkDataObject;

namespace plume {

/// Updates the reader, whose file name is set, to the time step that the options ask for (the last
/// by default). `select` is called once the reader knows what the file holds, to say what is wanted
/// of it. Throws Error for what VTK reports, a time step that is not there, or no output; messages
/// with one of the texts `expected` in them are dropped.
vtkSmartPointer<vtkDataObject> run_reader(vtkAlgorithm& reader, const std::filesystem::path& file,
                                          const ReadOptions& options, const Notice& notice,
                                          const std::function<void()>& select = {},
                                          const std::vector<std::string>& expected = {});

/// Which of `count` time steps the options ask for, the last by default. Throws Error when there
/// is no such step. `count` may be 0 for a file without time, which counts as one step.
int choose_time_step(int count, const std::filesystem::path& file, const ReadOptions& options);

}  // namespace plume
