#include <fmt/format.h>

#include <cstring>

#include "plume/capi/handles.h"

namespace plume::capi {
namespace {

// Of a fixed size, so that noting a message cannot fail.
thread_local char last_error[1024] = "";

}  // namespace

plume_status failed(plume_status status, const char* message) noexcept {
  std::strncpy(last_error, message, sizeof last_error - 1);
  return status;
}

void require(const void* pointer, const char* what) {
  if (pointer == nullptr) throw Error(fmt::format("{} is NULL", what));
}

}  // namespace plume::capi

const char* plume_version() { return plume::version(); }
const char* plume_last_error() { return plume::capi::last_error; }
