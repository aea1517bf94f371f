/// Which Plume this is.
#pragma once

namespace plume {

/// The version of the library that the program runs with: "0.1.0". Before 1.0, a new minor version
/// may change any interface but the C one.
const char* version();

}  // namespace plume
