#include "plume/preint/integrator.h"

#include <cassert>
#include <cstdio>

namespace plume {

std::optional<std::string> IntegratorSettings::problem() const {
  char line[96];
  switch (kind) {
    case IntegratorKind::midpoint:
      if (samples >= 1) return std::nullopt;
      std::snprintf(line, sizeof line, "%d samples per segment: at least 1", samples);
      return line;
    case IntegratorKind::table:
      return table.problem();
    case IntegratorKind::second_order_table:
      return second_order_table.problem();
    case IntegratorKind::reference:
      if (tolerance >= 1e-13 && tolerance <= 1) return std::nullopt;
      std::snprintf(line, sizeof line, "a reference to a tolerance of %g: it must be 1e-13 to 1",
                    tolerance);
      return line;
    case IntegratorKind::closed_form:
      break;
  }
  return std::nullopt;
}

Integrator make_integrator(const TransferFunction& transfer_function,
                           const IntegratorSettings& settings) {
  assert(!settings.problem());
  switch (settings.kind) {
    case IntegratorKind::midpoint:
      return MidpointIntegrator(transfer_function, settings.samples);
    case IntegratorKind::table:
      return PreintegratedTable(transfer_function, settings.table);
    case IntegratorKind::second_order_table:
      return SecondOrderTable(transfer_function, settings.second_order_table);
    case IntegratorKind::reference:
      return AdaptiveIntegrator(transfer_function, settings.tolerance);
    case IntegratorKind::closed_form:
      break;
  }
  return ClosedForm(transfer_function);
}

}  // namespace plume
