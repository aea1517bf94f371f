#include "plume/lib/version.h"

namespace plume {

const char* version() { return PLUME_VERSION; }

}  // namespace plume
