#include "plume/io/time_series.h"

#include <fmt/format.h>
#include <vtkDataArray.h>
#include <vtkDataObject.h>
#include <vtkFieldData.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "plume/io/find_files.h"
#include "plume/io/read_formats.h"
#include "plume/io/vtk_to_mesh.h"
#include "plume/io/vtk_xml_range.h"

namespace plume {
namespace {

// What programs that write one file a step say of its time.
std::optional<double> time_value_of(vtkDataObject& data) {
  auto* const array = data.GetFieldData()->GetArray("TimeValue");
  if (!array || array->GetNumberOfValues() != 1) return std::nullopt;
  const double time = array->GetTuple1(0);
  return std::isfinite(time) ? std::optional(time) : std::nullopt;
}

}  // namespace

struct TimeSeries::Body {
  ReadOptions options;
  /// One file with all steps, opened; or files that are each a step.
  std::filesystem::path file;
  OpenedFile opened;
  std::vector<std::filesystem::path> files;
};

TimeSeries::TimeSeries(const std::string& file_or_pattern, const ReadOptions& options,
                       const Notice& notice)
    : body_(std::make_unique<Body>()) {
  body_->options = options;
  if (is_file_pattern(file_or_pattern)) {
    body_->files = find_files(file_or_pattern);
  } else {
    body_->file = file_or_pattern;
    body_->opened = open_mesh(body_->file, options, notice);
  }
}

TimeSeries::~TimeSeries() = default;
TimeSeries::TimeSeries(TimeSeries&&) noexcept = default;
TimeSeries& TimeSeries::operator=(TimeSeries&&) noexcept = default;

std::size_t TimeSeries::size() const {
  return body_->opened ? body_->opened->step_count() : body_->files.size();
}

std::optional<double> TimeSeries::time(std::size_t step) const {
  if (!body_->opened || body_->opened->times().empty()) return std::nullopt;
  return body_->opened->times()[step];
}

std::filesystem::path TimeSeries::file(std::size_t step) const {
  return body_->opened ? body_->file : body_->files[step];
}

std::string TimeSeries::describe(std::size_t step) const {
  std::string words = fmt::format("step {}", step);
  if (const auto at = time(step)) words += fmt::format(" (time {:g})", *at);
  if (!body_->opened) words += fmt::format(" ({})", body_->files[step].string());
  return words;
}

std::optional<std::array<double, 2>> TimeSeries::range(const std::string& field,
                                                       Association association) const {
  std::optional<std::array<double, 2>> all;
  for (std::size_t step = 0; step < size(); ++step) {
    const auto range = body_->opened ? body_->opened->range(step, field, association)
                                     : vtk_xml_range(body_->files[step], field, association);
    if (!range) return std::nullopt;
    all = all ? std::array{std::min((*all)[0], (*range)[0]), std::max((*all)[1], (*range)[1])}
              : *range;
  }
  return all;
}

TimeSeries::Step TimeSeries::read(std::size_t step, const Notice& notice) {
  const auto read_from = [&](StepReader& opened, std::size_t place) {
    const auto data = opened.read(place, notice);
    Step read{mesh_from_vtk(*data, file(step), body_->options, notice), time(step)};
    if (!read.time) read.time = time_value_of(*data);
    return read;
  };
  if (body_->opened) return read_from(*body_->opened, step);
  const OpenedFile opened = open_mesh(body_->files[step], body_->options, notice);
  return read_from(*opened, opened->step_count() - 1);
}

}  // namespace plume
