/// What is made when a picture needs it.
#pragma once

#include <tbb/task_arena.h>

#include <atomic>
#include <memory>
#include <mutex>

namespace plume {

/// Safe to ask from several threads: one of them makes it, the others wait.
template <class T>
class MadeOnce {
 public:
  /// What make() returned when it was first asked for.
  template <class Make>
  const T& get(const Make& make) const {
    std::call_once(*once_, [&] {
      // Who makes it helps with no other task meanwhile: that could ask for it, too.
      tbb::this_task_arena::isolate([&] { value_ = std::make_unique<const T>(make()); });
      made_ = true;
    });
    return *value_;
  }
  bool made() const { return made_; }
  /// Forgets it, where what it was made of has changed. Not while others ask.
  void reset() {
    once_ = std::make_unique<std::once_flag>();
    value_.reset();
    made_ = false;
  }

 private:
  mutable std::unique_ptr<std::once_flag> once_ = std::make_unique<std::once_flag>();
  mutable std::unique_ptr<const T> value_;
  mutable std::atomic<bool> made_ = false;
};

}  // namespace plume
