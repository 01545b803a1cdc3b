#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "harness/rows/fields.hpp"
#include "harness/rows/row.hpp"

/// Functions to write and read rows of every kind.
namespace pairsum::harness {

/// null for what is not finite.
inline nlohmann::json finite(double value) {
  return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(nullptr);
}

inline nlohmann::json finite(const std::optional<double>& value) {
  return value ? finite(*value) : nlohmann::json(nullptr);
}

template <class T>
nlohmann::json or_null(const std::optional<T>& value) {
  return value ? nlohmann::json(*value) : nlohmann::json(nullptr);
}

/// The keys that rows of every kind have; the environment only those that name one.
template <class Row>
nlohmann::json head(const char* kind, const Row& row) {
  nlohmann::json j{{"schema", row_schema}, {"kind", kind}, {"study", row.study}, {"utc", row.utc}};
  if constexpr (requires { row.environment; }) j["environment"] = row.environment;
  return j;
}

/// Reads them; an error says which is wrong. Returns whether the row is of the former schema.
template <class Row>
bool read_head(fields& from, const char* kind, Row& row) {
  const bool former = from.word("schema", {row_schema, former_row_schema}) == former_row_schema;
  from.literal("kind", kind);
  row.study = from.text("study");
  row.utc = from.utc("utc");
  if constexpr (requires { row.environment; }) row.environment = from.hex("environment");
  return former;
}

/// The ranks of a sample, a list of objects.
std::vector<rank_row> read_ranks(fields& from, const char* key);

}  // namespace pairsum::harness
