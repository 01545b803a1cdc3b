#pragma once
#include <string_view>
#include <vector>

#include <pairsum/particles/particle_table.hpp>
#include <pairsum/sum/setup.hpp>

namespace pairsum {

/// Throws pairsum::error unless H, Omega and every particle are usable: names the first bad particle, or counts those
/// outside Omega. Beyond the faces of a periodic axis nothing is outside.
void check_input(const particle_table& p, const setup& s);

/// Throws pairsum::error if a fluid and a boundary particle lie on the same point in precision R: names both. For
/// interactions with a force that is infinite there.
template <class R>
void check_apart(const particle_table& p, std::string_view interaction, const setup& s);

/// Throws pairsum::error for an H or an Omega that no particles could make good.
void check_domain(const setup& s);

/// Throws pairsum::error unless `order` is empty or names each of `rows` ids once.
void check_order(const std::vector<std::uint32_t>& order, std::size_t rows);

/// Removes particles outside the closed Omega of `s`; returns how many. Ids are row numbers, so they change.
std::size_t drop_outside(particle_table& p, const setup& s);

}  // namespace pairsum
