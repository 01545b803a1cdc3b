#pragma once
#include <pairsum/formula/formulas.hpp>
#include <pairsum/sum/vector_lister.hpp>

namespace pairsum {

// Defined in vector/isa_unit.cpp, compiled for each set that is built.
template <int D>
vector_lister<D> lister_on(const isas::avx512*);
template <int D>
vector_lister<D> lister_on(const isas::avx2*);
template <int D>
vector_lister<D> lister_on(const isas::sse4*);
template <int D>
vector_lister<D> lister_on(const isas::neon*);

}  // namespace pairsum
