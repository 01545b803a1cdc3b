#include "harness/run/seats.hpp"

#include <nlohmann/json.hpp>

#include "harness/environment/machine.hpp"
#include "harness/measure/binding.hpp"
#include "harness/ranks/crew.hpp"

namespace pairsum::harness {

std::vector<rank_seat> seats_of(const thread_binding& binding) {
  const nlohmann::json own{{"host", describe_machine().host}, {"units", binding.units()}, {"cores", usable_cores()}};
  std::vector<rank_seat> seats;
  for (const std::string& text : here().gather(own.dump())) {
    const nlohmann::json seat = nlohmann::json::parse(text);
    seats.push_back({seat.at("host"), seat.at("units"), seat.at("cores")});
  }
  return seats;
}

}  // namespace pairsum::harness
