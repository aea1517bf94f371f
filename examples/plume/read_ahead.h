/// The steps of a series, the next of which is read while the last is looked at.
#pragma once

#include <cstddef>
#include <future>
#include <string>
#include <vector>

#include "plume/io/time_series.h"

namespace plume::command {

/// Reads steps in a given order. One thread reads, as VTK's readers and the libraries below them
/// are not all safe to run twice at once; so the series must not be used elsewhere meanwhile, and
/// must outlive this.
class ReadAhead {
 public:
  struct Taken {
    TimeSeries::Step step;
    std::vector<std::string> notices;
    double ms_read;  ///< how long reading took, be it while others waited or not
    double ms_wait;  ///< how long next() waited for it
  };

  /// With `ahead`, the first is read from now on; without, each when it is asked for, so that no
  /// more than one mesh is held.
  ReadAhead(TimeSeries& series, std::vector<std::size_t> steps, bool ahead);

  /// Waits for the next step, and lets the one after it be read. Throws the Error of reading.
  /// Requires that there is one.
  Taken next();

 private:
  Taken read(std::size_t step);
  void start();

  TimeSeries& series_;
  std::vector<std::size_t> steps_;
  const bool ahead_;
  std::size_t started_ = 0;
  std::future<Taken> coming_;  // last: its destructor waits for the thread
};

}  // namespace plume::command
