#include "plume/preint/integrator.h"

namespace plume {

Integrator make_integrator(const TransferFunction& transfer_function,
                           const IntegratorSettings& settings) {
  switch (settings.kind) {
    case IntegratorKind::midpoint:
      return MidpointIntegrator(transfer_function, settings.samples);
    case IntegratorKind::table:
      return PreintegratedTable(transfer_function, settings.table);
    case IntegratorKind::closed_form:
      break;
  }
  return ClosedForm(transfer_function);
}

}  // namespace plume
