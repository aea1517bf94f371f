/// RapidCheck, with the same cases in every run.
#pragma once

#include <gtest/gtest.h>
#include <rapidcheck.h>
// After GoogleTest, which it needs and does not include.
#include <rapidcheck/gtest.h>

#include <cstdlib>

namespace plume::tests {

/// RapidCheck reads RC_PARAMS before its first property, which is after this. An RC_PARAMS of the
/// user's own stays, to reproduce or to widen a search.
inline const int seeded = setenv("RC_PARAMS", "seed=20260917 max_success=500", 0);

}  // namespace plume::tests
