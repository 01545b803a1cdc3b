#pragma once
#include <map>
#include <string>

#include "harness/verify/verifier.hpp"

namespace pairsum::harness {

using verdict_map = std::map<std::pair<verifier::moment, std::uint64_t>, verdict>;

/// As bytes for processes of the same build, and back. Unpacking throws pairsum::error for bytes that end too early.
std::string pack(const expectation& e);
std::string pack(const verdict_map& known);
std::string pack(const verdict& v);
expectation unpack_expectation(const std::string& bytes);
verdict unpack_verdict(const std::string& bytes);
verdict_map unpack_verdicts(const std::string& bytes);

}  // namespace pairsum::harness
