# What the library is made of: one word a line, the name of a file in the folder of that kind. To add one, add its file and its word.
set(PAIRSUM_ALL_BACKENDS
  naive
  naive_omp
  naive_tbb
  pair_list
  sphysics_sweep
  ppm_stencil
  symmetric
  symmetric_omp
  symmetric_tbb
  sliced_locks
  sliced_2colour
  task_conflicts
  tiles_omp
  tiles_tbb
  naive_tiles_omp
)
set(PAIRSUM_ALL_SMOOTHED_INTERACTIONS  # those that take a smoothing kernel
  ferrari09
  monaghan94
)
set(PAIRSUM_ALL_PLAIN_INTERACTIONS  # those that use none
  count
)
set(PAIRSUM_SCALAR_INTERACTIONS  # of either, those whose particles or rates are not all of the working precision
  count
)
set(PAIRSUM_ALL_SMOOTHINGS
  wendland_c2
  wendland_c4
  wendland_c6
  cubic_spline
  gaussian
)
set(PAIRSUM_ALL_CASES
  dam_break
  lattice
  random_uniform
  random_clustered
)
set(PAIRSUM_ALL_INTEGRATORS
  euler
  rk2
  rk4
  predictor_corrector
)
