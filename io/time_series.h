/// A mesh that changes in time: the steps that a file, or several, hold.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "plume/io/read_mesh.h"

namespace plume {

/// The steps of one file with time steps in it (.pvd, Exodus II, EnSight Gold, OpenFOAM, CGNS), or
/// files of which each is a step, by a pattern (see find_files.h). A file without time is a series
/// of one step.
///
/// A file is opened once, so that what its format keeps once for all steps need not be read again.
/// To be read by one thread at a time; what else there is to ask may be asked meanwhile.
class TimeSeries {
 public:
  /// Finds the steps, and reads nothing but what says so. `options` as in read_mesh(), but for
  /// time_step, which is not looked at. Throws Error where there is no such file, or no file that
  /// matches.
  explicit TimeSeries(const std::string& file_or_pattern, const ReadOptions& options = {},
                      const Notice& notice = {});
  ~TimeSeries();
  TimeSeries(TimeSeries&&) noexcept;
  TimeSeries& operator=(TimeSeries&&) noexcept;

  std::size_t size() const;
  /// Of the step, in the file's unit; nothing where the file says none, or says it only in each
  /// step's own file. Requires step < size().
  std::optional<double> time(std::size_t step) const;
  /// The file that the step is in, of several by a pattern; otherwise the one that was given.
  std::filesystem::path file(std::size_t step) const;
  /// For messages: "step 3 (time 0.25)", and the file where each step has its own.
  std::string describe(std::size_t step) const;

  /// The least and greatest value of a field (of its magnitude, where it has several components)
  /// over all steps, where the files' headers say it, as those of VTK's XML files do; a hint, not
  /// to be relied upon. Nothing where it takes more than that. Throws Error for a file that is
  /// missing.
  std::optional<std::array<double, 2>> range(const std::string& field,
                                             Association association) const;

  struct Step {
    Mesh mesh;
    /// As time(), or what the step's own file says: VTK's field data "TimeValue".
    std::optional<double> time;
  };
  /// Steps may be read in any order. Meshes stay what they are when others are read. Requires step
  /// < size(). Throws Error for what is wrong with the file.
  Step read(std::size_t step, const Notice& notice = {});

 private:
  struct Body;
  std::unique_ptr<Body> body_;
};

}  // namespace plume
