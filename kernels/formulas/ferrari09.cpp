#include <pairsum/interactions/ferrari09.hpp>

#include <pairsum/formula/formula_source.hpp>

PAIRSUM_FORMULAS(ferrari09, smoothed)
