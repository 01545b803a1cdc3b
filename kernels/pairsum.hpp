#pragma once

// Everything a user of the library needs: cases and particles, interactions and smoothing kernels, every backend of
// this build, their registry and their references, time steps, threads.
#include <pairsum/cases/case.hpp>
#include <pairsum/core/error.hpp>
#include <pairsum/core/workers.hpp>
#include <pairsum/formula/entry.hpp>
#include <pairsum/integrators/integrator.hpp>
#include <pairsum/interactions/interaction.hpp>
#include <pairsum/smoothing/all_smoothings.hpp>
#include <pairsum/sum/agreement.hpp>
#include <pairsum/sum/registry.hpp>
#include <pairsum/sum/setup_of.hpp>
#include <pairsum/vector/own_lanes.hpp>
