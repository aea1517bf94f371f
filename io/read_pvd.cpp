// ParaView's collection of files. Its reader is ParaView's own, and not in VTK.
#include <vtkDataObject.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUtilities.h>

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "plume/io/read_file.h"
#include "plume/io/read_formats.h"
#include "plume/io/vtk_errors.h"
#include "plume/io/vtk_xml_range.h"
#include "plume/mesh/error.h"

namespace plume {
namespace {

constexpr std::array<std::string_view, 9> part_extensions{
    ".vtu", ".pvtu", ".vts", ".pvts", ".vti", ".pvti", ".vtr", ".pvtr", ".vtm"};

// Names of the parts' files, by time.
using Collection = std::map<double, std::vector<std::string>>;

Collection read_collection(const std::filesystem::path& file, const Notice& notice) {
  check_vtk_xml_end(file);
  vtkSmartPointer<vtkXMLDataElement> root;
  with_vtk_errors(file, notice, check_the_file, [&] {
    root.TakeReference(vtkXMLUtilities::ReadElementFromFile(file.string().c_str()));
  });
  vtkXMLDataElement* const list = root ? root->FindNestedElementWithName("Collection") : nullptr;
  if (!list)
    throw Error(file.string() +
                ": no <Collection> of files in it; check that it is ParaView's .pvd");
  Collection collection;
  for (int i = 0; i < list->GetNumberOfNestedElements(); ++i) {
    vtkXMLDataElement* const element = list->GetNestedElement(i);
    const char* const name = element->GetAttribute("file");
    if (!name) throw Error(file.string() + ": a DataSet without a file; name one");
    double time = 0;
    element->GetScalarAttribute("timestep", time);
    collection[time].emplace_back(name);
  }
  if (collection.empty()) throw Error(file.string() + ": lists no files; add one");
  return collection;
}

std::vector<double> times_of(const Collection& collection) {
  std::vector<double> times;
  for (const auto& [time, parts] : collection) times.push_back(time);
  return times;
}

class PvdReader : public StepReader {
 public:
  PvdReader(std::filesystem::path file, Collection collection)
      : StepReader(times_of(collection)),
        file_(std::move(file)),
        collection_(std::move(collection)) {}

  vtkSmartPointer<vtkDataObject> read(std::size_t step, const Notice& notice) override {
    const auto& parts = collection_.at(times()[step]);
    const auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
    unsigned next = 0;
    for (const std::string& name : parts) {
      const auto part = file_.parent_path() / name;
      if (lower_extension(part) == ".vtp") {
        if (notice) notice(part.string() + ": skipped, a surface");
        continue;
      }
      if (std::find(part_extensions.begin(), part_extensions.end(), lower_extension(part)) ==
          part_extensions.end())
        throw Error(part.string() + ": no format that a .pvd such as " + file_.string() +
                    " can list; it holds VTK's XML files");
      check_readable(part);
      // The parts are of the chosen time already.
      const auto opened = open_vtk_file(part, {}, notice);
      blocks->SetBlock(next++, opened->read(opened->step_count() - 1, notice));
    }
    return blocks;
  }

  std::optional<std::array<double, 2>> range(std::size_t step, const std::string& field,
                                             Association association) const override {
    std::optional<std::array<double, 2>> all;
    for (const std::string& name : collection_.at(times()[step])) {
      const auto part = file_.parent_path() / name;
      if (lower_extension(part) == ".vtp") continue;
      check_readable(part);
      const auto range = vtk_xml_range(part, field, association);
      if (!range) return std::nullopt;
      all = all ? std::array{std::min((*all)[0], (*range)[0]), std::max((*all)[1], (*range)[1])}
                : *range;
    }
    return all;
  }

 private:
  std::filesystem::path file_;
  Collection collection_;
};

}  // namespace

OpenedFile open_pvd(const std::filesystem::path& file, const ReadOptions&, const Notice& notice) {
  return std::make_unique<PvdReader>(file, read_collection(file, notice));
}

}  // namespace plume
