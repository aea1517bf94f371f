/// Runs one of VTK's readers.
#pragma once

#include <vtkSmartPointer.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "plume/io/read_mesh.h"
#include "plume/io/step_reader.h"

class vtkAlgorithm;

namespace plume {

/// Lets the reader, whose file name is set, find out what the file holds, and keeps it: what it has
/// read once (a mesh that stays, say) it may give again. `select` is called once the reader knows
/// what there is, to say what is wanted of it. Throws Error for what VTK reports, now or when a
/// step is read; messages with one of the texts `expected` in them are dropped.
std::unique_ptr<StepReader> open_reader(vtkSmartPointer<vtkAlgorithm> reader,
                                        const std::filesystem::path& file, const Notice& notice,
                                        const std::function<void()>& select = {},
                                        std::vector<std::string> expected = {});

}  // namespace plume
