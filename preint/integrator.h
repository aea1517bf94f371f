/// The integrators to choose from, as one type.
#pragma once

#include <variant>

#include "plume/preint/closed_form.h"
#include "plume/preint/midpoint.h"
#include "plume/preint/preintegrated_table.h"
#include "plume/preint/transfer_function.h"

namespace plume {

/// See the classes MidpointIntegrator, PreintegratedTable and ClosedForm.
enum class IntegratorKind { midpoint, table, closed_form };

/// An integrator and what it reads.
struct IntegratorSettings {
  IntegratorKind kind = IntegratorKind::closed_form;  ///< which one
  /// Samples per segment, >= 1; read by `midpoint` alone.
  int samples = 1;
  /// Read by `table` alone.
  TableSettings table;
};

/// Any integrator. Visit it once per frame, not once per segment, so that the loop over segments is
/// compiled for one of them:
///     std::visit([&](const auto& integrator) { trace(rays, integrator); }, chosen);
using Integrator = std::variant<MidpointIntegrator, PreintegratedTable, ClosedForm>;

/// Requires !transfer_function.problem() and valid settings.
Integrator make_integrator(const TransferFunction& transfer_function,
                           const IntegratorSettings& settings = {});

}  // namespace plume
