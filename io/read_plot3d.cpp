// Plot3D through VTK's reader, told what plot3d_layout.h found: given a file that it misjudges, the
// reader would allocate whatever the first bytes happen to say.
#include <vtkMultiBlockDataSet.h>
#include <vtkMultiBlockPLOT3DReader.h>
#include <vtkPointData.h>
#include <vtkStructuredGrid.h>

#include <array>
#include <string>
#include <utility>

#include "plume/io/plot3d_layout.h"
#include "plume/io/read_formats.h"
#include "plume/io/vtk_run_reader.h"
#include "plume/mesh/error.h"

namespace plume {
namespace {

// VTK's numbers of what it can derive from the q file. Density (100), Momentum (202) and
// StagnationEnergy (163) are in the file itself.
constexpr std::array derived_functions{110, 111, 112, 113, 120, 130, 144, 153,
                                       170, 184, 200, 201, 210, 211, 212};

constexpr std::array fields_that_need_energy{"Pressure",   "PressureCoefficient", "MachNumber",
                                             "SoundSpeed", "Temperature",         "Enthalpy",
                                             "Entropy",    "PressureGradient"};

bool energy_is_zero(vtkMultiBlockDataSet& blocks) {
  for (unsigned i = 0; i < blocks.GetNumberOfBlocks(); ++i) {
    auto* const grid = vtkStructuredGrid::SafeDownCast(blocks.GetBlock(i));
    auto* const energy = grid ? grid->GetPointData()->GetArray("StagnationEnergy") : nullptr;
    if (!energy) return false;
    double range[2];
    energy->GetRange(range);
    if (range[0] != 0 || range[1] != 0) return false;
  }
  return true;
}

// Some public q files have no energy in them. Pressure and all that follows from it would be
// nonsense, half of it not even finite.
void leave_out_what_needs_energy(vtkMultiBlockDataSet& blocks,
                                 const std::filesystem::path& solution, const Notice& notice) {
  std::string names;
  for (const char* const name : fields_that_need_energy) {
    for (unsigned i = 0; i < blocks.GetNumberOfBlocks(); ++i)
      vtkStructuredGrid::SafeDownCast(blocks.GetBlock(i))->GetPointData()->RemoveArray(name);
    names += (names.empty() ? "" : ", ") + std::string(name);
  }
  if (notice)
    notice(solution.string() +
           ": the energy is zero throughout, so that the fields which need it "
           "are left out: " +
           names);
}

// VTK's reader, and doubts about what it reads.
class Plot3dReader : public StepReader {
 public:
  Plot3dReader(OpenedFile vtk, std::filesystem::path file, std::filesystem::path solution,
               std::size_t block_count)
      : StepReader({}),
        vtk_(std::move(vtk)),
        file_(std::move(file)),
        solution_(std::move(solution)),
        block_count_(block_count) {}

  vtkSmartPointer<vtkDataObject> read(std::size_t, const Notice& notice) override {
    auto data = vtk_->read(vtk_->step_count() - 1, notice);
    auto* const blocks = vtkMultiBlockDataSet::SafeDownCast(data);
    if (!blocks || blocks->GetNumberOfBlocks() != block_count_)
      throw Error(file_.string() + ": VTK reads other than its " + std::to_string(block_count_) +
                  " blocks; check that the file is whole");
    if (!solution_.empty() && energy_is_zero(*blocks))
      leave_out_what_needs_energy(*blocks, solution_, notice);
    return data;
  }

 private:
  OpenedFile vtk_;
  std::filesystem::path file_, solution_;
  std::size_t block_count_;
};

}  // namespace

OpenedFile open_plot3d(const std::filesystem::path& file, const ReadOptions& options,
                       const Notice& notice) {
  const Plot3dLayout layout = plot3d_grid_layout(file);
  const auto reader = vtkSmartPointer<vtkMultiBlockPLOT3DReader>::New();
  reader->SetXYZFileName(file.string().c_str());
  reader->AutoDetectFormatOff();
  reader->TwoDimensionalGeometryOff();
  reader->SetBinaryFile(!layout.text);
  reader->SetHasByteCount(layout.record_marks);
  reader->SetMultiGrid(layout.multi_block);
  reader->SetIBlanking(layout.blanking);
  reader->SetDoublePrecision(layout.double_precision);
  if (layout.little_endian)
    reader->SetByteOrderToLittleEndian();
  else
    reader->SetByteOrderToBigEndian();
  if (!options.solution.empty()) {
    check_plot3d_solution(options.solution, layout);
    reader->SetQFileName(options.solution.string().c_str());
    for (const int function : derived_functions) reader->AddFunction(function);
    reader->SetScalarFunctionNumber(100);
  }
  return std::make_unique<Plot3dReader>(open_reader(reader, file, notice), file, options.solution,
                                        layout.blocks.size());
}

}  // namespace plume
