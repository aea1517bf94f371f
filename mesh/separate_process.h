/// Calls code that may abort or crash, in a process of its own.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>

namespace plume {

/// Where the other process leaves what it found.
class ResultFile {
 public:
  explicit ResultFile(int descriptor) : descriptor_(descriptor) {}

  /// Appends bytes; ends the process where there is no memory for them.
  void write(std::span<const std::byte> bytes);

 private:
  int descriptor_;
};

struct SeparateRun {
  /// Empty where the work returned; else how its process ended: "aborted", "ended by signal 11
  /// (Segmentation fault)".
  std::string failure;
  /// What it printed, to standard output and standard error.
  std::string said;
  /// What it wrote to the ResultFile; `keep_alive` holds it.
  std::span<const std::byte> result;
  std::shared_ptr<const void> keep_alive;
};

/// Calls `work` in a copy of this process made by fork(), and waits for it. Whatever `work` does
/// there (abort, a signal, std::terminate, a changed variable) leaves this process as it is:
/// signals have their default handlers, nothing reaches this process' standard output or error, no
/// core is dumped, no exit handler runs. An exception that leaves `work` counts as an abort. If
/// this process ends, so does the other.
///
/// Only the calling thread exists in the copy, so `work` must not wait for another (no TBB). It may
/// allocate, as glibc's fork() keeps the heap usable in a program with threads. Throws Error where
/// no process can be started.
SeparateRun run_separately(const std::function<void(ResultFile&)>& work);

}  // namespace plume
