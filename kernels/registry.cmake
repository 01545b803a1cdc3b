# What the library is made of: one word a line, the name of a file in the folder of that kind. To add one, add its file and its word.
set(PAIRSUM_BACKENDS
  naive
  naive_omp
  naive_tbb
  pair_list
  sphysics_sweep
  ppm_stencil
  symmetric
  symmetric_omp
  symmetric_tbb
)
set(PAIRSUM_INTERACTIONS
  ferrari09
)
set(PAIRSUM_PLAIN_INTERACTIONS  # those that use no smoothing kernel
  count
)
set(PAIRSUM_SMOOTHINGS
  wendland_c2
)
set(PAIRSUM_CASES
  dam_break
  lattice
)
set(PAIRSUM_INTEGRATORS
  euler
)
