/// What of a transfer function samples may miss.
#pragma once

#include "plume/preint/transfer_function.h"

namespace plume {

/// The least distance over which extinction rises and falls again, by more than a tenth of the
/// greatest extinction either way, in the field's unit; infinite where it never does.
double narrowest_spike(const TransferFunction& transfer_function);

}  // namespace plume
