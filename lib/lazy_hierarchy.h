/// A hierarchy of cells that is made when a picture needs it.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>

namespace plume {

struct CellHierarchy;
struct WalkableTets;

/// Safe to ask from several threads: one of them makes it, the others wait.
class LazyHierarchy {
 public:
  LazyHierarchy();
  ~LazyHierarchy();

  /// Of that mesh, always the same.
  const CellHierarchy& of(const WalkableTets& mesh) const;
  bool made() const { return made_; }
  /// Forgets it, where the mesh's scalars have changed. Not while others ask.
  void reset();

 private:
  mutable std::unique_ptr<std::once_flag> once_;
  mutable std::unique_ptr<const CellHierarchy> hierarchy_;
  mutable std::atomic<bool> made_ = false;
};

}  // namespace plume
