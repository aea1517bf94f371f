#include "plume/mesh/scalar_field.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "plume/mesh/error.h"

namespace plume {
namespace {

constexpr int kMagnitude = -1;

struct Choice {
  const Field* field = nullptr;
  int component = kMagnitude;
};

const Field* find(const Mesh& mesh, const std::string& name, std::optional<Association> wanted) {
  for (const Association association : {Association::point, Association::cell}) {
    if (wanted && *wanted != association) continue;
    for (const Field& field : mesh.fields)
      if (field.name == name && field.association == association) return &field;
  }
  return nullptr;
}

// "NAME", "NAME:component", "NAME:magnitude"; a name may hold colons itself, so the whole is tried
// first.
Choice choose(const Mesh& mesh, const FieldRequest& request) {
  if (mesh.fields.empty()) throw Error("the mesh has no fields: there is nothing to colour it by");
  if (request.name.empty()) {
    const Field* active = find(mesh, mesh.active_field, request.association);
    return {active ? active : &mesh.fields.front(), kMagnitude};
  }
  if (const Field* field = find(mesh, request.name, request.association)) return {field};

  const auto colon = request.name.rfind(':');
  if (colon != std::string::npos) {
    const std::string name = request.name.substr(0, colon);
    const std::string part = request.name.substr(colon + 1);
    if (const Field* field = find(mesh, name, request.association)) {
      if (part == "magnitude") return {field, kMagnitude};
      int component = -1;
      const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), component);
      if (error == std::errc{} && end == part.data() + part.size() && component >= 0 &&
          component < field->components)
        return {field, component};
      throw Error(fmt::format("field '{}' has no component '{}': ask for 0 to {} or 'magnitude'",
                              name, part, field->components - 1));
    }
  }
  throw Error(fmt::format("no field '{}'; there are: {}", request.name, list_fields(mesh)));
}

}  // namespace

std::string list_fields(const Mesh& mesh) {
  std::string list;
  for (const Field& field : mesh.fields) {
    if (!list.empty()) list += ", ";
    list += field.name;
    list += field.association == Association::point ? " (point" : " (cell";
    if (field.components > 1) list += fmt::format(", {} components", field.components);
    list += ")";
  }
  return list;
}

ScalarField select_field(const Mesh& mesh, const FieldRequest& request) {
  const auto [field, component] = choose(mesh, request);
  const std::size_t components = static_cast<std::size_t>(field->components);
  const std::size_t count =
      field->association == Association::point ? mesh.point_count() : mesh.cell_count();
  if (field->values.size() != count * components)
    throw Error(fmt::format("field '{}' holds {} values where {} {} of {} components need {}",
                            field->name, field->values.size(), count,
                            field->association == Association::point ? "points" : "cells",
                            components, count * components));

  ScalarField scalar;
  scalar.name = field->name;
  if (components > 1)
    scalar.name += component == kMagnitude ? ":magnitude" : fmt::format(":{}", component);
  scalar.association = field->association;
  scalar.values.resize(count);
  field->values.visit([&, part = component](auto values) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count), [&](const auto& range) {
      for (std::size_t i = range.begin(); i != range.end(); ++i) {
        double value = 0;
        if (components == 1) {
          value = static_cast<double>(values[i]);
        } else if (part != kMagnitude) {
          value = static_cast<double>(values[i * components + static_cast<std::size_t>(part)]);
        } else {
          for (std::size_t c = 0; c < components; ++c) {
            const double v = static_cast<double>(values[i * components + c]);
            value += v * v;
          }
          value = std::sqrt(value);
        }
        const float rounded = static_cast<float>(value);
        scalar.values[i] =
            std::isfinite(rounded) ? rounded : std::numeric_limits<float>::quiet_NaN();
      }
    });
  });

  float low = std::numeric_limits<float>::infinity();
  float high = -low;
  for (const float value : scalar.values) {
    if (std::isnan(value)) {
      ++scalar.not_finite;
    } else {
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  if (scalar.not_finite < count) {
    scalar.low = low;
    scalar.high = high;
  }
  return scalar;
}

}  // namespace plume
