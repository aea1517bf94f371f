/// The integrators to choose from, as one type.
#pragma once

#include <optional>
#include <string>
#include <variant>

#include "plume/preint/adaptive_integrator.h"
#include "plume/preint/closed_form.h"
#include "plume/preint/midpoint.h"
#include "plume/preint/preintegrated_table.h"
#include "plume/preint/second_order_table.h"
#include "plume/preint/transfer_function.h"

namespace plume {

/// See the classes MidpointIntegrator, PreintegratedTable, ClosedForm, SecondOrderTable and
/// AdaptiveIntegrator.
enum class IntegratorKind { midpoint, table, closed_form, second_order_table, reference };

/// An integrator and what it reads.
struct IntegratorSettings {
  IntegratorKind kind = IntegratorKind::closed_form;  ///< which one
  /// Samples per segment, >= 1; read by `midpoint` alone.
  int samples = 1;
  /// Read by `table` alone.
  TableSettings table{};
  /// Read by `second_order_table` alone.
  SecondOrderTableSettings second_order_table{};
  /// Of colours, in shares of the transfer function's largest, 1e-13 to 1; read by `reference`
  /// alone.
  double tolerance = AdaptiveIntegrator::default_tolerance;

  /// The same in every number.
  bool operator==(const IntegratorSettings&) const = default;

  /// What is wrong with what the kind reads, in one line with the value; nothing where all is well.
  std::optional<std::string> problem() const;
};

/// Any integrator. Visit it once per frame, not once per segment, so that the loop over segments is
/// compiled for one of them:
///     std::visit([&](const auto& integrator) { trace(rays, integrator); }, chosen);
using Integrator = std::variant<MidpointIntegrator, PreintegratedTable, ClosedForm,
                                SecondOrderTable, AdaptiveIntegrator>;

/// Requires !transfer_function.problem() and !settings.problem().
Integrator make_integrator(const TransferFunction& transfer_function,
                           const IntegratorSettings& settings = {});

}  // namespace plume
