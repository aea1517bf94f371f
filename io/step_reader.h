/// A file that has been opened, whatever its format: what is known before its arrays are read.
#pragma once

#include <vtkSmartPointer.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "plume/io/read_mesh.h"

class vtkDataObject;

namespace plume {

/// Reads the time steps of one file, in any order. To be used by one thread at a time.
class StepReader {
 public:
  explicit StepReader(std::vector<double> times) : times_(std::move(times)) {}
  virtual ~StepReader() = default;
  StepReader(const StepReader&) = delete;
  StepReader& operator=(const StepReader&) = delete;

  /// Of each step; none for a file without time, which has one step.
  const std::vector<double>& times() const { return times_; }
  std::size_t step_count() const { return std::max<std::size_t>(1, times_.size()); }

  /// What the step holds. The data object is good until the next step is read, its arrays for as
  /// long as somebody holds them. Requires step < step_count(). Throws Error for what is wrong with
  /// the file.
  virtual vtkSmartPointer<vtkDataObject> read(std::size_t step, const Notice& notice) = 0;

  /// What can be known without reading the arrays: see TimeSeries::range(). Throws Error as read().
  virtual std::optional<std::array<double, 2>> range(std::size_t, const std::string&,
                                                     Association) const {
    return std::nullopt;
  }

 private:
  std::vector<double> times_;
};

/// A file without time that is read as a whole by a function.
class WholeFile : public StepReader {
 public:
  using Read = std::function<vtkSmartPointer<vtkDataObject>(const Notice&)>;
  explicit WholeFile(Read read) : StepReader({}), read_(std::move(read)) {}

  vtkSmartPointer<vtkDataObject> read(std::size_t, const Notice& notice) override {
    return read_(notice);
  }

 private:
  Read read_;
};

}  // namespace plume
