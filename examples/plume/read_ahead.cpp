#include "read_ahead.h"

#include <cassert>
#include <utility>

#include "stopwatch.h"

namespace plume::command {

ReadAhead::ReadAhead(TimeSeries& series, std::vector<std::size_t> steps, bool ahead)
    : series_(series), steps_(std::move(steps)), ahead_(ahead) {
  if (ahead_) start();
}

void ReadAhead::start() {
  if (started_ == steps_.size()) return;
  const std::size_t step = steps_[started_++];
  coming_ = std::async(ahead_ ? std::launch::async : std::launch::deferred,
                       [this, step] { return read(step); });
}

ReadAhead::Taken ReadAhead::read(std::size_t step) {
  Stopwatch watch;
  Taken taken{};
  taken.step =
      series_.read(step, [&](const std::string& notice) { taken.notices.push_back(notice); });
  taken.ms_read = watch.lap();
  return taken;
}

ReadAhead::Taken ReadAhead::next() {
  Stopwatch watch;
  if (!ahead_) start();
  assert(coming_.valid());
  Taken taken = coming_.get();
  taken.ms_wait = watch.lap();
  if (ahead_) start();
  return taken;
}

}  // namespace plume::command
