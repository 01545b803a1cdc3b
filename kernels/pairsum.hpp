#pragma once

// Everything a user of the library needs: cases and particles, interactions and smoothing kernels, every backend of
// this build, their registry and their references, time steps, threads.
#include "cases/case.hpp"
#include "core/error.hpp"
#include "core/workers.hpp"
#include "integrators/integrator.hpp"
#include "interactions/interaction.hpp"
#include "smoothing/all_smoothings.hpp"
#include "sum/agreement.hpp"
#include "sum/all_backends.hpp"
#include "sum/setup_of.hpp"
