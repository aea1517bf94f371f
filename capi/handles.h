// What the C interface's handles are, and how calls keep their promises about errors.
#pragma once

#include <exception>
#include <new>
#include <string>
#include <vector>

#include "plume/capi/plume_c.h"
#include "plume/lib/plume.h"

struct plume_mesh {
  plume::Mesh mesh;
};

struct plume_scene {
  plume::Scene scene;
};

struct plume_settings {
  struct Channel {
    std::string name;
    float* values;
  };
  plume::RenderSettings settings;
  std::vector<Channel> channels;
  plume::Progress progress;
};

namespace plume::capi {

/// Notes the message for plume_last_error() and passes the status on.
plume_status failed(plume_status status, const char* message) noexcept;

/// Throws Error where a pointer that is needed is null.
void require(const void* pointer, const char* what);

/// Does what a function of the interface does. Nothing is thrown across it: what could be ends
/// here.
template <class Body>
plume_status guarded(const Body& body) noexcept {
  try {
    return body();
  } catch (const Error& error) {
    return failed(PLUME_BAD_INPUT, error.what());
  } catch (const std::bad_alloc&) {
    return failed(PLUME_OUT_OF_MEMORY, "out of memory");
  } catch (const std::exception& error) {
    return failed(PLUME_INTERNAL, error.what());
  }
}

/// The caller's memory, not copied. Throws Error, naming the array, for a null pointer to some
/// numbers or a type that is none.
Array borrow(const plume_array& array, const char* what);

}  // namespace plume::capi
