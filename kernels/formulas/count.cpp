#include <pairsum/interactions/count.hpp>

#include <pairsum/formula/formula_source.hpp>

PAIRSUM_FORMULAS(count, plain)
