#include <pairsum/interactions/monaghan94.hpp>

#include <pairsum/formula/formula_source.hpp>

PAIRSUM_FORMULAS(monaghan94, smoothed)
